//! Scalars and duals, frames and vectors, tables.
pub mod frames;
pub mod jacobian;
pub mod scalar;
pub mod tables;
