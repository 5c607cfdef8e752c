//! Free filaments: markers, registers of circulation, cores.

use super::options::WakeOptions;
use serde::{Deserialize, Serialize};

/// Filaments of equal length at one instant; markers from the blade to the old end.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Filaments {
    /// Number of filaments.
    pub n_filaments: usize,
    /// Segments of each.
    pub n_segments: usize,
    /// Markers (n_filaments, n_segments + 1) [m, `_h`].
    pub position: Vec<[f64; 3]>,
    /// Circulation of the markers (n_filaments, n_segments + 1) [m2/s], positive along increasing age.
    pub circulation: Vec<f64>,
    /// Square of the core radius of the segments (n_filaments, n_segments) [m2].
    pub core_squared: Vec<f64>,
}

impl Filaments {
    /// Free trailers of every blade, root to tip, at the origin without circulation, with the cores of undisturbed ageing.
    pub fn free(options: &WakeOptions) -> Self {
        let n_t = options.trailers_per_blade();
        let mut filaments = Self::new(options, options.rotor.n_blades * n_t);
        let aged = (0..n_t).flat_map(|t| aged_cores(options, options.release_core(t)));
        filaments.core_squared = aged.collect::<Vec<_>>().repeat(options.rotor.n_blades);
        filaments
    }

    /// Filaments at the origin without circulation, with the cores of undisturbed ageing.
    pub fn new(options: &WakeOptions, n_filaments: usize) -> Self {
        let n_segments = options.n_segments();
        let aged: Vec<f64> = aged_cores(options, options.core_radius).collect();
        Filaments {
            n_filaments,
            n_segments,
            position: vec![[0.0; 3]; n_filaments * (n_segments + 1)],
            circulation: vec![0.0; n_filaments * (n_segments + 1)],
            core_squared: aged.repeat(n_filaments),
        }
    }

    /// Becomes a copy of `other`; room is kept.
    pub fn copy(&mut self, other: &Self) {
        (self.n_filaments, self.n_segments) = (other.n_filaments, other.n_segments);
        self.position.clone_from(&other.position);
        self.circulation.clone_from(&other.circulation);
        self.core_squared.clone_from(&other.core_squared);
    }

    /// Index of marker `k` of filament `i`.
    pub fn marker(&self, i: usize, k: usize) -> usize {
        i * (self.n_segments + 1) + k
    }

    /// Length of segment `k` of filament `i` [m].
    pub fn segment_length(&self, i: usize, k: usize) -> f64 {
        let m = self.marker(i, k);
        distance(self.position[m], self.position[m + 1])
    }
}

/// Core radius after the age `zeta` [rad] of a vortex of constant length, released with the radius `release` R [m].
///
/// r_c^2 = r_c0^2 + G R^2 zeta: diffusion of a Gaussian vortex with an eddy viscosity,
/// G R^2 = 4 alpha delta nu / omega, alpha = 1.25643 [squire1965, bhagwat2002].
pub fn core_radius(options: &WakeOptions, release: f64, zeta: f64) -> f64 {
    options.rotor.radius * (release.powi(2) + options.core_growth * zeta).sqrt()
}

/// Square of the core radius of segment `k` in the middle of its age [m2].
pub fn aged_core_squared(options: &WakeOptions, release: f64, k: usize) -> f64 {
    core_radius(options, release, (k as f64 + 0.5) * options.delta_psi()).powi(2)
}

/// Squares of the core radii of all segments of a filament [m2].
pub fn aged_cores(options: &WakeOptions, release: f64) -> impl Iterator<Item = f64> + '_ {
    (0..options.n_segments()).map(move |k| aged_core_squared(options, release, k))
}

/// Square of the core radius one step later [m2]: growth, then thinning at constant volume of vorticity.
///
/// `release`: radius at release over R; `pace`: time of the step over that at the nominal speed. r_c^2 <- (r_c^2 + G R^2 delta_psi) l_old / l_new; the ratio of lengths is limited to 0.5 ... 2 in a step,
/// the radius to 0.1 r_c0 ... 0.5 R.
pub fn stretched_core_squared(
    options: &WakeOptions,
    release: f64,
    core_squared: f64,
    [length_old, length_new]: [f64; 2],
    pace: f64,
) -> f64 {
    let r2 = options.rotor.radius * options.rotor.radius;
    let grown = core_squared + options.core_growth * r2 * options.delta_psi() * pace;
    let ratio = if length_new > 0.0 { (length_old / length_new).clamp(0.5, 2.0) } else { 2.0 };
    let least = 0.01 * release * release * r2;
    (grown * ratio).clamp(least, (0.25 * r2).max(least))
}

/// Distance of two points.
pub(crate) fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    distance_squared(a, b).sqrt()
}

/// Its square.
pub(crate) fn distance_squared(a: [f64; 3], b: [f64; 3]) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Core radii of a Lamb-Oseen vortex with an eddy viscosity of 8 nu, at ages in degrees.
    fn grows(radius: f64, omega: f64, r0: f64, rows: [(f64, f64); 4]) {
        let (alpha, delta, nu) = (1.25643, 8.0, 1.5e-5);
        let mut options = WakeOptions::new(2, radius, 0.2 * radius, 0.0, 0.1 * radius, omega);
        options.core_radius = r0 / radius;
        options.core_growth = 4.0 * alpha * delta * nu / (omega * radius * radius);
        for (age_deg, expected) in rows {
            let found = core_radius(&options, options.core_radius, f64::to_radians(age_deg));
            assert!((found - expected).abs() < 1e-7, "{age_deg} deg: {found} {expected}");
        }
    }

    #[test]
    fn verif_cores_grow_by_diffusion() {
        let rotor = [(0.0, 0.02635000), (360.0, 0.02889061), (720.0, 0.03122518), (1440.0, 0.03543587)];
        grows(8.178, 27.0, 0.02635, rotor);
        let model = [(0.0, 0.00952500), (180.0, 0.01025669), (360.0, 0.01093955), (720.0, 0.01219105)];
        grows(1.143, 130.9, 0.009525, model);
    }

    #[test]
    fn stretching_keeps_the_volume_of_vorticity() {
        let mut options = WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0);
        options.core_growth = 0.0;
        let (old, strain) = (0.04, 0.3);
        let new = stretched_core_squared(&options, options.core_radius, old, [1.0, 1.0 + strain], 1.0);
        assert!((new.sqrt() - old.sqrt() / (1.0 + strain).sqrt()).abs() < 1e-15);
        // a segment ten times as long in one step is thinned by the limit only
        assert!(
            (stretched_core_squared(&options, options.core_radius, old, [1.0, 10.0], 1.0) - 0.5 * old).abs()
                < 1e-15
        );
    }
}
