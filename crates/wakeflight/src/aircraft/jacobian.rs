//! Exact derivatives of F by dual numbers, along the structure of the aircraft.
//!
//! A blade feels its own coordinates and the body's states; the body feels a blade through its loads on the hub
//! (and the flapping they share). So each blade is differentiated along its own coordinates and the body's alone, the
//! body along its states and the twelve loads, and the chain rule joins the two. What acts by accelerations (their own
//! derivatives, and the attitude, by the weight) follows from the mass matrices of the blades, which are not differentiated.

use super::model::{Aircraft, HeldInflow, Inputs};
use super::residual::RotorLoads;
use super::state::{Layout, body_vector};
use crate::blade::MAX_MODES;
use crate::blade::kinematics::ModalMotion;
use crate::blade::loads::{BladeInflow, BladeLoads};
use crate::blade::mass_matrix::BladeMass;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::{Dual, Real};
use crate::numerics::wide::{DIRECTIONS, Directional, Task, differentiate};
use crate::rotor::hub::DamperSlopes;

type D = Dual<DIRECTIONS>;

/// Loads of a blade on the hub: force, moment, and the share of the air in both.
const N_LOADS: usize = 12;

/// Dense block, row-major.
#[derive(Clone, Debug, Default)]
pub struct Block {
    /// Columns.
    pub columns: usize,
    /// Entries.
    pub values: Vec<f64>,
}

impl Block {
    fn new(rows: usize, columns: usize) -> Self {
        Self { columns, values: vec![0.0; rows * columns] }
    }
    /// Entry.
    #[inline(always)]
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.values[row * self.columns + column]
    }
    #[inline(always)]
    fn set(&mut self, row: usize, column: usize, value: f64) {
        self.values[row * self.columns + column] = value;
    }
}

/// Derivatives that one blade brings; modal rows are the equations of the modal rates.
#[derive(Clone, Debug)]
pub struct BladeSlopes {
    /// Modal rows by own coordinates and rates (n_modes, 2 n_modes).
    pub own: Block,
    /// The same without the lag damper.
    undamped: Block,
    /// Modal rows by own modal accelerations (n_modes, n_modes).
    pub own_dot: Block,
    /// Modal rows by body states (n_modes, n_body).
    pub by_body: Block,
    /// Modal rows by body rates of state (n_modes, n_body).
    pub by_body_dot: Block,
    /// Body rows by own coordinates and rates (n_body, 2 n_modes).
    pub on_body: Block,
    /// Body rows by own modal accelerations (n_body, n_modes).
    pub on_body_dot: Block,
    // loads on the hub by the same directions as the modal rows
    loads: Block,
    loads_dot: Block,
    loads_by_body: Block,
    loads_by_body_dot: Block,
}

/// dF/dy and dF/dy_dot of one aircraft in blocks, with the room to find them: made once, filled again and again.
///
/// The equations q_dot = s of the modal coordinates are left to whoever assembles a matrix.
#[derive(Clone, Debug)]
pub struct Slopes {
    layout: Layout,
    /// What each blade brings.
    pub blades: Vec<BladeSlopes>,
    /// Index in y of every body state.
    pub body: Vec<usize>,
    /// Body rows by body states (n_body, n_body).
    pub body_y: Block,
    /// Body rows by rates of body states (n_body, n_body).
    pub body_dot: Block,
    /// The same without the blades.
    body_alone_dot: Block,
    airframe_known: bool,
    /// Acceleration of the hub less gravity and angular acceleration, hub axes, by the body's (6, 6).
    hub_by_body: Option<[[f64; 6]; 6]>,
    by_loads: Block,
    by_flapping: Vec<f64>,
    y: Vec<D>,
    y_dot: Vec<D>,
    f: Vec<D>,
}

impl BladeSlopes {
    /// Own derivatives with those of the lag damper.
    fn add_damper(&mut self, damper: &DamperSlopes) {
        let columns = self.own.columns;
        for (i, row) in damper.iter().enumerate().take(columns / 2) {
            for (j, slope) in row.iter().enumerate().take(columns) {
                self.own.set(i, j, self.undamped.at(i, j) + slope);
            }
        }
    }
}

