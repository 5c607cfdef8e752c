"""Helicopters in unsteady manoeuvres with a time-accurate free vortex wake."""
