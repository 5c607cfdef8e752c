//! Pitt-Peters three-state dynamic inflow.
//!
//! lambda(r, psi) = lambda_0 + lambda_s r sin psi + lambda_c r cos psi, r = 1 at the tip, psi = 0 aft, down positive.

use super::descent::{DescentFlow, descent_inflow};
use super::ground::ground_factor;
use super::momentum::TINY;
use crate::numerics::scalar::Real;
use serde::Deserialize;
use std::f64::consts::PI;

/// Apparent mass of the uniform state, M11.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ApparentMass {
    /// 128/(75 pi), of the corrected pressure distribution that carries no lift at the centre.
    Corrected,
    /// 8/(3 pi), of the impermeable disk.
    Uncorrected,
}

/// Which mean inflow enters the mass-flow parameters V_T and V_m.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MassFlow {
    /// The value of momentum theory at the thrust of the moment, in descent that of tests (`descent`).
    Momentum,
    /// The state lambda_0 itself.
    State,
}

/// The model with its choices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PittPeters {
    /// Apparent mass.
    pub apparent_mass: ApparentMass,
    /// Mass flow.
    pub mass_flow: MassFlow,
}

impl Default for PittPeters {
    fn default() -> Self {
        Self { apparent_mass: ApparentMass::Corrected, mass_flow: MassFlow::Momentum }
    }
}

/// Aerodynamic loads and motion of the rotor, in axes of the hub that do not turn with the wind.
#[derive(Clone, Copy, Debug)]
pub struct DiskCondition<S> {
    /// Thrust coefficient T/(rho pi R^2 (Omega R)^2), up positive.
    pub ct: S,
    /// Roll moment coefficient, right side down positive: L = -sum of m sin psi over the blades' lift moments m.
    pub cl: S,
    /// Pitch moment coefficient, nose up positive: M = -sum of m cos psi.
    pub cm: S,
    /// Velocity of the hub through the air over Omega R: forward in the disk plane.
    pub mu_x: S,
    /// To the right.
    pub mu_y: S,
    /// Down along the shaft.
    pub mu_z: S,
    /// Height of the hub above ground over R; none out of its effect.
    pub height: Option<S>,
}

/// Off-diagonal gain 15 pi/64 of the static matrix.
const GAIN: f64 = 15.0 * PI / 64.0;
/// Apparent mass of the cyclic states.
const CYCLIC_MASS: f64 = 16.0 / (45.0 * PI);