/// Entries of y along which a blade is differentiated: its own coordinates and rates, the body's motion, the inflow.
fn directions(l: &Layout, b: usize) -> ([usize; MOST_DIRECTIONS], usize) {
    let mut all = [0; MOST_DIRECTIONS];
    let mut n = 0;
    for i in (l.modal(b).start..l.modal_rate(b).end).chain(0..Layout::RATES.end).chain(l.inflow()) {
        all[n] = i;
        n += 1;
    }
    (all, n)
}

/// Own coordinates and rates, body velocity and rates, inflow.
const MOST_DIRECTIONS: usize = 2 * MAX_MODES + 9;

impl Slopes {
    /// Room for an aircraft with this layout.
    pub fn new(layout: Layout) -> Self {
        let m = layout.n_modes;
        let body: Vec<usize> = (0..Layout::POSITION.end).chain(layout.inflow().start..layout.len()).collect();
        let n = body.len();
        let blade = BladeSlopes {
            own: Block::new(m, 2 * m),
            undamped: Block::new(m, 2 * m),
            own_dot: Block::new(m, m),
            by_body: Block::new(m, n),
            by_body_dot: Block::new(m, n),
            on_body: Block::new(n, 2 * m),
            on_body_dot: Block::new(n, m),
            loads: Block::new(N_LOADS, 2 * m),
            loads_dot: Block::new(N_LOADS, m),
            loads_by_body: Block::new(N_LOADS, n),
            loads_by_body_dot: Block::new(N_LOADS, n),
        };
        Self {
            blades: vec![blade; layout.n_blades],
            body_y: Block::new(n, n),
            body_dot: Block::new(n, n),
            body_alone_dot: Block::new(n, n),
            airframe_known: false,
            hub_by_body: None,
            by_loads: Block::new(n, N_LOADS),
            by_flapping: vec![0.0; n],
            y: vec![D::zero(); layout.len()],
            y_dot: vec![D::zero(); layout.len()],
            f: vec![D::zero(); layout.len()],
            body,
            layout,
        }
    }

    /// Layout of the state.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Index among the body states of entry `i` of y.
    fn body_index(&self, i: usize) -> usize {
        if i < Layout::POSITION.end { i } else { i - self.layout.inflow().start + Layout::POSITION.end }
    }

    fn set_point(&mut self, y: &[f64], y_dot: &[f64]) {
        for (s, &v) in self.y.iter_mut().zip(y) {
            *s = D::cst(v);
        }
        for (s, &v) in self.y_dot.iter_mut().zip(y_dot) {
            *s = D::cst(v);
        }
    }

    /// Keeps the derivatives of a blade's modal rows and loads along `directions`.
    fn keep(&mut self, b: usize, directions: &[usize], table: &LoadSlopes) {
        let (m, own) = (self.layout.n_modes, self.layout.modal(b).start);
        for (lane, &i) in directions.iter().enumerate() {
            let is_own = (own..own + 2 * m).contains(&i);
            let column = if is_own { i - own } else { self.body_index(i) };
            let blade = &mut self.blades[b];
            let (rows, sums) = if is_own {
                (&mut blade.undamped, &mut blade.loads)
            } else {
                (&mut blade.by_body, &mut blade.loads_by_body)
            };
            for k in 0..m {
                rows.set(k, column, table.modal[k][lane]);
            }
            for (k, load) in table.loads.iter().enumerate() {
                sums.set(k, column, load[lane]);
            }
        }
    }

