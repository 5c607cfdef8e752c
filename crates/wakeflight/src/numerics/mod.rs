//! Scalars and duals, frames and vectors, tables.
pub mod frames;
pub mod scalar;
pub mod tables;
