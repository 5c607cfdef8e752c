//! Sums over segments in single precision: twice as many points at a time, roots from estimates in one Newton step.
//!
//! Lengths are over a unit of the caller's, the rotor radius, from the origin: places are numbers of order one. A place is then
//! known to 6e-8 of the unit times its distance from the origin, and a velocity to that times the gradient of the velocity beside
//! a core: some 1e-6 of the largest velocity for cores of a hundredth of the unit. Core of Vatistas n = 2 alone.

pub(super) mod kernel;
pub(super) mod lanes;
mod packed;
#[cfg(test)]
mod tests;

pub(super) use packed::{SinglePart, SingleStrands, within_range};

use super::core::CoreDistance;
use super::induced_velocity::over_groups;
use super::sources::{Group, Part};
use crate::numerics::instruction_set::InstructionSet;
use kernel::Sum;

/// As [`add_groups_velocity`](super::induced_velocity::add_groups_velocity) for sources that were packed with a unit of length,
/// core of Vatistas n = 2.
///
/// Same bits for any number of threads, and for any points beside a point; instruction sets differ by the roots they have.
pub fn add_groups_velocity(groups: &mut [Group<'_>], core_distance: CoreDistance) {
    add_groups_velocity_on(InstructionSet::in_use(), groups, core_distance);
}

/// The same on given lanes, to compare and to time them; a set that is missing falls back to a narrower one.
pub fn add_groups_velocity_on(
    instruction_set: InstructionSet,
    groups: &mut [Group<'_>],
    core_distance: CoreDistance,
) {
    over_groups(groups, |points: &[[f64; 3]], parts: &[Part<'_>], velocity: &mut [[f64; 3]]| {
        match core_distance {
            CoreDistance::Line => lanes::run(Sum::<false>::new(points, parts, velocity), instruction_set),
            CoreDistance::Segment => lanes::run(Sum::<true>::new(points, parts, velocity), instruction_set),
        }
    });
}
