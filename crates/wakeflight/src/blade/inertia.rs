//! Inertia of one rotating section: what a unit of span adds to mass and centrifugal stiffness.

use super::jet::Jet;
use super::section::Section;

/// Local variables of a section: axial shift, lead, flap [m], their slopes, change of pitch [rad].
pub const N_LOCAL: usize = 6;
/// Axial shift (foreshortening, outboard +).
pub const U: usize = 0;
/// Lead.
pub const V: usize = 1;
/// Flap.
pub const W: usize = 2;
/// Slope of lead.
pub const DV: usize = 3;
/// Slope of flap.
pub const DW: usize = 4;
/// Pitch beyond reference and built-in twist.
pub const PHI: usize = 5;

/// Second-order inertia of a section about the straight blade, per length.
#[derive(Clone, Copy, Debug)]
pub struct SectionInertia {
    /// Mass matrix in the local variables.
    pub mass: [[f64; N_LOCAL]; N_LOCAL],
    /// Hessian of the centrifugal potential -T0 in the local variables, at constant tension.
    pub centrifugal: [[f64; N_LOCAL]; N_LOCAL],
    /// Outward pull per length dT0/du [N/m]: its integral from the tip is the tension.
    pub pull: f64,
}

type Vector = [Jet<N_LOCAL>; 3];

/// Inertia of `section` at station `x` [m] and pitch `pitch` [rad] when the blade turns at `rate` [rad/s, span axes].
///
/// Tangent by lag, then flap: sin B = w', sin L = v'/cos B; chord at zero pitch c0 = (-sin L, cos L, 0), n0 = t x c0;
/// pitch last: c = c0 cos th + n0 sin th, n = n0 cos th - c0 sin th. The centre of gravity is at
/// p = (x + u, v, w) + x_cg c. T0 = 1/2 m |rate x p|^2 + 1/2 i_chord |rate x c|^2 + 1/2 i_flap |rate x n|^2, and the
/// mass matrix comes from the same p, c, n. Derivatives are exact.
pub fn section_inertia(section: &Section, rate: [f64; 3], x: f64, pitch: f64) -> SectionInertia {
    let variable = |i| Jet::<N_LOCAL>::variable(0.0, i);
    let one = Jet::constant(1.0);
    let sin_b = variable(DW);
    let cos_b = (one - sin_b.squared()).sqrt();
    let sin_l = variable(DV) * cos_b.recip();
    let cos_l = (one - sin_l.squared()).sqrt();
    let (sin_th, cos_th) = (variable(PHI) + Jet::constant(pitch)).sin_cos();

    let c0: Vector = [-sin_l, cos_l, Jet::constant(0.0)];
    let n0: Vector = [-(sin_b * cos_l), -(sin_b * sin_l), cos_b];
    let c: Vector = std::array::from_fn(|k| c0[k] * cos_th + n0[k] * sin_th);
    let n: Vector = std::array::from_fn(|k| n0[k] * cos_th - c0[k] * sin_th);
    let axis: Vector = [variable(U) + Jet::constant(x), variable(V), variable(W)];
    let p: Vector = std::array::from_fn(|k| axis[k] + c[k] * section.x_cg);

    let parts = [(section.mass, p), (section.i_chord, c), (section.i_flap, n)];
    let mut rotation = Jet::constant(0.0);
    let mut mass = [[0.0; N_LOCAL]; N_LOCAL];
    for (weight, vector) in parts {
        rotation = rotation + squared_velocity(rate, &vector) * (0.5 * weight);
        for (i, row) in mass.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                let dot: f64 = vector.iter().map(|a| a.gradient[i] * a.gradient[j]).sum();
                *entry += weight * dot;
            }
        }
    }
    let centrifugal = rotation.hessian.map(|row| row.map(|h| -h));
    SectionInertia { mass, centrifugal, pull: rotation.gradient[U] }
}

/// |rate x r|^2
fn squared_velocity(rate: [f64; 3], r: &Vector) -> Jet<N_LOCAL> {
    let [a, b, c] = rate;
    (r[2] * b - r[1] * c).squared() + (r[0] * c - r[2] * a).squared() + (r[1] * a - r[0] * b).squared()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn propeller_moment_stiffens_torsion_by_the_difference_of_the_inertias() {
        // T0 = 1/2 omega^2 (i_chord cos^2 th + i_flap sin^2 th)
        let section = Section { mass: 0.0, i_chord: 0.3, i_flap: 0.1, ..Section::default() };
        for pitch in [0.0f64, 0.3] {
            let inertia = section_inertia(&section, [0.0, 0.0, 20.0], 3.0, pitch);
            let expected = 400.0 * 0.2 * (2.0 * pitch).cos();
            assert!((inertia.centrifugal[PHI][PHI] - expected).abs() < 1e-11);
            assert!((inertia.mass[PHI][PHI] - 0.4).abs() < 1e-15);
        }
    }

    #[test]
    fn centrifugal_force_on_an_offset_centre_of_gravity_couples_flap_slope_and_pitch() {
        // at zero pitch the chord turned by phi tips inboard with flap: p_x = x - x_cg w' phi, force m omega^2 x
        let section = Section { mass: 9.0, x_cg: -0.02, ..Section::default() };
        let inertia = section_inertia(&section, [0.0, 0.0, 20.0], 3.0, 0.0);
        assert!((inertia.centrifugal[DW][PHI] - 9.0 * 400.0 * 3.0 * -0.02).abs() < 1e-10);
        assert!((inertia.mass[W][PHI] - 9.0 * -0.02).abs() < 1e-15);
        assert!((inertia.pull - 9.0 * 400.0 * 3.0).abs() < 1e-10);
        assert!((inertia.centrifugal[V][V] + 9.0 * 400.0).abs() < 1e-10);
        assert_eq!(inertia.centrifugal[W][W], 0.0);
    }
}
