//! Core models as denominators of the segment law, several points at a time.

use super::core::LAMB_OSEEN_ALPHA;
use super::lanes::Lanes;
use super::roots::Roots;
use pulp::Simd;

/// What a core sees of a segment, for several points; r_c: core radius, L: |c| over the core distance.
pub(super) struct Seen<S: Simd> {
    /// |c|^2, with r_c^2 length^2 added for a softened kernel.
    pub cross_sq: S::f64s,
    /// r_c^2 L^2; L is the segment's length for the distance to the line.
    pub area: S::f64s,
    /// Square of `area`.
    pub area_sq: S::f64s,
}

/// A core model: |c|^2 / F, squared, F being the factor on the singular law.
pub(super) trait Model: Copy + Send + Sync {
    /// Whether the core radius softens the distance in the kernel itself.
    const SOFTENED: bool = false;
    /// (|c|^2 / F)^2 for every point.
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s;
}

/// F = 1.
#[derive(Clone, Copy)]
pub(super) struct Singular;
/// F = q^2 / (1 + q^2).
#[derive(Clone, Copy)]
pub(super) struct Scully;
/// F = q^2 / sqrt(1 + q^4).
#[derive(Clone, Copy)]
pub(super) struct Vatistas2;
/// F = min(1, q^2).
#[derive(Clone, Copy)]
pub(super) struct Rankine;
/// F = 1 - exp(-alpha q^2).
#[derive(Clone, Copy)]
pub(super) struct LambOseen;
/// F = 1 in a softened kernel.
#[derive(Clone, Copy)]
pub(super) struct RosenheadMoore;

impl Model for Singular {
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        Rankine::denominator_sq(on, seen)
    }
}

impl Model for Scully {
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        let sum = on.add(seen.cross_sq, seen.area);
        on.mul(sum, sum)
    }
}

impl Model for Vatistas2 {
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        on.mul_add(seen.cross_sq, seen.cross_sq, seen.area_sq)
    }
}

impl Model for Rankine {
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        let largest = on.max(seen.cross_sq, seen.area);
        on.mul(largest, largest)
    }
}

impl Model for LambOseen {
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        // no vector exponential: one point after the other
        let denominator = on.each(seen.cross_sq, seen.area, gaussian_denominator);
        on.mul(denominator, denominator)
    }
}

/// |c|^2 / (1 - exp(-alpha |c|^2 / area)), with its limit area / alpha on the axis.
fn gaussian_denominator(cross_sq: f64, area: f64) -> f64 {
    let exponent = LAMB_OSEEN_ALPHA * cross_sq;
    if exponent > 40.0 * area {
        cross_sq
    } else if exponent <= 1e-17 * area {
        area / LAMB_OSEEN_ALPHA
    } else {
        cross_sq / -(-exponent / area).exp_m1()
    }
}

impl Model for RosenheadMoore {
    const SOFTENED: bool = true;
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        on.mul(seen.cross_sq, seen.cross_sq)
    }
}
