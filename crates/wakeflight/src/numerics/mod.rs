//! Scalars and duals, frames and vectors, tables, small linear systems, wide vectors and their instruction set.
pub mod compiled;
pub mod elliptic;
pub mod four;
pub mod fourier;
pub mod frames;
pub mod instruction_set;
pub mod jacobian;
pub mod linear;
pub mod scalar;
pub mod tables;
pub mod trig;
pub mod wide;
