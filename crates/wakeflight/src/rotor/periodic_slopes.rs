//! Exact derivatives of the mean loads and of the projected blade equations of a revolution.
//!
//! At one azimuth a blade feels its own coordinates, rates and accelerations, the motion of the hub, its pitch and its inflow:
//! it is differentiated along these alone. The harmonics follow by the chain rule, being the same cosines and sines at every
//! azimuth for every mode.

use super::hub::Rotor;
use super::periodic::Revolution;
use crate::blade::MAX_MODES;
use crate::blade::aerodynamics::Air;
use crate::blade::hub_loads::BladeLoads;
use crate::blade::hub_motion::HubMotion;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::sections_in_time::BladePast;
use crate::blade::surroundings::BladeInflow;
use crate::numerics::frames::Vec3;
use crate::numerics::wide::{DIRECTIONS, Directional, Task, differentiate};

/// Loads of the rotor on the hub: force, moment, and the share of the air in both.
pub const N_LOADS: usize = 12;
/// What is given to all azimuths: velocity, acceleration less gravity and rates of the hub, theta_1c, theta_1s, theta_0, and
/// lambda_0, lambda_s, lambda_c of an inflow over the disk.
pub const N_GIVEN: usize = 15;

/// Inflow at one azimuth.
#[derive(Clone, Copy, Debug)]
pub enum AzimuthInflow<'a> {
    /// lambda_0, lambda_s, lambda_c.
    Disk([f64; 3]),
    /// Held row of `Rotor::held_inflow`.
    Held(&'a [f64]),
}

/// What a blade is given at one azimuth.
#[derive(Clone, Copy, Debug)]
pub struct AzimuthGiven<'a> {
    /// Pitch.
    pub pitch: PitchMotion<f64>,
    /// Inflow.
    pub inflow: AzimuthInflow<'a>,
    /// What is known of the states of its sections, where they remember.
    pub past: Option<BladePast<'a>>,
}

/// Derivatives of a revolution; harmonic rows and columns in the order of `Harmonics`, counted from its start.
#[derive(Clone, Debug)]
pub struct RevolutionSlopes {
    /// Mean loads of all blades.
    pub mean: BladeLoads<f64>,
    /// Mean loads by harmonics (N_LOADS, n).
    pub loads_by_harmonics: Vec<f64>,
    /// Mean loads by what is given (N_LOADS, N_GIVEN).
    pub loads_by_given: Vec<f64>,
    /// Harmonic equations by harmonics (n, n).
    pub rows_by_harmonics: Vec<f64>,
    /// Harmonic equations by what is given (n, N_GIVEN).
    pub rows_by_given: Vec<f64>,
}

/// Most local directions: coordinates, rates, accelerations, and what is given.
const MOST_LOCAL: usize = 3 * MAX_MODES + N_GIVEN;
/// Modal rows, then loads.
const MOST_ROWS: usize = MAX_MODES + N_LOADS;

/// A blade at one azimuth, and the part of its local directions that are looked along.
struct AzimuthPass<'a> {
    rotor: &'a Rotor,
    air: Air,
    hub: &'a HubMotion<f64>,
    psi: f64,
    modal: &'a ModalMotion<f64>,
    given: AzimuthGiven<'a>,
    first: usize,
    table: &'a mut [[f64; MOST_LOCAL]; MOST_ROWS],
}

impl Task for AzimuthPass<'_> {
    type Output = BladeLoads<f64>;
    #[inline(always)]
    fn run<S: Directional>(self) -> BladeLoads<f64> {
        let (rotor, m) = (self.rotor, self.rotor.blade.n_modes);
        let n_local = 3 * m + N_GIVEN;
        let zero = [S::zero(); MAX_MODES];
        let mut modal = ModalMotion { q: zero, q_dot: zero, q_ddot: zero };
        for i in 0..m {
            modal.q[i] = S::cst(self.modal.q[i]);
            modal.q_dot[i] = S::cst(self.modal.q_dot[i]);
            modal.q_ddot[i] = S::cst(self.modal.q_ddot[i]);
        }
        let mut hub: HubMotion<S> = self.hub.constant();
        let mut pitch = PitchMotion {
            theta: S::cst(self.given.pitch.theta),
            theta_dot: S::cst(self.given.pitch.theta_dot),
            theta_ddot: S::cst(self.given.pitch.theta_ddot),
        };
        let mut disk = [S::zero(); 3];
        if let AzimuthInflow::Disk(states) = self.given.inflow {
            for (s, &v) in disk.iter_mut().zip(&states) {
                *s = S::cst(v);
            }
        }
        let (s, c) = (self.psi + rotor.rigging.phase).sin_cos();
        let (w, w2) = (rotor.omega, rotor.omega * rotor.omega);
        let lanes = DIRECTIONS.min(n_local - self.first);
        for lane in 0..lanes {
            let k = self.first + lane;
            if k < m {
                modal.q[k].set_slope(lane, 1.0);
            } else if k < 2 * m {
                modal.q_dot[k - m].set_slope(lane, 1.0);
            } else if k < 3 * m {
                modal.q_ddot[k - 2 * m].set_slope(lane, 1.0);
            } else {
                match k - 3 * m {
                    0 => hub.velocity.x.set_slope(lane, 1.0),
                    1 => hub.velocity.y.set_slope(lane, 1.0),
                    2 => hub.velocity.z.set_slope(lane, 1.0),
                    3 => hub.acceleration_less_gravity.x.set_slope(lane, 1.0),
                    4 => hub.acceleration_less_gravity.y.set_slope(lane, 1.0),
                    5 => hub.acceleration_less_gravity.z.set_slope(lane, 1.0),
                    6 => hub.omega.x.set_slope(lane, 1.0),
                    7 => hub.omega.y.set_slope(lane, 1.0),
                    8 => hub.omega.z.set_slope(lane, 1.0),
                    9 => {
                        pitch.theta.set_slope(lane, c);
                        pitch.theta_dot.set_slope(lane, -s * w);
                        pitch.theta_ddot.set_slope(lane, -c * w2);
                    }
                    10 => {
                        pitch.theta.set_slope(lane, s);
                        pitch.theta_dot.set_slope(lane, c * w);
                        pitch.theta_ddot.set_slope(lane, -s * w2);
                    }
                    11 => pitch.theta.set_slope(lane, 1.0),
                    state => disk[state - 12].set_slope(lane, 1.0),
                }
            }
        }
        let inflow = match self.given.inflow {
            AzimuthInflow::Disk(_) => BladeInflow::Disk(disk),
            AzimuthInflow::Held(row) => rotor.held_inflow(row),
        };
        let inflow = inflow.remembering(rotor.sections_in_time(self.given.past));
        let loads = rotor.blade_loads(self.air, &hub, S::cst(self.psi), &modal, &pitch, &inflow);
        let span = self.first..self.first + lanes;
        for i in 0..m {
            self.table[i][span.clone()].copy_from_slice(&loads.modal[i].slopes()[..lanes]);
        }
        let on_hub = [loads.force, loads.moment, loads.aero_force, loads.aero_moment].map(Vec3::array);
        for (row, load) in self.table[m..].iter_mut().zip(on_hub.as_flattened()) {
            row[span.clone()].copy_from_slice(&load.slopes()[..lanes]);
        }
        loads.values()
    }
}

