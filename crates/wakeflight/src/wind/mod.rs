//! Air that moves of its own: what it is at a place, and where an aircraft feels it.

pub mod kinds;
pub mod places;
pub mod spread;
