//! Inflow models that have states, and means over the disk.
pub mod disk;
pub mod pitt_peters;
