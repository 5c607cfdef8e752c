//! Inflow models that have states, and options of those without a wake.
pub mod options;
pub mod pitt_peters;

pub use options::{AnnularOptions, TipLoss};