    /// Keeps what a blade's mass says: loads are minus its products with the accelerations. `weight_by_attitude`:
    /// derivatives of the hub's acceleration less gravity, hub axes, by the quaternion.
    fn keep_mass(
        &mut self,
        b: usize,
        mass: f64,
        blade_mass: &BladeMass<f64>,
        hub_by_body: &[[f64; 6]; 6],
        weight_by_attitude: &[[f64; 3]; 4],
    ) {
        let m = self.layout.n_modes;
        let blade = &mut self.blades[b];
        let first = blade_mass.first_moment.array();
        let [x, y, z] = first;
        // force by angular acceleration, -first x, and its transpose
        let cross = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
        let inertia = blade_mass.inertia.map(Vec3::array);
        // rows force, moment by columns acceleration, angular acceleration of the hub
        let mut hub = [[0.0; 6]; 6];
        for i in 0..3 {
            hub[i][i] = mass;
            for j in 0..3 {
                hub[i][3 + j] = cross[i][j];
                hub[3 + j][i] = cross[i][j];
                hub[3 + i][3 + j] = inertia[j][i];
            }
        }
        for (k, column) in (0..Layout::RATES.end).enumerate() {
            for (i, row) in hub.iter().enumerate() {
                let sum: f64 = (0..6).map(|j| row[j] * hub_by_body[j][k]).sum();
                blade.loads_by_body_dot.set(i, column, -sum);
            }
        }
        for (k, by_acceleration) in weight_by_attitude.iter().enumerate() {
            let column = Layout::ATTITUDE.start + k;
            for (i, row) in hub.iter().enumerate() {
                let sum: f64 = (0..3).map(|j| row[j] * by_acceleration[j]).sum();
                blade.loads_by_body.set(i, column, -sum);
            }
        }
        for i in 0..m {
            let (force, moment) = (blade_mass.force[i].array(), blade_mass.moment[i].array());
            let shared: [f64; 6] = std::array::from_fn(|k| if k < 3 { force[k] } else { moment[k - 3] });
            for j in 0..m {
                blade.own_dot.set(i, j, -blade_mass.own[i][j]);
            }
            for (k, value) in shared.iter().enumerate() {
                blade.loads_dot.set(k, i, -value);
                let sum: f64 = (0..6).map(|j| shared[j] * hub_by_body[j][k]).sum();
                blade.by_body_dot.set(i, k, -sum);
            }
            for (k, by_acceleration) in weight_by_attitude.iter().enumerate() {
                let sum: f64 = (0..3).map(|j| shared[j] * by_acceleration[j]).sum();
                blade.by_body.set(i, Layout::ATTITUDE.start + k, -sum);
            }
        }
    }

    /// a dF/dy + b dF/dy_dot as a dense matrix, row-major (n, n).
    pub fn dense(&self, a: f64, b: f64, out: &mut [f64]) {
        let (l, m, n) = (&self.layout, self.layout.n_modes, self.layout.len());
        out[..n * n].fill(0.0);
        for (k, blade) in self.blades.iter().enumerate() {
            let (q, s) = (l.modal(k).start, l.modal_rate(k).start);
            for i in 0..m {
                out[(q + i) * n + q + i] = b;
                out[(q + i) * n + s + i] = -a;
                for j in 0..2 * m {
                    out[(s + i) * n + q + j] = a * blade.own.at(i, j);
                }
                for j in 0..m {
                    out[(s + i) * n + s + j] += b * blade.own_dot.at(i, j);
                }
                for (j, &column) in self.body.iter().enumerate() {
                    out[(s + i) * n + column] = a * blade.by_body.at(i, j) + b * blade.by_body_dot.at(i, j);
                }
            }
            for (i, &row) in self.body.iter().enumerate() {
                for j in 0..2 * m {
                    out[row * n + q + j] = a * blade.on_body.at(i, j);
                }
                for j in 0..m {
                    out[row * n + s + j] += b * blade.on_body_dot.at(i, j);
                }
            }
        }
        for (i, &row) in self.body.iter().enumerate() {
            for (j, &column) in self.body.iter().enumerate() {
                out[row * n + column] = a * self.body_y.at(i, j) + b * self.body_dot.at(i, j);
            }
        }
    }
}

/// Derivatives of a blade's modal rows and loads on the hub, direction by direction.
struct LoadSlopes {
    modal: [[f64; DIRECTIONS]; MAX_MODES],
    loads: [[f64; DIRECTIONS]; N_LOADS],
}

/// Loads of one blade and their derivatives along some directions.
struct BladePass<'a> {
    aircraft: &'a Aircraft,
    t: f64,
    y: &'a [f64],
    y_dot: &'a [f64],
    inputs: &'a Inputs,
    blade: usize,
    directions: &'a [usize],
    table: &'a mut LoadSlopes,
}

