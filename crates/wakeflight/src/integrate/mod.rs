//! Fixed-step integration of the same F(y_dot, y, u; t) = 0: Radau IIA of order five, blades eliminated before the body; and of
//! the blades of a rotor on a stand.
pub mod blocks;
pub mod explicit;
pub mod fixed;
pub mod linearised;
pub mod radau;
pub mod secant;
pub mod steps;
