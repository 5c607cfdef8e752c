//! The airframe: fuselage, tail surfaces, tail rotor, interference, mass.
pub mod assembly;
pub mod fuselage;
pub mod interference;
pub mod mass;
pub mod servo;
pub mod tail;
pub mod tail_rotor;
