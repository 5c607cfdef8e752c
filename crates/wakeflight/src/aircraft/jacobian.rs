//! Exact derivatives of F by dual numbers, along the structure of the aircraft.
//!
//! A blade feels its own coordinates and the body's states; the body feels a blade through its loads on the hub
//! (and the flapping they share). So each blade is differentiated along its own coordinates and the body's alone, the
//! body along its states and the twelve loads, and the chain rule joins the two.

use super::model::{Aircraft, HeldInflow, Inputs};
use super::residual::RotorLoads;
use super::state::Layout;
use crate::blade::MAX_MODES;
use crate::blade::kinematics::ModalMotion;
use crate::blade::loads::{BladeInflow, BladeLoads};
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::{Dual, Real};
use crate::numerics::wide::{DIRECTIONS, Directional, Task, differentiate};

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

/// dF/dy and dF/dy_dot in blocks, with the room to find them: made once, filled again and again.
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
    by_loads: Block,
    by_flapping: Vec<f64>,
    y: Vec<D>,
    y_dot: Vec<D>,
    f: Vec<D>,
}

/// A direction: an entry of y, or of y_dot.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Direction {
    State(usize),
    Rate(usize),
}

/// Directions that a blade feels: its own coordinates and rates and the body's motion, or (`accelerations`) what acts
/// through accelerations alone: attitude by the weight, modal accelerations, the body's rates of state.
fn directions(l: &Layout, b: usize, accelerations: bool) -> ([Direction; MOST_DIRECTIONS], usize) {
    let mut all = [Direction::State(0); MOST_DIRECTIONS];
    let mut n = 0;
    let mut push = |direction| {
        all[n] = direction;
        n += 1;
    };
    if accelerations {
        Layout::ATTITUDE.map(Direction::State).for_each(&mut push);
        l.modal_rate(b).map(Direction::Rate).for_each(&mut push);
        (0..Layout::RATES.end).map(Direction::Rate).for_each(&mut push);
    } else {
        (l.modal(b).start..l.modal_rate(b).end).map(Direction::State).for_each(&mut push);
        (0..Layout::RATES.end).map(Direction::State).for_each(&mut push);
        l.inflow().map(Direction::State).for_each(&mut push);
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
    fn keep(&mut self, b: usize, directions: &[Direction], table: &LoadSlopes) {
        let (m, own) = (self.layout.n_modes, self.layout.modal(b).start);
        for (lane, &direction) in directions.iter().enumerate() {
            let (is_state, i) = match direction {
                Direction::State(i) => (true, i),
                Direction::Rate(i) => (false, i),
            };
            let is_own = (own..own + 2 * m).contains(&i);
            let column = match (is_own, is_state) {
                (true, true) => i - own,
                (true, false) => i - own - m,
                (false, _) => self.body_index(i),
            };
            let blade = &mut self.blades[b];
            let (rows, sums) = match (is_own, is_state) {
                (true, true) => (&mut blade.own, &mut blade.loads),
                (true, false) => (&mut blade.own_dot, &mut blade.loads_dot),
                (false, true) => (&mut blade.by_body, &mut blade.loads_by_body),
                (false, false) => (&mut blade.by_body_dot, &mut blade.loads_by_body_dot),
            };
            for k in 0..m {
                rows.set(k, column, table.modal[k][lane]);
            }
            for (k, load) in table.loads.iter().enumerate() {
                sums.set(k, column, load[lane]);
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
    directions: &'a [Direction],
    inertia_only: bool,
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
        for (lane, direction) in self.directions.iter().enumerate() {
            let number = match *direction {
                Direction::State(i) if i < body.len() => &mut body[i],
                Direction::State(i) if l.inflow().contains(&i) => &mut disk[i - l.inflow().start],
                Direction::State(i) if i < own + m => &mut modal.q[i - own],
                Direction::State(i) => &mut modal.q_dot[i - own - m],
                Direction::Rate(i) if i < body_dot.len() => &mut body_dot[i],
                Direction::Rate(i) => &mut modal.q_ddot[i - own - m],
            };
            number.set_slope(lane, 1.0);
        }
        let hub = a.hub_motion(&body, &body_dot);
        let psi = a.rotor.azimuth(a.rotor.omega * self.t, self.blade);
        let control = a.blade_pitch(self.inputs, self.t, psi);
        let loads = if self.inertia_only {
            a.rotor.blade_inertia(&hub, psi, &modal, &control)
        } else {
            let inflow = match self.inputs.inflow {
                HeldInflow::Dynamic => BladeInflow::Disk(disk),
                _ => a.blade_inflow::<S>(&[], self.inputs, self.blade),
            };
            a.rotor.blade_loads(a.air, &hub, psi, &modal, &control, &inflow)
        };
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
        self.fill(t, y, y_dot, inputs, &[true, false], slopes);
    }

    /// dF/dy_dot alone, which inertia gives at a third of the cost; dF/dy is left as it was.
    pub fn mass_slopes(&self, t: f64, y: &[f64], inputs: &Inputs, slopes: &mut Slopes) {
        self.fill(t, y, &vec![0.0; y.len()], inputs, &[true], slopes);
    }

    fn fill(&self, t: f64, y: &[f64], y_dot: &[f64], inputs: &Inputs, passes: &[bool], slopes: &mut Slopes) {
        slopes.set_point(y, y_dot);
        let mut rotor = RotorLoads::sum(&[]);
        for b in 0..self.rotor.n_blades {
            rotor.add(&self.blade_slopes(t, y, y_dot, inputs, b, passes, slopes));
        }
        self.body_slopes(t, y, inputs, &rotor, slopes);
        self.join(t, slopes);
    }

    /// Derivatives of one blade: all loads by what has no acceleration in it, inertia alone by the rest.
    fn blade_slopes(
        &self,
        t: f64,
        y: &[f64],
        y_dot: &[f64],
        inputs: &Inputs,
        b: usize,
        passes: &[bool],
        slopes: &mut Slopes,
    ) -> BladeLoads<f64> {
        let mut table =
            LoadSlopes { modal: [[0.0; DIRECTIONS]; MAX_MODES], loads: [[0.0; DIRECTIONS]; N_LOADS] };
        let mut loads = BladeLoads::zero();
        for &inertia_only in passes {
            let (all, n) = directions(&self.layout, b, inertia_only);
            for directions in all[..n].chunks(DIRECTIONS) {
                let pass = BladePass {
                    aircraft: self,
                    t,
                    y,
                    y_dot,
                    inputs,
                    blade: b,
                    directions,
                    inertia_only,
                    table: &mut table,
                };
                loads = differentiate(pass);
                slopes.keep(b, directions, &table);
            }
        }
        loads
    }

    /// Derivatives of the body rows by body states, their rates, the loads of the rotor and the flapping.
    fn body_slopes(&self, t: f64, y: &[f64], inputs: &Inputs, rotor: &RotorLoads<f64>, slopes: &mut Slopes) {
        let n = slopes.body.len();
        let beta_1c = self.flap_multiblade(t, y)[0];
        // rows of kinematics and inflow hold their own rate alone
        for i in 0..n {
            slopes.body_dot.values[i * n..(i + 1) * n].fill(0.0);
            if i >= Layout::RATES.end {
                slopes.body_dot.set(i, i, 1.0);
            }
        }
        let n_rates = Layout::RATES.end;
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
                        slopes.body_dot.set(i, k - n, slope);
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
    }

    /// Chain rule: what the blades' loads carry of the blades' and the body's own motion into the body rows.
    fn join(&self, t: f64, slopes: &mut Slopes) {
        let flap = self.rotor.blade.flap_mode;
        let n = slopes.body.len();
        for (b, blade) in slopes.blades.iter_mut().enumerate() {
            let (_, c) = self.rotor.azimuth(self.rotor.omega * t, b).sin_cos();
            let share = self.rotor.flap_per_coordinate() * 2.0 * c / self.rotor.n_blades as f64;
            product(&slopes.by_loads, &blade.loads, &mut blade.on_body, false);
            product(&slopes.by_loads, &blade.loads_dot, &mut blade.on_body_dot, false);
            product(&slopes.by_loads, &blade.loads_by_body, &mut slopes.body_y, true);
            product(&slopes.by_loads, &blade.loads_by_body_dot, &mut slopes.body_dot, true);
            for i in 0..n {
                let direct = blade.on_body.at(i, flap) + slopes.by_flapping[i] * share;
                blade.on_body.set(i, flap, direct);
            }
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
