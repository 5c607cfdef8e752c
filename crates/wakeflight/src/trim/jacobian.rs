//! Exact Jacobian of the trim equations along their structure.
//!
//! The blades see the unknowns that are not theirs (controls, attitude, path, inflow) through the motion of the hub, three pitch
//! controls and three inflow states; the equations of the head see the blades through their mean loads and the flapping. Both
//! halves are differentiated by themselves and joined by the chain rule.

use super::host::Host;
use super::problem::Inflow;
use super::residual::Trim;
use crate::blade::hub_loads::BladeLoads;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::{Dual, Real};
use crate::rotor::periodic_slopes::{AzimuthGiven, AzimuthInflow, N_GIVEN, N_LOADS, RevolutionSlopes};

/// Directions carried at once through the equations of the head, which has no more unknowns.
const LANES: usize = 16;
type D = Dual<LANES>;

impl<H: Host> Trim<'_, H> {
    /// Exact Jacobian of the residual at `x`, row-major (n, n); of sections that remember with their lags held.
    pub fn jacobian(&self, x: &[f64], out: &mut [f64]) {
        let (n, first) = (self.layout.len(), self.layout.harmonics().start);
        let width = n - first;
        let given = self.given_slopes(x);
        let carried = self.host.carried(&self.layout.head(x));
        let pitch: [f64; 4] = self.host.pitch(self.layout.head(x).controls);
        let disk = self.layout.head(x).inflow;
        let memory = self.memory(x);
        let slopes = self.host.rotor().revolution_slopes(&self.revolution(&carried, x), |l, psi| {
            let inflow = match &self.problem.inflow {
                Inflow::Dynamic => AzimuthInflow::Disk(disk),
                Inflow::Map { inflow, .. } => AzimuthInflow::Held(self.row(inflow, l)),
            };
            AzimuthGiven { pitch: self.host.blade_pitch(&pitch, psi), inflow, past: memory.periodic(l) }
        });
        out.fill(0.0);
        let by_loads = self.head_slopes(x, &slopes, out);

        let by_head = |weights: &[f64], row: &mut [f64]| {
            for (weight, number) in weights.iter().zip(&given) {
                for (r, slope) in row.iter_mut().zip(&number.eps) {
                    *r += weight * slope;
                }
            }
        };
        for row in 0..first {
            for load in 0..N_LOADS {
                let weight = by_loads[row * N_LOADS + load];
                let weighted: Vec<f64> =
                    slopes.loads_by_given[load * N_GIVEN..][..N_GIVEN].iter().map(|s| weight * s).collect();
                by_head(&weighted, &mut out[row * n..row * n + first]);
                let by_harmonics = &slopes.loads_by_harmonics[load * width..][..width];
                for (r, slope) in out[row * n + first..(row + 1) * n].iter_mut().zip(by_harmonics) {
                    *r += weight * slope;
                }
            }
        }
        for row in 0..width {
            let target = &mut out[(first + row) * n..(first + row + 1) * n];
            by_head(&slopes.rows_by_given[row * N_GIVEN..][..N_GIVEN], &mut target[..first]);
            target[first..].copy_from_slice(&slopes.rows_by_harmonics[row * width..][..width]);
        }
    }

    /// What the blades are given, by the unknowns of the head.
    fn given_slopes(&self, x: &[f64]) -> [D; N_GIVEN] {
        let mut x_s: Vec<D> = x.iter().map(|&v| D::cst(v)).collect();
        for (lane, value) in x_s[..self.layout.harmonics().start].iter_mut().enumerate() {
            value.eps[lane] = 1.0;
        }
        let head = self.layout.head(&x_s);
        let hub = self.host.carried(&head).hub;
        let mut given = [D::zero(); N_GIVEN];
        given[..3].copy_from_slice(&hub.velocity.array());
        given[3..6].copy_from_slice(&hub.acceleration_less_gravity.array());
        given[6..9].copy_from_slice(&hub.omega.array());
        given[9..12].copy_from_slice(&self.host.pitch(head.controls)[..3]);
        given[12..].copy_from_slice(&head.inflow);
        given
    }

    /// The equations of the head by its own unknowns and by the flapping, into `out`; and by the mean loads (head, N_LOADS).
    fn head_slopes(&self, x: &[f64], slopes: &RevolutionSlopes, out: &mut [f64]) -> Vec<f64> {
        let (n, harmonics) = (self.layout.len(), self.layout.harmonics());
        let first = harmonics.start;
        // cosine and sine of the flap mode
        let flap = harmonics.mode(self.host.rotor().blade.flap_mode) + 1;
        let n_flap = if harmonics.n_harmonics > 0 && harmonics.n_modes > 0 { 2 } else { 0 };
        let n_directions = first + N_LOADS + n_flap;
        let mut by_loads = vec![0.0; first * N_LOADS];
        let mut f = vec![D::zero(); n];
        for start in (0..n_directions).step_by(LANES) {
            let lanes = LANES.min(n_directions - start);
            let mut x_s: Vec<D> = x.iter().map(|&v| D::cst(v)).collect();
            let mut loads = loads_array(&slopes.mean).map(D::cst);
            for lane in 0..lanes {
                let k = start + lane;
                if k < first {
                    x_s[k].eps[lane] = 1.0;
                } else if k < first + N_LOADS {
                    loads[k - first].eps[lane] = 1.0;
                } else {
                    x_s[flap + k - first - N_LOADS].eps[lane] = 1.0;
                }
            }
            let head = self.layout.head(&x_s);
            self.head_rows(&head, &self.host.carried(&head), &x_s, &loads_of(&loads), &mut f);
            for (row, equation) in f[..first].iter().enumerate() {
                for lane in 0..lanes {
                    let k = start + lane;
                    let slope = equation.eps[lane];
                    if k < first {
                        out[row * n + k] = slope;
                    } else if k < first + N_LOADS {
                        by_loads[row * N_LOADS + k - first] = slope;
                    } else {
                        out[row * n + flap + k - first - N_LOADS] = slope;
                    }
                }
            }
        }
        by_loads
    }
}

fn loads_array(mean: &BladeLoads<f64>) -> [f64; N_LOADS] {
    let all = [mean.force, mean.moment, mean.aero_force, mean.aero_moment].map(Vec3::array);
    std::array::from_fn(|i| all[i / 3][i % 3])
}

fn loads_of(loads: &[D; N_LOADS]) -> BladeLoads<D> {
    let mut mean = BladeLoads::zero();
    let part = |k: usize| Vec3::new(loads[3 * k], loads[3 * k + 1], loads[3 * k + 2]);
    (mean.force, mean.moment, mean.aero_force, mean.aero_moment) = (part(0), part(1), part(2), part(3));
    mean
}
