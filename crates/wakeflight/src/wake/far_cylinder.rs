//! The far wake of hover and climb as a semi-infinite vortex cylinder.
//!
//! Behind their old ends the tip vortices are taken to go on as regular helices; averaged over azimuth these are a
//! cylinder of vorticity. Axis, radius, pitch and circulation are means of the last turn over the blades. The part of the
//! vorticity along the axis is left out: it turns the air outside the wake, but carries none.

use super::choices::FarWake;
use super::filament::Filaments;
use super::options::WakeOptions;
use crate::vortex::cylinder::VortexCylinder;
use std::f64::consts::TAU;

/// Least descent of the far wake in a revolution, over R: a wake that stays at the rotor has no such end.
const LEAST_PITCH: f64 = 0.05;

/// Whether the options ask for the cylinder.
pub(crate) fn has_cylinder(options: &WakeOptions) -> bool {
    options.far_wake == FarWake::Cylinder
}

/// The cylinder that goes on where the tip vortices, one a blade, end; none unless the options ask for it.
pub(crate) fn far_cylinder(options: &WakeOptions, tips: &Filaments) -> Option<VortexCylinder> {
    if !has_cylinder(options) {
        return None;
    }
    let (n, turn) = (tips.n_segments, options.steps_per_revolution());
    let last_turn = || (0..tips.n_filaments).flat_map(|i| (n + 1 - turn..=n).map(move |k| tips.marker(i, k)));
    let mean =
        |value: &dyn Fn(usize) -> f64| last_turn().map(value).sum::<f64>() / last_turn().count() as f64;
    let at = |m: usize| tips.position[m];
    let axis = [mean(&|m| at(m)[0]), mean(&|m| at(m)[1])];
    let pitch = mean(&|m| at(m - turn)[2] - at(m)[2]).max(LEAST_PITCH * options.rotor.radius);
    let spacing = pitch / tips.n_filaments as f64;
    let ends = (0..tips.n_filaments).map(|i| at(tips.marker(i, n))[2]);
    Some(VortexCylinder {
        axis,
        top: ends.sum::<f64>() / tips.n_filaments as f64,
        radius: mean(&|m| (at(m)[0] - axis[0]).hypot(at(m)[1] - axis[1])),
        strength: mean(&|m| tips.circulation[m]) / spacing,
        // as far as the field of single turns differs from that of the cylinder
        smoothing: spacing / TAU,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wake::geometry::BladeGrid;
    use crate::wake::instant::RotorInstant;
    use crate::wake::velocity_field::{VortexSegments, point_velocity};

    /// Regular helices of two blades, `turns` long.
    fn helices(turns: f64, far_wake: FarWake) -> (WakeOptions, RotorInstant) {
        let mut options = WakeOptions::new(2, 1.0, 0.2, 0.0, 0.1, 100.0);
        options.turns = turns;
        options.far_wake = far_wake;
        options.core_radius = 0.0;
        options.core_growth = 0.0;
        let mut instant = RotorInstant::new(&options, &BladeGrid::new(&options));
        let pitch = 0.3;
        for i in 0..2 {
            for k in 0..=instant.free.n_segments {
                let zeta = k as f64 * options.delta_psi();
                let (sin, cos) = (std::f64::consts::PI * i as f64 - zeta).sin_cos();
                let m = instant.free.marker(i, k);
                instant.free.position[m] = [0.8 * cos, 0.8 * sin, -pitch * zeta / TAU];
                instant.free.circulation[m] = 1.0;
            }
        }
        (options, instant)
    }

    #[test]
    fn verif_cylinder_stands_for_endless_helices() {
        let points = [[0.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.3, -0.9, 0.1], [0.2, 0.1, -0.4]];
        let at = |turns, far_wake| {
            let (options, instant) = helices(turns, far_wake);
            point_velocity(&VortexSegments::new(&options), &options, &instant, &points)
        };
        // 400 turns miss 2e-5 of the velocity on the axis
        let endless = at(400.0, FarWake::Repeat);
        for (turns, tolerance) in [(4.0, 2e-2), (8.0, 4e-3)] {
            let (short, closed) = (at(turns, FarWake::Repeat), at(turns, FarWake::Cylinder));
            for p in 0..points.len() {
                let error = (closed[p][2] - endless[p][2]).abs() / endless[0][2].abs();
                let missing = (short[p][2] - endless[p][2]).abs() / endless[0][2].abs();
                assert!(
                    error < tolerance && error < 0.2 * missing,
                    "{turns} turns, point {p}: {error} {missing}"
                );
            }
        }
    }
}
