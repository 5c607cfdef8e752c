//! wakeflight: helicopters in unsteady manoeuvres with a time-accurate free vortex wake.
//!
//! The physics, as a tower: each room uses only rooms above it in this list.

pub mod numerics;

pub mod atmosphere;
pub mod vortex;

pub mod airfoil;
pub mod wake;

pub mod inflow;

pub mod blade;

pub mod rotor;

pub mod wind;

pub mod airframe;

pub mod trim;

pub mod control;

pub mod system;

pub mod integrate;