impl Rotor {
    /// Derivatives of `Rotor::revolution` at its harmonics.
    pub fn revolution_slopes<'a>(
        &self,
        turn: &Revolution<f64>,
        given: impl Fn(usize, f64) -> AzimuthGiven<'a>,
    ) -> RevolutionSlopes {
        let Revolution { air, hub, harmonics, x, n_azimuths } = *turn;
        let m = harmonics.n_modes;
        let each = 1 + 2 * harmonics.n_harmonics;
        let n = m * each;
        let n_local = 3 * m + N_GIVEN;
        let share = self.n_blades as f64 / n_azimuths as f64;
        let angles: Vec<f64> = (0..m)
            .flat_map(|i| (0..=harmonics.n_harmonics).map(move |k| (i, k)))
            .map(|(i, k)| {
                self.angle_per_modal_force(i, k) * if k == 0 { 1.0 } else { 2.0 } / n_azimuths as f64
            })
            .collect();
        let mut out = RevolutionSlopes {
            mean: BladeLoads::zero(),
            loads_by_harmonics: vec![0.0; N_LOADS * n],
            loads_by_given: vec![0.0; N_LOADS * N_GIVEN],
            rows_by_harmonics: vec![0.0; n * n],
            rows_by_given: vec![0.0; n * N_GIVEN],
        };
        let mut table = [[0.0; MOST_LOCAL]; MOST_ROWS];
        // coordinate, rate and acceleration by mean, cosines and sines; and the share of an equation that each projection takes
        let mut motion = vec![[1.0, 0.0, 0.0]; each];
        let mut by_harmonics = vec![0.0; n];
        for l in 0..n_azimuths {
            let psi = turn.azimuth(l);
            let modal = harmonics.motion(x, psi, self.omega);
            let given = given(l, psi);
            let mut loads = BladeLoads::zero();
            for first in (0..n_local).step_by(DIRECTIONS) {
                let table = &mut table;
                loads = differentiate(AzimuthPass {
                    rotor: self,
                    air,
                    hub,
                    psi,
                    modal: &modal,
                    given,
                    first,
                    table,
                });
            }
            out.mean.force += loads.force.scaled(share);
            out.mean.moment += loads.moment.scaled(share);
            out.mean.aero_force += loads.aero_force.scaled(share);
            out.mean.aero_moment += loads.aero_moment.scaled(share);
            for k in 1..=harmonics.n_harmonics {
                let (s, c) = (k as f64 * psi).sin_cos();
                let w = k as f64 * self.omega;
                motion[2 * k - 1] = [c, -s * w, -c * w * w];
                motion[2 * k] = [s, c * w, -s * w * w];
            }
            for (r, row) in table[..m + N_LOADS].iter().enumerate() {
                for j in 0..m {
                    let local = [row[j], row[m + j], row[2 * m + j]];
                    for (column, by) in by_harmonics[j * each..(j + 1) * each].iter_mut().zip(&motion) {
                        *column = local[0] * by[0] + local[1] * by[1] + local[2] * by[2];
                    }
                }
                let by_given = &row[3 * m..n_local];
                if r >= m {
                    add(&mut out.loads_by_harmonics[(r - m) * n..][..n], share, &by_harmonics);
                    add(&mut out.loads_by_given[(r - m) * N_GIVEN..][..N_GIVEN], share, by_given);
                } else {
                    for (h, by) in motion.iter().enumerate() {
                        let weight = by[0] * angles[r * (1 + harmonics.n_harmonics) + h.div_ceil(2)];
                        let equation = r * each + h;
                        add(&mut out.rows_by_harmonics[equation * n..][..n], weight, &by_harmonics);
                        add(&mut out.rows_by_given[equation * N_GIVEN..][..N_GIVEN], weight, by_given);
                    }
                }
            }
        }
        out
    }
}

/// sum += weight * values.
fn add(sum: &mut [f64], weight: f64, values: &[f64]) {
    for (s, v) in sum.iter_mut().zip(values) {
        *s += weight * v;
    }
}
