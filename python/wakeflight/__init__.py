"""Helicopters in unsteady manoeuvres with a time-accurate free vortex wake."""

from wakeflight.vortex import induced_velocity as induced_velocity
