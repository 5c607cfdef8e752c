//! Exact Jacobian of the trim equations along their structure.
//!
//! The blades see the unknowns that are not theirs (sticks, attitude, inflow) through the motion of the hub, three pitch controls
//! and three inflow states; the airframe sees the blades through their mean loads and the flapping. Both halves are
//! differentiated by themselves and joined by the chain rule.

use super::model::System;
use super::trim::{TrimInflow, TrimProblem};
use crate::blade::loads::BladeLoads;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::{Dual, Real};
use crate::rotor::periodic_slopes::{AzimuthInflow, N_GIVEN, N_LOADS};

/// Directions carried at once through the equations of the airframe.
const LANES: usize = 16;
type D = Dual<LANES>;

impl System {
    /// Exact Jacobian of the trim equations, row-major (n, n).
    pub fn trim_jacobian(&self, problem: &TrimProblem, x: &[f64], out: &mut [f64]) {
        let layout = self.trim_layout(problem);
        let harmonics = layout.harmonics();
        let (n, head) = (layout.len(), harmonics.start);
        let width = n - head;

        // what the blades are given, by the unknowns at the head
        let mut x_s: Vec<D> = x.iter().map(|&v| D::cst(v)).collect();
        for (lane, value) in x_s[..head].iter_mut().enumerate() {
            value.eps[lane] = 1.0;
        }
        let (y, hub_s) = self.trim_hub_state(problem, &layout, &x_s);
        let pitch_s = self.main().rigging.pitch([x_s[0], x_s[1], x_s[2], x_s[3]]);
        let mut given = [D::zero(); N_GIVEN];
        given[..3].copy_from_slice(&hub_s.velocity.array());
        given[3..6].copy_from_slice(&hub_s.acceleration_less_gravity.array());
        given[6..9].copy_from_slice(&hub_s.omega.array());
        given[9..12].copy_from_slice(&pitch_s[..3]);
        let dynamic = matches!(problem.inflow, TrimInflow::Dynamic);
        if dynamic {
            given[12..].copy_from_slice(&y[self.layout.main().inflow()]);
        }

        let plain = |v: &[D]| -> Vec<f64> { v.iter().map(|d| d.re).collect() };
        let (_, hub) = self.trim_hub_state(problem, &layout, x);
        let pitch = pitch_s.map(|d| d.re);
        let disk = plain(&given[12..]);
        let n_stations = self.main().blade.stations.len();
        let slopes =
            self.main().revolution_slopes(self.air, &hub, &harmonics, x, problem.n_azimuths, |l, psi| {
                let inflow = match &problem.inflow {
                    TrimInflow::Dynamic => AzimuthInflow::Disk([disk[0], disk[1], disk[2]]),
                    TrimInflow::Map { inflow, .. } => {
                        AzimuthInflow::Held(&inflow[l * n_stations..(l + 1) * n_stations])
                    }
                };
                (self.cyclic_pitch(&pitch, psi), inflow)
            });

        // equations of the airframe by the unknowns at the head, the mean loads, and the flapping
        let flap = layout.mode(self.main().blade.flap_mode) + 1;
        let n_flap = usize::from(layout.harmonics().n_harmonics > 0);
        let n_directions = head + N_LOADS + n_flap;
        let mut by_loads = vec![0.0; head * N_LOADS];
        out.fill(0.0);
        for first in (0..n_directions).step_by(LANES) {
            let lanes = LANES.min(n_directions - first);
            let mut x_s: Vec<D> = x.iter().map(|&v| D::cst(v)).collect();
            let mut loads = loads_array(&slopes.mean).map(D::cst);
            for lane in 0..lanes {
                let k = first + lane;
                if k < head {
                    x_s[k].eps[lane] = 1.0;
                } else if k < head + N_LOADS {
                    loads[k - head].eps[lane] = 1.0;
                } else {
                    x_s[flap].eps[lane] = 1.0;
                }
            }
            let (y, _) = self.trim_hub_state(problem, &layout, &x_s);
            let mut f = vec![D::zero(); n];
            self.trim_balances(problem, &layout, &x_s, &y, &loads_of(&loads), &mut f);
            for (row, equation) in f[..head].iter().enumerate() {
                for lane in 0..lanes {
                    let k = first + lane;
                    let slope = equation.eps[lane];
                    if k < head {
                        out[row * n + k] = slope;
                    } else if k < head + N_LOADS {
                        by_loads[row * N_LOADS + k - head] = slope;
                    } else {
                        out[row * n + flap] = slope;
                    }
                }
            }
        }

        let by_head = |weights: &[f64], row: &mut [f64]| {
            for (weight, number) in weights.iter().zip(&given) {
                for (r, slope) in row.iter_mut().zip(&number.eps) {
                    *r += weight * slope;
                }
            }
        };
        for row in 0..head {
            for load in 0..N_LOADS {
                let weight = by_loads[row * N_LOADS + load];
                let weighted: Vec<f64> =
                    slopes.loads_by_given[load * N_GIVEN..][..N_GIVEN].iter().map(|s| weight * s).collect();
                by_head(&weighted, &mut out[row * n..row * n + head]);
                let by_harmonics = &slopes.loads_by_harmonics[load * width..][..width];
                for (r, slope) in out[row * n + head..(row + 1) * n].iter_mut().zip(by_harmonics) {
                    *r += weight * slope;
                }
            }
        }
        for row in 0..width {
            let target = &mut out[(head + row) * n..(head + row + 1) * n];
            by_head(&slopes.rows_by_given[row * N_GIVEN..][..N_GIVEN], &mut target[..head]);
            target[head..].copy_from_slice(&slopes.rows_by_harmonics[row * width..][..width]);
        }
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
