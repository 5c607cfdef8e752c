//! The whole aircraft: F(y_dot, y, u, t) = 0, its Jacobian, its trim, its exchange with the wake.
pub mod data;
pub mod jacobian;
pub mod model;
pub mod outputs;
pub mod rates;
pub mod residual;
pub mod state;
pub mod trim;
