//! Mass properties of the airframe without its blades.

use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use serde::Deserialize;
use thiserror::Error;

/// Airframe without blades: gross less blades, about its own centre of gravity.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MassProperties {
    /// Gross mass, blades included [kg].
    pub gross_mass: f64,
    /// Inertia of the airframe without blades about its own centre of gravity: Ixx, Iyy, Izz, Ixz [kg m2].
    pub inertia: [f64; 4],
}

/// All blades of a rotor as a point mass at its hub.
#[derive(Clone, Copy, Debug)]
pub struct BladesAtHub {
    /// Hub from the body origin [m].
    pub hub: [f64; 3],
    /// Mass of all blades [kg].
    pub mass: f64,
}

/// Mass properties no body can have.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MassError {
    /// Nothing is left when the blades are taken off.
    #[error("gross mass {gross_mass} kg does not exceed that of the blades, {blades} kg")]
    TooLight {
        /// Gross mass [kg].
        gross_mass: f64,
        /// All blades [kg].
        blades: f64,
    },
    /// The inertia matrix is not positive definite.
    #[error("inertia Ixx {0}, Iyy {1}, Izz {2}, Ixz {3} kg m2 is not positive definite")]
    Inertia(f64, f64, f64, f64),
}

/// The airframe as a rigid body in body axes, its motion referred to the body origin.
///
/// The origin is the nominal gross centre of gravity: airframe and blades, these as point masses at the hub.
#[derive(Clone, Copy, Debug)]
pub struct AirframeMass {
    /// Mass without blades [kg].
    pub mass: f64,
    /// Centre of gravity without blades, from the origin [m].
    pub cg: [f64; 3],
    /// Inertia matrix about that centre of gravity [kg m2].
    pub inertia_cg: [[f64; 3]; 3],
    /// Inertia matrix about the origin [kg m2].
    pub inertia_origin: [[f64; 3]; 3],
}

/// Inertia matrix of a point mass.
fn point_inertia(mass: f64, r: [f64; 3]) -> [[f64; 3]; 3] {
    let squared = r.iter().map(|x| x * x).sum::<f64>();
    std::array::from_fn(|i| {
        std::array::from_fn(|j| mass * (if i == j { squared } else { 0.0 } - r[i] * r[j]))
    })
}

fn times<S: Real>(matrix: &[[f64; 3]; 3], v: Vec3<S, Body>) -> Vec3<S, Body> {
    Vec3::from_array(matrix.map(|row| v.x * row[0] + v.y * row[1] + v.z * row[2]))
}

impl AirframeMass {
    /// Takes the blades of every rotor off the gross mass.
    pub fn new(properties: &MassProperties, rotors: &[BladesAtHub]) -> Result<Self, MassError> {
        let blades: f64 = rotors.iter().map(|r| r.mass).sum();
        let mass = properties.gross_mass - blades;
        // written so that NaN is refused
        if !(mass > 0.0 && mass.is_finite()) {
            return Err(MassError::TooLight { gross_mass: properties.gross_mass, blades });
        }
        let [ixx, iyy, izz, ixz] = properties.inertia;
        if !(ixx > 0.0 && iyy > 0.0 && ixx * izz > ixz * ixz) {
            return Err(MassError::Inertia(ixx, iyy, izz, ixz));
        }
        let cg = std::array::from_fn(|i| rotors.iter().map(|r| -r.mass / mass * r.hub[i]).sum());
        let inertia_cg = [[ixx, 0.0, -ixz], [0.0, iyy, 0.0], [-ixz, 0.0, izz]];
        let offset = point_inertia(mass, cg);
        let inertia_origin =
            std::array::from_fn(|i| std::array::from_fn(|j| inertia_cg[i][j] + offset[i][j]));
        Ok(Self { mass, cg, inertia_cg, inertia_origin })
    }

    /// Force [N] and moment about the origin [N m] of gravity and inertia; all loads together are zero.
    ///
    /// a_cg = v_dot + omega x v + omega_dot x c + omega x (omega x c), force = m (g - a_cg),
    /// moment = c x force - (I omega_dot + omega x I omega), c and I of the airframe without blades.
    /// `velocity_b` of the origin [m/s], `rates_b` [rad/s] and their derivatives in body axes, `gravity_b` [m/s2].
    pub fn inertial_residual<S: Real>(
        &self,
        velocity_b: Vec3<S, Body>,
        rates_b: Vec3<S, Body>,
        velocity_dot: Vec3<S, Body>,
        rates_dot: Vec3<S, Body>,
        gravity_b: Vec3<S, Body>,
    ) -> (Vec3<S, Body>, Vec3<S, Body>) {
        let cg = Vec3::cst(self.cg);
        let acceleration =
            velocity_dot + rates_b.cross(velocity_b) + rates_dot.cross(cg) + rates_b.cross(rates_b.cross(cg));
        let force = (gravity_b - acceleration).scaled(self.mass);
        let spin = times(&self.inertia_cg, rates_dot) + rates_b.cross(times(&self.inertia_cg, rates_b));
        (force, cg.cross(force) - spin)
    }

