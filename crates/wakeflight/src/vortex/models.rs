//! Core models as denominators of the segment law, several points at a time.

use super::core::{Core, CoreDistance, LAMB_OSEEN_ALPHA};
use super::lanes::{LEAST_SQUARE, Lanes, Roots};
use crate::vortex::arithmetic::Arithmetic;
use pulp::Simd;

/// What a core sees of a segment, for several points; r_c: core radius, L: |c| over the core distance.
#[derive(Clone, Copy)]
pub(super) struct Seen<S: Simd> {
    /// |c|^2, with r_c^2 length^2 added for a softened kernel.
    pub cross_sq: S::f64s,
    /// r_c^2 L^2; L is the segment's length for the distance to the line.
    pub area: S::f64s,
    /// Square of `area`.
    pub area_sq: S::f64s,
}

/// A core model: |c|^2 / F, squared, F being the factor on the singular law, without branches.
pub(super) trait Model: Copy + Send + Sync {
    /// Whether the core radius softens the distance in the kernel itself.
    const SOFTENED: bool = false;
    /// (|c|^2 / F)^2 for every point.
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s;
    /// What is left of F where that denominator does not hold all of it.
    #[inline(always)]
    fn factor<S: Simd, R: Roots<S>>(on: Lanes<S, R>, _: Seen<S>) -> S::f64s {
        on.splat(1.0)
    }
    /// Rate of `denominator_sq` with the rates of |c|^2 and of r_c^2 L^2.
    fn denominator_sq_rate<S: Simd, R: Roots<S>>(
        on: Lanes<S, R>,
        seen: Seen<S>,
        rate: [S::f64s; 2],
    ) -> S::f64s;
    /// `factor` and its rate.
    #[inline(always)]
    fn factor_with_rate<S: Simd, R: Roots<S>>(
        on: Lanes<S, R>,
        _: Seen<S>,
        _: [S::f64s; 2],
    ) -> (S::f64s, S::f64s) {
        (on.splat(1.0), on.splat(0.0))
    }
}

/// 2 a b.
#[inline(always)]
fn twice<S: Simd, R: Roots<S>>(on: Lanes<S, R>, a: S::f64s, b: S::f64s) -> S::f64s {
    on.mul(on.add(a, a), b)
}

/// A computation for one core model and distance.
pub(super) trait ForModel {
    /// Runs for the model `M`.
    fn run<M: Model, const TO_SEGMENT: bool>(self);
}

/// Runs `task` for the model of `core` at `core_distance`.
pub(super) fn for_core<T: ForModel>(core: Core, core_distance: CoreDistance, task: T) {
    match core {
        Core::Singular => at_distance::<Singular, T>(core_distance, task),
        Core::Scully => at_distance::<Scully, T>(core_distance, task),
        Core::Vatistas2 => at_distance::<Vatistas2, T>(core_distance, task),
        Core::Rankine => at_distance::<Rankine, T>(core_distance, task),
        Core::LambOseen => at_distance::<LambOseen, T>(core_distance, task),
        Core::RosenheadMoore => at_distance::<RosenheadMoore, T>(core_distance, task),
    }
}

fn at_distance<M: Model, T: ForModel>(core_distance: CoreDistance, task: T) {
    match core_distance {
        CoreDistance::Line => task.run::<M, false>(),
        CoreDistance::Segment => task.run::<M, true>(),
    }
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
    #[inline(always)]
    fn denominator_sq_rate<S: Simd, R: Roots<S>>(
        on: Lanes<S, R>,
        seen: Seen<S>,
        rate: [S::f64s; 2],
    ) -> S::f64s {
        Rankine::denominator_sq_rate(on, seen, rate)
    }
}

impl Model for Scully {
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        let sum = on.add(seen.cross_sq, seen.area);
        on.mul(sum, sum)
    }
    #[inline(always)]
    fn denominator_sq_rate<S: Simd, R: Roots<S>>(
        on: Lanes<S, R>,
        seen: Seen<S>,
        rate: [S::f64s; 2],
    ) -> S::f64s {
        twice(on, on.add(seen.cross_sq, seen.area), on.add(rate[0], rate[1]))
    }
}

impl Model for Vatistas2 {
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        on.mul_add(seen.cross_sq, seen.cross_sq, seen.area_sq)
    }
    #[inline(always)]
    fn denominator_sq_rate<S: Simd, R: Roots<S>>(
        on: Lanes<S, R>,
        seen: Seen<S>,
        rate: [S::f64s; 2],
    ) -> S::f64s {
        on.add(twice(on, seen.cross_sq, rate[0]), twice(on, seen.area, rate[1]))
    }
}

impl Model for Rankine {
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        let largest = on.max(seen.cross_sq, seen.area);
        on.mul(largest, largest)
    }
    #[inline(always)]
    fn denominator_sq_rate<S: Simd, R: Roots<S>>(
        on: Lanes<S, R>,
        seen: Seen<S>,
        rate: [S::f64s; 2],
    ) -> S::f64s {
        let outside = on.greater(seen.cross_sq, seen.area);
        twice(on, on.max(seen.cross_sq, seen.area), on.select(outside, rate[0], rate[1]))
    }
}

