//! Scalars and duals, frames and vectors, tables, small linear systems, wide vectors.
pub mod elliptic;
pub mod four;
pub mod frames;
pub mod jacobian;
pub mod linear;
pub mod scalar;
pub mod tables;
pub mod wide;
