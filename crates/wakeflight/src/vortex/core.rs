//! Core models of a vortex filament and the reference law of one straight segment.

use serde::{Deserialize, Serialize};

/// Swirl profile of the core; `core_radius` is the radius of peak swirl.
///
/// With F the factor on the swirl of the line vortex, v = F circulation / (2 pi r), and q = r / core_radius:
/// the family F = q^2 / (1 + q^(2n))^(1/n) of [vatistas1991], fitted to rotor tip vortices with n = 2 by [bagai1995].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Core {
    /// No core, F = 1.
    Singular,
    /// n = 1: F = q^2 / (1 + q^2).
    Scully,
    /// n = 2: F = q^2 / sqrt(1 + q^4).
    Vatistas2,
    /// Solid-body core, n to infinity: F = min(1, q^2).
    Rankine,
    /// Gaussian vorticity: F = 1 - exp(-alpha q^2).
    LambOseen,
    /// Kernel softened in the distance to the element, 1/(r^2 + eps^2)^(3/2), eps = `core_radius`.
    ///
    /// The swirl of a long filament, circulation r / (2 pi (r^2 + eps^2)), peaks at r = eps.
    RosenheadMoore,
}

/// Distance that the core factor of a segment is taken at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CoreDistance {
    /// To the infinite line through the segment, as is usual in free-wake codes.
    ///
    /// Points near the prolongation of a segment lose velocity although the segment is far away.
    #[default]
    Line,
    /// To the segment itself: the nearest end where the projection falls outside it.
    Segment,
}

/// alpha of the Lamb-Oseen core, the root of 1 + 2 alpha = exp(alpha): peak swirl at `core_radius`.
pub(super) const LAMB_OSEEN_ALPHA: f64 = 1.256_431_208_626_169_7;

/// A point is taken to lie on an end of a segment when r1 r2 <= this * length^2; it then gets no velocity from it.
pub(super) const END_GUARD: f64 = 1e-12;

/// Least core radius over segment length; the singular law is continued linearly to zero inside this distance from its line.
pub(super) const LEAST_CORE: f64 = 1e-12;

impl Core {
    /// Factor F on the singular law of a segment, from squares of the distance and of the core radius [m2].
    fn factor(self, distance_sq: f64, core_sq: f64) -> f64 {
        match self {
            Self::RosenheadMoore => 1.0,
            Self::Scully => distance_sq / (core_sq + distance_sq),
            Self::Vatistas2 => distance_sq / core_sq.hypot(distance_sq),
            Self::Singular | Self::Rankine => (distance_sq / core_sq).min(1.0),
            Self::LambOseen => -(-LAMB_OSEEN_ALPHA * distance_sq / core_sq).exp_m1(),
        }
    }
}

/// Velocity induced at `point` by a straight vortex segment from `start` to `end` [m/s]; the reference the vectorised sums are tested against.
///
/// v = circulation / (4 pi) (r1 + r2) / (r1 r2) s F / |c|^2 c, c = r1 x r2, F the core factor at |c| / length;
/// s = r1 r2 - d for d = r1 . r2 <= 0, else |c|^2 / (r1 r2 + d): no cancellation ahead of or behind the segment.
/// Rosenhead-Moore: the same with eps^2 added to r1^2, r2^2 and d, and F = 1: its kernel integrated exactly over the segment.
///
/// circulation [m2/s]: positive from `start` to `end`; core_radius [m]: of peak swirl. `core_distance` does not act on
/// `Singular` and `RosenheadMoore`.
/// Zero at the ends, where min(r1, r2) is below 1e-12 lengths, and on the segment's own axis; finite everywhere.
#[must_use]
pub fn segment_velocity(
    point: [f64; 3],
    start: [f64; 3],
    end: [f64; 3],
    circulation: f64,
    core_radius: f64,
    core: Core,
    core_distance: CoreDistance,
) -> [f64; 3] {
    let along = difference(end, start);
    let (from_start, from_end) = (difference(point, start), difference(point, end));
    let length_sq = dot(along, along);
    let (r1_sq, r2_sq) = (dot(from_start, from_start), dot(from_end, from_end));
    if (r1_sq * r2_sq).sqrt() <= END_GUARD * length_sq {
        return [0.0; 3];
    }
    // along x r1 equals r1 x r2 without its cancellation far away
    let cross = cross(along, from_start);
    let cross_sq = dot(cross, cross);
    let d = dot(from_start, from_end);

    if cross_sq == 0.0 {
        return [0.0; 3];
    }

    let least_sq = LEAST_CORE * LEAST_CORE * length_sq;
    let core_sq = if core == Core::Singular { least_sq } else { least_sq.max(core_radius * core_radius) };
    let softening = if core == Core::RosenheadMoore { core_sq } else { 0.0 };
    let (r1, r2, d_soft) = ((r1_sq + softening).sqrt(), (r2_sq + softening).sqrt(), d + softening);
    let area_sq = cross_sq + softening * length_sq;

    let outside = d > r1_sq.min(r2_sq);
    let distance_sq = match core_distance {
        CoreDistance::Segment if outside => r1_sq.min(r2_sq),
        _ => cross_sq / length_sq,
    };
    let product = r1 * r2;
    // s / |c|^2
    let spread = if d_soft > 0.0 { 1.0 / (product + d_soft) } else { (product - d_soft) / area_sq };
    let weight = circulation / (4.0 * std::f64::consts::PI) * (r1 + r2) / product * spread;
    let factor = weight * core.factor(distance_sq, core_sq);
    cross.map(|c| factor * c)
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
