//! One system: a carrier with a list of rotors. F(y_dot, y, u; t) = 0, its derivatives, its trim, its exchange with the wake.
pub mod blades;
pub mod carrier;
pub mod data;
pub mod drive;
pub mod ground;
pub mod input_slopes;
pub mod instant;
pub mod layout;
pub mod model;
pub mod outputs;
pub mod rates;
pub mod residual;
pub mod rotor_loads;
pub mod slopes;
pub mod trim;
pub mod washed;
