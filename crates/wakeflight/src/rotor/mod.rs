//! The rotor: swashplate, lag damper, hub, periodic blade motion, circulation with the near wake, the stand.
pub mod circulation;
pub mod data;
pub mod drive;
pub mod exchange;
pub mod four;
pub mod hub;
pub mod lag_damper;
pub mod memory;
pub mod passages;
pub mod periodic;
pub mod periodic_slopes;
pub mod sense;
pub mod speed;
pub mod swashplate;
