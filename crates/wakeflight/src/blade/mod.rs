//! One blade: properties, beam finite elements, modes, kinematics, loads.
pub mod beam;
pub mod modes;
pub mod section;
