//! Inflow models that have states, options of those without a wake, and means over the disk.
pub mod descent;
pub mod disk;
pub mod ground;
pub mod momentum;
pub mod options;
pub mod pitt_peters;

pub use options::{AnnularOptions, TipLoss};
