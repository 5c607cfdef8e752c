//! Between stick and blades: what is known of the flight, filters, feedback within limits, servos, and the sum of all.

pub mod chain;
pub mod feedback;
pub mod filters;
pub mod sensed;
pub mod servos;

/// Lateral, longitudinal, collective, pedal.
pub type Sticks = [f64; 4];

/// Which of the four.
pub type Which = [bool; 4];
