//! One blade: properties, beam finite elements, modes, kinematics, loads.
pub mod assembly;
pub mod beam;
pub mod error;
pub mod hermite;
pub mod inertia;
pub mod jet;
pub mod modes;
pub mod quadrature;
pub mod section;
