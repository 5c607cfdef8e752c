//! Loads of one blade differentiated along its own coordinates, the carrier's motion and the inflow of its rotor.

use super::{BladeSlopes, N_LOADS};
use crate::blade::MAX_MODES;
use crate::blade::hub_loads::BladeLoads;
use crate::blade::kinematics::ModalMotion;
use crate::numerics::frames::Vec3;
use crate::numerics::wide::{DIRECTIONS, Directional, FEW, Task, differentiate, differentiate_few};
use crate::rotor::hub::DamperSlopes;
use crate::rotor::speed::{Spin, Turning};
use crate::system::instant::{HeldInflow, Instant};
use crate::system::layout::Layout;
use crate::system::model::System;

/// Own coordinates and rates, carrier velocity and rates, inflow, azimuth and speed, attitude.
const MOST_DIRECTIONS: usize = 2 * MAX_MODES + 15;

/// Derivatives of a blade's modal rows and loads on the hub, direction by direction.
struct LoadSlopes {
    modal: [[f64; DIRECTIONS]; MAX_MODES],
    loads: [[f64; DIRECTIONS]; N_LOADS],
}

/// Loads of blade `b` of rotor `r` and their derivatives along some directions.
struct BladePass<'a> {
    system: &'a System,
    at: &'a Instant<'a, f64>,
    r: usize,
    b: usize,
    directions: &'a [usize],
    table: &'a mut LoadSlopes,
}

impl Task for BladePass<'_> {
    type Output = BladeLoads<f64>;
    #[inline(always)]
    fn run<S: Directional>(self) -> BladeLoads<f64> {
        let (system, at, r) = (self.system, self.at, self.r);
        let (layout, l) = (&system.layout, &system.layout.rotors[r]);
        let (m, own, states) = (l.n_modes, l.modal(self.b).start, l.inflow());
        let mut carrier = [S::zero(); Layout::POSITION.end];
        let mut carrier_dot = [S::zero(); Layout::RATES.end];
        let mut disk = [S::zero(); 3];
        let zero = [S::zero(); MAX_MODES];
        let mut modal = ModalMotion { q: zero, q_dot: zero, q_ddot: zero };
        for (s, &v) in carrier.iter_mut().zip(&at.y[layout.carrier()]) {
            *s = S::cst(v);
        }
        for (s, &v) in carrier_dot.iter_mut().zip(&at.y_dot[layout.carrier_motion()]) {
            *s = S::cst(v);
        }
        for (s, &v) in disk.iter_mut().zip(&at.y[states.clone()]) {
            *s = S::cst(v);
        }
        let (place, turn) = (l.spin(), l.spin_states());
        let mut turned = [S::zero(); 2];
        for (s, &v) in turned.iter_mut().zip(&at.y[turn.clone()]) {
            *s = S::cst(v);
        }
        for i in 0..m {
            modal.q[i] = S::cst(at.y[own + i]);
            modal.q_dot[i] = S::cst(at.y[own + m + i]);
            modal.q_ddot[i] = S::cst(at.y_dot[own + m + i]);
        }
        // the attitude turns a wind; what it does by the weight comes with the masses
        let mut air = carrier;
        for (lane, &i) in self.directions.iter().enumerate() {
            let number = if layout.attitude().contains(&i) {
                &mut air[i]
            } else if turn.contains(&i) {
                &mut turned[i - turn.start]
            } else if layout.carrier().contains(&i) {
                &mut carrier[i]
            } else if states.contains(&i) {
                &mut disk[i - states.start]
            } else if i < own + m {
                &mut modal.q[i - own]
            } else {
                &mut modal.q_dot[i - own - m]
            };
            number.set_slope(lane, 1.0);
        }
        let spin = match place {
            Some(place) => Spin {
                psi: turned[0],
                turning: Turning { omega: turned[1], omega_dot: S::cst(at.y_dot[place.speed]) },
            },
            None => system.spin(r, at).constant(),
        };
        let hub = system.hub_motion(r, &carrier, &carrier_dot);
        let hub = system.felt_hub(r, &air, at.inputs, (hub, &spin.turning));
        let psi = system.rotors[r].azimuth(spin.psi, self.b);
        let control = system.blade_pitch(r, at.inputs, (at.t, &spin), self.b);
        let inflow = match at.inputs.inflow[r] {
            HeldInflow::Dynamic => system
                .disk_inflow(r, disk, at.inputs, self.b)
                .remembering(system.sections_in_time(r, at.t, at.inputs, self.b)),
            _ => system.blade_inflow(r, (at.t, &[]), at.inputs, self.b),
        };
        let loads = system.rotors[r].undamped_loads(system.air, &hub, psi, &modal, &control, &inflow);
        for i in 0..m {
            self.table.modal[i] = loads.modal[i].slopes();
        }
        let on_hub = [loads.force, loads.moment, loads.aero_force, loads.aero_moment].map(Vec3::array);
        for (slopes, load) in self.table.loads.iter_mut().zip(on_hub.as_flattened()) {
            *slopes = load.slopes();
        }
        loads.values()
    }
}