impl Task for BladePass<'_> {
    type Output = BladeLoads<f64>;
    #[inline(always)]
    fn run<S: Directional>(self) -> BladeLoads<f64> {
        let (a, l) = (self.aircraft, &self.aircraft.layout);
        let (m, own) = (l.n_modes, l.modal(self.blade).start);
        let mut body = [S::zero(); Layout::POSITION.end];
        let mut body_dot = [S::zero(); Layout::RATES.end];
        let mut disk = [S::zero(); 3];
        let zero = [S::zero(); MAX_MODES];
        let mut modal = ModalMotion { q: zero, q_dot: zero, q_ddot: zero };
        for (s, &v) in body.iter_mut().zip(self.y) {
            *s = S::cst(v);
        }
        for (s, &v) in body_dot.iter_mut().zip(self.y_dot) {
            *s = S::cst(v);
        }
        for (s, &v) in disk.iter_mut().zip(&self.y[l.inflow()]) {
            *s = S::cst(v);
        }
        for i in 0..m {
            modal.q[i] = S::cst(self.y[own + i]);
            modal.q_dot[i] = S::cst(self.y[own + m + i]);
            modal.q_ddot[i] = S::cst(self.y_dot[own + m + i]);
        }
        for (lane, &i) in self.directions.iter().enumerate() {
            let number = if i < body.len() {
                &mut body[i]
            } else if l.inflow().contains(&i) {
                &mut disk[i - l.inflow().start]
            } else if i < own + m {
                &mut modal.q[i - own]
            } else {
                &mut modal.q_dot[i - own - m]
            };
            number.set_slope(lane, 1.0);
        }
        let hub = a.hub_motion(&body, &body_dot);
        let psi = a.rotor.azimuth(a.rotor.omega * self.t, self.blade);
        let control = a.blade_pitch(self.inputs, self.t, psi);
        let inflow = match self.inputs.inflow {
            HeldInflow::Dynamic => BladeInflow::Disk(disk),
            _ => a.blade_inflow::<S>(&[], self.inputs, self.blade),
        };
        let loads = a.rotor.undamped_loads(a.air, &hub, psi, &modal, &control, &inflow);
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

impl Aircraft {
    /// a dF/dy + b dF/dy_dot, row-major (n, n). The solver asks for (1, c_j), the mass matrix is (0, 1).
    #[allow(clippy::too_many_arguments, reason = "the arguments of F and the two weights")]
    pub fn jacobian(
        &self,
        t: f64,
        y: &[f64],
        y_dot: &[f64],
        inputs: &Inputs,
        a: f64,
        b: f64,
        out: &mut [f64],
    ) {
        let mut slopes = Slopes::new(self.layout);
        self.slopes(t, y, y_dot, inputs, &mut slopes);
        slopes.dense(a, b, out);
    }

    /// dF/dy and dF/dy_dot at (t, y, y_dot).
    pub fn slopes(&self, t: f64, y: &[f64], y_dot: &[f64], inputs: &Inputs, slopes: &mut Slopes) {
        slopes.set_point(y, y_dot);
        let mut rotor = RotorLoads::sum(&[]);
        for b in 0..self.rotor.n_blades {
            rotor.add(&self.blade_slopes(t, y, y_dot, inputs, b, slopes));
        }
        self.body_slopes(t, y, inputs, &rotor, slopes);
        self.masses(t, y, inputs, slopes);
        self.join(t, slopes);
        self.join_masses(slopes);
    }

    /// dF/dy_dot and what the lag dampers and the blades' weight have in dF/dy, at a small part of the cost; the rest is left as
    /// it was. The dampers belong here because their force has kinks.
    pub fn mass_slopes(&self, t: f64, y: &[f64], inputs: &Inputs, slopes: &mut Slopes) {
        if !slopes.airframe_known {
            // the airframe's own inertia and the way of loads to its balance, once
            slopes.set_point(y, &vec![0.0; y.len()]);
            self.body_slopes(t, y, inputs, &RotorLoads::sum(&[]), slopes);
        }
        self.masses(t, y, inputs, slopes);
        self.join_masses(slopes);
    }

    /// Mass matrices of the blades, their dampers, and what attitude does by the weight.
    fn masses(&self, t: f64, y: &[f64], inputs: &Inputs, slopes: &mut Slopes) {
        let hub_by_body = *slopes.hub_by_body.get_or_insert_with(|| self.hub_by_body());
        let no_rate = [Dual::<4>::zero(); Layout::RATES.end];
        let body: [Dual<4>; Layout::POSITION.end] = std::array::from_fn(|i| {
            let number = Dual::cst(y[i]);
            if Layout::ATTITUDE.contains(&i) {
                Dual::variable(y[i], i - Layout::ATTITUDE.start)
            } else {
                number
            }
        });
        let acceleration = self.hub_motion(&body, &no_rate).acceleration_less_gravity.array();
        let by_attitude = std::array::from_fn(|k| acceleration.map(|a| a.eps[k]));
        // accelerations are in none of it
        let still = y;
        let n = self.rotor.n_blades;
        let mass = self.rotor.blade.mass;
        for first in (0..n).step_by(4) {
            // fewer than four left: the last stands in for those that are not there
            let poses = std::array::from_fn(|k| {
                let b = (first + k).min(n - 1);
                let psi = self.rotor.azimuth(self.rotor.omega * t, b);
                (psi, self.modal_motion(y, still, b), self.blade_pitch::<f64>(inputs, t, psi))
            });
            let masses = self.rotor.four_mass_matrices(&poses);
            for (b, (blade, (_, modal, control))) in (first..n).zip(masses.iter().zip(&poses)) {
                slopes.keep_mass(b, mass, blade, &hub_by_body, &by_attitude);
                slopes.blades[b].add_damper(&self.rotor.damper_slopes(modal, control));
            }
        }
    }

    /// Acceleration of the hub less gravity and angular acceleration, hub axes, by (v_dot, omega_dot) of the body.
    pub(super) fn hub_by_body(&self) -> [[f64; 6]; 6] {
        let nothing = Vec3::zero();
        let mut by_body = [[0.0; 6]; 6];
        for k in 0..6 {
            let mut unit = [0.0; 6];
            unit[k] = 1.0;
            let (v_dot, omega_dot) = (body_vector(&unit, 0..3), body_vector(&unit, 3..6));
            let hub = self.rotor.hub_motion(nothing, nothing, v_dot, omega_dot, nothing);
            let (a, w) = (hub.acceleration_less_gravity.array(), hub.omega_dot.array());
            for i in 0..3 {
                by_body[i][k] = a[i];
                by_body[3 + i][k] = w[i];
            }
        }
        by_body
    }

    /// Derivatives of one blade's loads by everything but accelerations and attitude.
    fn blade_slopes(
        &self,
        t: f64,
        y: &[f64],
        y_dot: &[f64],
        inputs: &Inputs,
        b: usize,
        slopes: &mut Slopes,
    ) -> BladeLoads<f64> {
        let mut table =
            LoadSlopes { modal: [[0.0; DIRECTIONS]; MAX_MODES], loads: [[0.0; DIRECTIONS]; N_LOADS] };
        let mut loads = BladeLoads::zero();
        let (all, n) = directions(&self.layout, b);
        for directions in all[..n].chunks(DIRECTIONS) {
            let pass =
                BladePass { aircraft: self, t, y, y_dot, inputs, blade: b, directions, table: &mut table };
            loads = differentiate(pass);
            slopes.keep(b, directions, &table);
        }
        loads
    }

    /// Derivatives of the body rows by body states, their rates, the loads of the rotor and the flapping.
    fn body_slopes(&self, t: f64, y: &[f64], inputs: &Inputs, rotor: &RotorLoads<f64>, slopes: &mut Slopes) {
        let n = slopes.body.len();
        let beta_1c = self.flap_multiblade(t, y)[0];
        // the airframe's own inertia does not change: found once
        let n_rates = if slopes.airframe_known { 0 } else { Layout::RATES.end };
        // rows of kinematics and inflow hold their own rate alone
        for i in Layout::RATES.end..n {
            slopes.body_alone_dot.set(i, i, 1.0);
        }
        let n_directions = n + n_rates + N_LOADS + 1;
        for first in (0..n_directions).step_by(DIRECTIONS) {
            let lanes = DIRECTIONS.min(n_directions - first);
            let mut loads: [D; N_LOADS] = loads_array(rotor).map(D::cst);
            let mut flapping = D::cst(beta_1c);
            for lane in 0..lanes {
                let k = first + lane;
                if k < n {
                    slopes.y[slopes.body[k]].eps[lane] = 1.0;
                } else if k < n + n_rates {
                    slopes.y_dot[k - n].eps[lane] = 1.0;
                } else if k < n + n_rates + N_LOADS {
                    loads[k - n - n_rates].eps[lane] = 1.0;
                } else {
                    flapping.eps[lane] = 1.0;
                }
            }
            let felt = rotor_of(&loads);
            self.body_rows(t, &slopes.y, &slopes.y_dot, inputs, &felt, flapping, &mut slopes.f);
            for lane in 0..lanes {
                let k = first + lane;
                for i in 0..n {
                    let slope = slopes.f[slopes.body[i]].eps[lane];
                    if k < n {
                        slopes.body_y.set(i, k, slope);
                    } else if k < n + n_rates {
                        slopes.body_alone_dot.set(i, k - n, slope);
                    } else if k < n + n_rates + N_LOADS {
                        slopes.by_loads.set(i, k - n - n_rates, slope);
                    } else {
                        slopes.by_flapping[i] = slope;
                    }
                }
                if k < n {
                    slopes.y[slopes.body[k]].eps[lane] = 0.0;
                } else if k < n + n_rates {
                    slopes.y_dot[k - n].eps[lane] = 0.0;
                }
            }
        }
        slopes.airframe_known = true;
    }

    /// Chain rule: what the blades' loads carry of the blades' and the body's own motion into the body rows.
    fn join(&self, t: f64, slopes: &mut Slopes) {
        let flap = self.rotor.blade.flap_mode;
        let n = slopes.body.len();
        for (b, blade) in slopes.blades.iter_mut().enumerate() {
            let (_, c) = self.rotor.azimuth(self.rotor.omega * t, b).sin_cos();
            let share = self.rotor.flap_per_coordinate() * 2.0 * c / self.rotor.n_blades as f64;
            product(&slopes.by_loads, &blade.loads, &mut blade.on_body, false);
            product(&slopes.by_loads, &blade.loads_by_body, &mut slopes.body_y, true);
            for i in 0..n {
                let direct = blade.on_body.at(i, flap) + slopes.by_flapping[i] * share;
                blade.on_body.set(i, flap, direct);
            }
        }
    }

    /// The same for what acts by accelerations.
    fn join_masses(&self, slopes: &mut Slopes) {
        slopes.body_dot.values.copy_from_slice(&slopes.body_alone_dot.values);
        for blade in &mut slopes.blades {
            product(&slopes.by_loads, &blade.loads_dot, &mut blade.on_body_dot, false);
            product(&slopes.by_loads, &blade.loads_by_body_dot, &mut slopes.body_dot, true);
        }
    }
}

/// out = a b, or out += a b.
fn product(a: &Block, b: &Block, out: &mut Block, add: bool) {
    let columns = b.columns;
    for (row, result) in out.values.chunks_exact_mut(columns).enumerate() {
        if !add {
            result.fill(0.0);
        }
        for (k, factors) in b.values.chunks_exact(columns).enumerate() {
            let weight = a.at(row, k);
            for (r, f) in result.iter_mut().zip(factors) {
                *r += weight * f;
            }
        }
    }
}

fn loads_array(r: &RotorLoads<f64>) -> [f64; N_LOADS] {
    let all = [r.force, r.moment, r.aero_force, r.aero_moment].map(Vec3::array);
    std::array::from_fn(|i| all[i / 3][i % 3])
}

fn rotor_of(loads: &[D; N_LOADS]) -> RotorLoads<D> {
    let part = |k: usize| Vec3::new(loads[3 * k], loads[3 * k + 1], loads[3 * k + 2]);
    RotorLoads { force: part(0), moment: part(1), aero_force: part(2), aero_moment: part(3) }
}