impl PittPeters {
    /// Rates of (lambda_0, lambda_s, lambda_c) [1/s], hub axes, at rotor speed `omega` [rad/s].
    ///
    /// (1/Omega) M lambda_dot + V L^-1 lambda = (CT, -CL, -CM) in wind axes [pitt1981], V = diag(V_T, V_m, V_m),
    /// V_T = sqrt(mu^2 + lambda^2), V_m = (mu^2 + lambda (lambda + lambda_0))/V_T,
    /// L = [[1/2, 0, -k X], [0, 2(1 + X^2), 0], [k X, 0, 2(1 - X^2)]], k = 15 pi/64, X = tan(chi/2),
    /// lambda = lambda_0 - mu_z, lambda_0 of `mass_flow`; V_m = d(lambda_0 V_T)/d lambda_0. In descent V_T is the flow of tests
    /// (`descent`), and V_m follows.
    ///
    /// The rotation to wind axes and back is carried out in closed form: only the vector X (cos beta_w, sin beta_w)
    /// = (mu_x, -mu_y)/(V_T + |lambda|) remains, so nothing is singular or frozen at mu = 0. The wind's turning rate
    /// does not enter because the apparent mass of the two cyclic states is equal.
    /// DEVIATION: the skew angle is arctan(mu/|lambda|); with the sign of lambda it would jump where the total inflow
    /// changes sign in descent.
    /// Not modelled: wake distortion by rates.
    pub fn inflow_dot<S: Real>(&self, inflow: [S; 3], disk: DiskCondition<S>, omega: f64) -> [S; 3] {
        let [lambda_0, lambda_s, lambda_c] = inflow;
        let mu_squared = disk.mu_x.squared() + disk.mu_y.squared();
        let (mean, excess) = match self.mass_flow {
            MassFlow::Momentum => {
                let mean = descent_inflow(disk.ct, mu_squared, disk.mu_z);
                (mean, DescentFlow::at(disk.ct, mu_squared, disk.mu_z, mean))
            }
            MassFlow::State => (lambda_0, None),
        };
        let total = mean - disk.mu_z;
        let (v_t, v_m) = match excess {
            None => {
                let v_t = (mu_squared + total.squared() + TINY).sqrt();
                (v_t, (mu_squared + total * (total + mean)) / v_t)
            }
            Some(excess) => {
                let squared = mu_squared + total.squared() + excess.squared;
                let v_t = squared.sqrt();
                (v_t, (squared + mean * (total + excess.half_slope)) / v_t)
            }
        };

        // near the ground less inflow belongs to the same loads
        let lambda_0 = match disk.height {
            None => lambda_0,
            Some(height) => lambda_0 / ground_factor(height, mu_squared, total),
        };
        let skew = S::one() / (v_t + total.abs());
        let (x_c, x_s) = (disk.mu_x * skew, -disk.mu_y * skew);
        let x_squared = mu_squared * skew.squared();
        // determinant of the (0, c) block of L, and of its s entry
        let det = S::one() - x_squared * (1.0 - GAIN * GAIN);
        let side = x_squared + 1.0;
        let along = x_c * lambda_c + x_s * lambda_s;
        let mean_row = v_t * ((S::one() - x_squared) * 2.0 * lambda_0 + along * GAIN) / det;
        // [1/(2 det) - 1/(2 (1 + X^2))] of the wind component, without dividing by X^2
        let skewed = (along * (0.5 * (2.0 - GAIN * GAIN)) / side - lambda_0 * GAIN) / det;
        let row_s = v_m * (lambda_s / (side * 2.0) + x_s * skewed);
        let row_c = v_m * (lambda_c / (side * 2.0) + x_c * skewed);

        let uniform_mass = match self.apparent_mass {
            ApparentMass::Corrected => 128.0 / (75.0 * PI),
            ApparentMass::Uncorrected => 8.0 / (3.0 * PI),
        };
        [
            (disk.ct - mean_row) * (omega / uniform_mass),
            (-disk.cl - row_s) * (omega / CYCLIC_MASS),
            (-disk.cm - row_c) * (omega / CYCLIC_MASS),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::super::momentum::momentum_inflow;
    use super::*;
    use crate::numerics::scalar::Dual;

    fn condition(ct: f64, mu_x: f64, mu_y: f64, mu_z: f64) -> DiskCondition<f64> {
        DiskCondition { ct, cl: 0.0, cm: 0.0, mu_x, mu_y, mu_z, height: None }
    }

    #[test]
    fn hover_gains_and_time_constants_are_the_closed_forms() {
        let (ct, omega) = (0.0066, 27.0);
        let mean = (0.5_f64 * ct).sqrt();
        let jacobian = |model: PittPeters| {
            let state = [mean, 0.0, 0.0].into_iter().enumerate();
            let mut x = [Dual::<3>::cst(0.0); 3];
            for (i, v) in state {
                x[i] = Dual::variable(v, i);
            }
            let c = Dual::<3>::cst;
            let disk = DiskCondition {
                ct: c(ct),
                mu_x: c(0.0),
                cl: c(0.0),
                cm: c(0.0),
                mu_y: c(0.0),
                mu_z: c(0.0),
                height: None,
            };
            model.inflow_dot(x, disk, omega)
        };
        for (apparent_mass, m11) in
            [(ApparentMass::Corrected, 128.0 / (75.0 * PI)), (ApparentMass::Uncorrected, 8.0 / (3.0 * PI))]
        {
            for (mass_flow, factor) in [(MassFlow::Momentum, 2.0), (MassFlow::State, 4.0)] {
                let rate = jacobian(PittPeters { apparent_mass, mass_flow });
                assert!(rate[0].re.abs() < 1e-9);
                let constant = m11 / (factor * mean * omega);
                assert!((-1.0 / rate[0].eps[0] / constant - 1.0).abs() < 1e-9);
                for i in 1..3 {
                    let cyclic = 16.0 / (45.0 * PI) / (mean * omega);
                    assert!((-1.0 / rate[i].eps[i] / cyclic - 1.0).abs() < 1e-9);
                }
            }
        }
        // steady cyclic inflow of steady hub moments
        let mut disk = condition(ct, 0.0, 0.0, 0.0);
        (disk.cl, disk.cm) = (2e-4, -3e-4);
        let steady = [mean, -disk.cl / mean, -disk.cm / mean];
        for rate in PittPeters::default().inflow_dot(steady, disk, omega) {
            assert!(rate.abs() < 1e-9);
        }
    }

    #[test]
    fn in_forward_flight_without_moments_the_inflow_grows_aft() {
        let disk = condition(0.0066, 0.185, 0.0, -0.01);
        let mean: f64 = momentum_inflow(disk.ct, 0.185 * 0.185, disk.mu_z);
        let total = mean - disk.mu_z;
        let x = (0.5 * 0.185_f64.atan2(total)).tan();
        let steady = [mean, 0.0, mean * 15.0 * PI / 32.0 * x];
        for rate in PittPeters::default().inflow_dot(steady, disk, 27.0) {
            assert!(rate.abs() < 1e-9);
        }
    }

    #[test]
    fn turning_the_wind_turns_the_answer() {
        // the disk has no preferred direction: states, moments and wind turned together give turned rates
        let model = PittPeters::default();
        let (mu, beta_w) = (0.2, 0.7_f64);
        let (s, c) = beta_w.sin_cos();
        let wind =
            DiskCondition { ct: 0.006, cl: 1e-4, cm: -2e-4, mu_x: mu, mu_y: 0.0, mu_z: 0.02, height: None };
        let inflow = [0.02, 0.004, 0.015];
        let reference = model.inflow_dot(inflow, wind, 27.0);
        // hub axes: azimuth in hub axes = azimuth from the wind + beta_w, the azimuth the wind blows to
        let turned = |s_w: f64, c_w: f64| (s_w * c + c_w * s, c_w * c - s_w * s);
        let (state_s, state_c) = turned(inflow[1], inflow[2]);
        let (cl, cm) = turned(wind.cl, wind.cm);
        let disk = DiskCondition { cl, cm, mu_x: mu * c, mu_y: -mu * s, ..wind };
        let rate = model.inflow_dot([inflow[0], state_s, state_c], disk, 27.0);
        let (expected_s, expected_c) = turned(reference[1], reference[2]);
        assert!((rate[0] - reference[0]).abs() < 1e-12);
        assert!((rate[1] - expected_s).abs() < 1e-12 && (rate[2] - expected_c).abs() < 1e-12);
    }

    #[test]
    fn mirrored_flight_has_mirrored_inflow() {
        let disk = DiskCondition {
            ct: 0.006,
            cl: 1e-4,
            cm: -2e-4,
            mu_x: 0.15,
            mu_y: 0.05,
            mu_z: 0.02,
            height: None,
        };
        let mirror = DiskCondition { cl: -disk.cl, mu_y: -disk.mu_y, ..disk };
        let model = PittPeters::default();
        let a = model.inflow_dot([0.02, 0.004, 0.015], disk, 27.0);
        let b = model.inflow_dot([0.02, -0.004, 0.015], mirror, 27.0);
        assert_eq!([a[0], a[1], a[2]], [b[0], -b[1], b[2]]);
    }

    #[test]
    fn derivatives_equal_central_differences_also_at_hover_and_in_descent() {
        for mass_flow in [MassFlow::Momentum, MassFlow::State] {
            let model = PittPeters { mass_flow, ..PittPeters::default() };
            for x in [
                [0.05, 0.0, 0.0, 0.005, 1e-5, 2e-5, 0.0, 0.0, 0.0],
                [0.02, 0.004, 0.015, 0.0066, 1e-4, -2e-4, 0.18, 0.03, -0.01],
                [0.02, 0.004, 0.015, 0.0066, 1e-4, -2e-4, 0.10, -0.03, 0.06],
            ] {
                let f = |x: [f64; 9]| evaluate(model, x);
                let d = evaluate(model, std::array::from_fn(|i| Dual::<9>::variable(x[i], i)));
                for i in 0..9 {
                    let h = 1e-7;
                    let (mut up, mut down) = (x, x);
                    up[i] += h;
                    down[i] -= h;
                    let (up, down) = (f(up), f(down));
                    for k in 0..3 {
                        let difference = (up[k] - down[k]) / (2.0 * h);
                        assert!(
                            (d[k].eps[i] - difference).abs() < 1e-5 * (1.0 + difference.abs()),
                            "{i} {k}"
                        );
                    }
                }
            }
        }
    }

    fn evaluate<S: Real>(model: PittPeters, x: [S; 9]) -> [S; 3] {
        let [a, b, c, ct, cl, cm, mu_x, mu_y, mu_z] = x;
        model.inflow_dot([a, b, c], DiskCondition { ct, cl, cm, mu_x, mu_y, mu_z, height: None }, 27.0)
    }

    #[test]
    fn a_rotor_at_rest_in_still_air_has_finite_rates_and_derivatives() {
        for model in
            [PittPeters::default(), PittPeters { mass_flow: MassFlow::State, ..PittPeters::default() }]
        {
            let d = evaluate(model, std::array::from_fn(|i| Dual::<9>::variable(0.0, i)));
            for k in d {
                assert!(k.re == 0.0 && k.eps.iter().all(|e| e.is_finite()));
            }
        }
    }
}