impl BladeSlopes {
    /// Own derivatives with those of the lag damper.
    pub(super) fn add_damper(&mut self, damper: &DamperSlopes) {
        let columns = self.own.columns;
        for (i, row) in damper.iter().enumerate().take(columns / 2) {
            for (j, slope) in row.iter().enumerate().take(columns) {
                self.own.set(i, j, self.undamped.at(i, j) + slope);
            }
        }
    }

    /// Derivatives by the part `left` of an `attitude` from those by the others: the length of a quaternion turns nothing, the sum
    /// of all by their parts is zero.
    fn close_attitude(&mut self, attitude: &[f64], left: usize) {
        let (m, size) = (self.n_modes(), -attitude[left]);
        for (rows, n) in [(&mut self.by_wind, m), (&mut self.loads_by_wind, N_LOADS)] {
            for i in 0..n {
                let others = (0..attitude.len()).filter(|&k| k != left);
                let sum: f64 = others.map(|k| attitude[k] * rows.at(i, k)).sum();
                rows.set(i, left, sum / size);
            }
        }
    }

    /// Keeps the derivatives of the modal rows and loads along `directions`; `place` finds shared states.
    fn keep(&mut self, directions: &[usize], layout: &Layout, place: &[usize], table: &LoadSlopes) {
        let (m, own) = (self.n_modes(), self.modal.start);
        for (lane, &i) in directions.iter().enumerate() {
            let is_own = (own..own + 2 * m).contains(&i);
            let (attitude, by_wind) = (layout.attitude(), layout.attitude().contains(&i));
            let column = match (is_own, by_wind) {
                (true, _) => i - own,
                (_, true) => i - attitude.start,
                _ => place[i],
            };
            let (rows, sums) = if is_own {
                (&mut self.undamped, &mut self.loads)
            } else if by_wind {
                (&mut self.by_wind, &mut self.loads_by_wind)
            } else {
                (&mut self.by_shared, &mut self.loads_by_shared)
            };
            for k in 0..m {
                rows.set(k, column, table.modal[k][lane]);
            }
            for (k, load) in table.loads.iter().enumerate() {
                sums.set(k, column, load[lane]);
            }
        }
    }
}

impl System {
    /// Derivatives of the loads of blade `b` of its rotor by everything but accelerations and attitude.
    pub(super) fn blade_slopes(
        &self,
        at: &Instant<f64>,
        b: usize,
        slopes: &mut BladeSlopes,
        place: &[usize],
    ) -> BladeLoads<f64> {
        let mut table =
            LoadSlopes { modal: [[0.0; DIRECTIONS]; MAX_MODES], loads: [[0.0; DIRECTIONS]; N_LOADS] };
        let mut loads = BladeLoads::zero();
        let r = slopes.rotor;
        let (all, n, left) = directions(&self.layout, (r, b), at);
        for directions in all[..n].chunks(DIRECTIONS) {
            let pass = BladePass { system: self, at, r, b, directions, table: &mut table };
            loads = if directions.len() > FEW { differentiate(pass) } else { differentiate_few(pass) };
            slopes.keep(directions, &self.layout, place, &table);
        }
        if let Some(left) = left {
            slopes.close_attitude(&at.y[self.layout.attitude()], left);
        }
        loads
    }
}

/// Entries of y along which a blade is differentiated: its own coordinates and rates, the carrier's motion, the inflow, azimuth and
/// speed, and where there is wind the attitude that turns it, but for the part of it that is left to the others.
fn directions(
    layout: &Layout,
    (r, b): (usize, usize),
    at: &Instant<f64>,
) -> ([usize; MOST_DIRECTIONS], usize, Option<usize>) {
    let l = &layout.rotors[r];
    let mut all = [0; MOST_DIRECTIONS];
    let mut n = 0;
    let turned = if at.inputs.disturbance.is_some() { layout.attitude() } else { 0..0 };
    let first = turned.start;
    let left = turned.clone().max_by(|&i, &j| at.y[i].abs().total_cmp(&at.y[j].abs()));
    let shared = layout.carrier_motion().chain(l.inflow()).chain(l.spin_states());
    let shared = shared.chain(turned.filter(|&i| Some(i) != left));
    for i in (l.modal(b).start..l.modal_rate(b).end).chain(shared) {
        all[n] = i;
        n += 1;
    }
    (all, n, left.map(|i| i - first))
}