    /// Kinetic energy [J], 1/2 m |v + omega x c|^2 + 1/2 omega . I omega.
    pub fn kinetic_energy(&self, velocity_b: Vec3<f64, Body>, rates_b: Vec3<f64, Body>) -> f64 {
        let v = velocity_b + rates_b.cross(Vec3::cst(self.cg));
        0.5 * (self.mass * v.dot(v) + rates_b.dot(times(&self.inertia_cg, rates_b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::scalar::Dual;

    const INCH: f64 = 0.0254;

    fn uh60(blade_mass: f64) -> AirframeMass {
        let properties =
            MassProperties { gross_mass: 7257.4779, inertia: [6316.7558, 52215.261, 49888.677, 2551.6494] };
        AirframeMass::new(&properties, &blades(4.0 * blade_mass)).unwrap()
    }

    fn blades(mass: f64) -> [BladesAtHub; 1] {
        [BladesAtHub { hub: hub(), mass }]
    }

    fn hub() -> [f64; 3] {
        // gross centre of gravity STA 358.0, WL 248.2; hub STA 341.25, WL 315.0
        [16.75 * INCH, 0.0, -66.8 * INCH]
    }

    #[test]
    fn without_blades_the_published_mass_and_centre_of_gravity() {
        let a = uh60(116.52788);
        assert!((a.mass - 6791.3664).abs() < 1e-3);
        assert!((358.0 - a.cg[0] / INCH - 359.15).abs() < 0.005);
        assert!((248.2 - a.cg[2] / INCH - 243.615).abs() < 0.0005);
    }

    #[test]
    fn blades_at_the_hub_bring_the_centre_of_gravity_back_to_the_origin() {
        let a = uh60(118.89);
        for i in 0..3 {
            assert!((a.mass * a.cg[i] + 4.0 * 118.89 * hub()[i]).abs() < 1e-9);
        }
    }

    #[test]
    fn blades_at_the_hub_make_the_published_gross_inertia() {
        let a = uh60(116.52788);
        let blades = point_inertia(4.0 * 116.52788, hub());
        let gross = |i: usize, j: usize| a.inertia_origin[i][j] + blades[i][j];
        // the published figures convert blade weight with 32.17 ft/s2, which moves the blades' share by 1.5e-4
        let airframe = [6316.7558, 52215.261, 49888.677, -2551.6494];
        let published = [7750.94, 53739.607, 49978.839, -2192.0865];
        for (k, (i, j)) in [(0, 0), (1, 1), (2, 2), (0, 2)].into_iter().enumerate() {
            let share = published[k] - airframe[k];
            assert!(
                (gross(i, j) - airframe[k] - share).abs() < 2e-4 * share.abs(),
                "{i}{j}: {}",
                gross(i, j)
            );
        }
    }

    #[test]
    fn impossible_masses_are_refused() {
        let p = MassProperties { gross_mass: 400.0, inertia: [1.0, 1.0, 1.0, 0.0] };
        assert!(matches!(AirframeMass::new(&p, &blades(400.0)), Err(MassError::TooLight { .. })));
        let p = MassProperties { gross_mass: 400.0, inertia: [1.0, 1.0, 1.0, 1.5] };
        assert!(matches!(AirframeMass::new(&p, &[]), Err(MassError::Inertia(..))));
    }

    #[test]
    fn free_fall_leaves_no_load() {
        let g = Vec3::new(-0.3, 1.0, 9.7);
        let (force, moment) = uh60(118.89).inertial_residual(Vec3::zero(), Vec3::zero(), g, Vec3::zero(), g);
        assert!(force.norm() == 0.0 && moment.norm() == 0.0);
    }

    #[test]
    fn moment_about_the_origin_uses_the_inertia_about_the_origin() {
        let a = uh60(118.89);
        let rates_dot = Vec3::new(0.3, -0.2, 0.5);
        let zero = Vec3::<f64, Body>::zero();
        let (_, moment) = a.inertial_residual(zero, zero, zero, rates_dot, zero);
        let expected = -times(&a.inertia_origin, rates_dot);
        assert!((moment - expected).norm() < 1e-9);
    }

    #[test]
    fn derivatives_equal_central_differences() {
        let a = uh60(118.89);
        let x: [f64; 15] = std::array::from_fn(|i| (1.7 * i as f64).sin());
        let evaluate = |x: [f64; 15]| {
            let v = |i: usize| Vec3::<f64, Body>::new(x[i], x[i + 1], x[i + 2]);
            a.inertial_residual(v(0), v(3), v(6), v(9), v(12))
        };
        let v = |i: usize| -> Vec3<Dual<15>, Body> {
            Vec3::from_array(std::array::from_fn(|k| Dual::variable(x[i + k], i + k)))
        };
        let (force, moment) = a.inertial_residual(v(0), v(3), v(6), v(9), v(12));
        for i in 0..15 {
            let h = 1e-5;
            let (mut up, mut down) = (x, x);
            up[i] += h;
            down[i] -= h;
            let (up, down) = (evaluate(up), evaluate(down));
            for k in 0..3 {
                let f = (up.0.array()[k] - down.0.array()[k]) / (2.0 * h);
                let m = (up.1.array()[k] - down.1.array()[k]) / (2.0 * h);
                assert!((force.array()[k].eps[i] - f).abs() < 1e-4);
                assert!((moment.array()[k].eps[i] - m).abs() < 1e-4);
            }
        }
    }
}