impl Model for LambOseen {
    /// |c|^2 / F = (scale / alpha) area / D, or |c|^2 where the core ends.
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        let inside = on.mul(on.splat(DOUBLED / LAMB_OSEEN_ALPHA), seen.area);
        let outside = on.mul(on.splat(DOUBLED / CORE_END), seen.cross_sq);
        let denominator = on.max(inside, outside);
        on.mul(denominator, denominator)
    }

    /// D = F / y, y = alpha q^2 / 2^7 limited to the end of the core.
    ///
    /// u = 1 - exp(-y) is y times a series, and 1 - exp(-2 y) = u (2 - u): seven times, without cancellation.
    #[inline(always)]
    fn factor<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        let area = on.max(seen.area, on.splat(LEAST_SQUARE));
        let exponent = on.mul(on.splat(LAMB_OSEEN_ALPHA / DOUBLED), on.div(seen.cross_sq, area));
        let y = on.min(exponent, on.splat(CORE_END / DOUBLED));
        // even and odd powers apart: half the wait of one chain
        let y_sq = on.mul(y, y);
        let (mut even, mut odd) = (on.splat(SERIES[10]), on.splat(SERIES[11]));
        for n in (0..10).step_by(2).rev() {
            even = on.mul_add(even, y_sq, on.splat(SERIES[n]));
            odd = on.mul_add(odd, y_sq, on.splat(SERIES[n + 1]));
        }
        let mut d = on.mul_add(odd, y, even);
        for _ in 0..DOUBLINGS {
            d = on.mul(d, on.sub_mul(on.splat(2.0), y, d));
        }
        d
    }
    #[inline(always)]
    fn denominator_sq_rate<S: Simd, R: Roots<S>>(
        on: Lanes<S, R>,
        seen: Seen<S>,
        rate: [S::f64s; 2],
    ) -> S::f64s {
        let inside = on.mul(on.splat(DOUBLED / LAMB_OSEEN_ALPHA), seen.area);
        let outside = on.mul(on.splat(DOUBLED / CORE_END), seen.cross_sq);
        let inside_rate = on.mul(on.splat(DOUBLED / LAMB_OSEEN_ALPHA), rate[1]);
        let outside_rate = on.mul(on.splat(DOUBLED / CORE_END), rate[0]);
        let greater = on.greater(outside, inside);
        twice(on, on.max(inside, outside), on.select(greater, outside_rate, inside_rate))
    }

    /// The series and its doublings with their slopes by y.
    #[inline(always)]
    fn factor_with_rate<S: Simd, R: Roots<S>>(
        on: Lanes<S, R>,
        seen: Seen<S>,
        rate: [S::f64s; 2],
    ) -> (S::f64s, S::f64s) {
        let area = on.max(seen.area, on.splat(LEAST_SQUARE));
        let q_sq = on.div(seen.cross_sq, area);
        let exponent = on.mul(on.splat(LAMB_OSEEN_ALPHA / DOUBLED), q_sq);
        let end = on.splat(CORE_END / DOUBLED);
        let y = on.min(exponent, end);
        let slope = on.div(on.sub_mul(rate[0], q_sq, rate[1]), area);
        let inside = on.mul(on.splat(LAMB_OSEEN_ALPHA / DOUBLED), slope);
        let y_rate = on.select(on.greater(exponent, end), on.splat(0.0), inside);
        let (mut d, mut d_slope) = (on.splat(SERIES[11]), on.splat(0.0));
        for n in (0..11).rev() {
            d_slope = on.mul_add(d_slope, y, d);
            d = on.mul_add(d, y, on.splat(SERIES[n]));
        }
        for _ in 0..DOUBLINGS {
            // d (2 - y d)
            let rest = on.sub_mul(on.splat(2.0), y, d);
            d_slope = on.sub_mul(on.mul(d_slope, rest), d, on.mul_add(y, d_slope, d));
            d = on.mul(d, rest);
        }
        (d, on.mul(d_slope, y_rate))
    }
}

/// alpha q^2 from which on 1 - exp(-alpha q^2) is 1 to rounding.
const CORE_END: f64 = 40.0;
/// Times the exponent is halved for the series.
const DOUBLINGS: usize = 7;
/// 2^7.
const DOUBLED: f64 = 128.0;
/// (1 - exp(-y)) / y = sum of (-y)^n / (n + 1)!, the first term left out is below rounding.
const SERIES: [f64; 12] = {
    let mut coefficients = [1.0; 12];
    let mut n = 1;
    while n < 12 {
        coefficients[n] = -coefficients[n - 1] / (n as f64 + 1.0);
        n += 1;
    }
    coefficients
};

impl Model for RosenheadMoore {
    const SOFTENED: bool = true;
    #[inline(always)]
    fn denominator_sq<S: Simd, R: Roots<S>>(on: Lanes<S, R>, seen: Seen<S>) -> S::f64s {
        on.mul(seen.cross_sq, seen.cross_sq)
    }
    #[inline(always)]
    fn denominator_sq_rate<S: Simd, R: Roots<S>>(
        on: Lanes<S, R>,
        seen: Seen<S>,
        rate: [S::f64s; 2],
    ) -> S::f64s {
        twice(on, seen.cross_sq, rate[0])
    }
}
