//! The whole aircraft: F(y_dot, y, u, t) = 0.
pub mod data;
