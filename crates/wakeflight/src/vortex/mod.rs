//! Straight vortex segments: core models and sums over many.
pub mod core;
pub mod curvature;
pub mod cylinder;
pub mod directional;
pub mod induced_velocity;
pub mod single;
pub mod sources;
pub mod threads;
pub mod tree;

mod arithmetic;
mod dispatch;
mod kernel;
mod lanes;
mod models;
mod roots;
mod strands;
mod team;

#[cfg(test)]
mod tests;
