//! Exact derivatives of F by dual numbers, along the structure of the system.
//!
//! A blade feels its own coordinates, those of the carrier and the inflow of its rotor; the shared states (carrier and inflow)
//! feel a blade through its loads on the hub (and the flapping the blades of a rotor share). So each blade is differentiated
//! along its own coordinates and the shared ones, the shared rows along their states and the twelve loads of every rotor, and
//! the chain rule joins the two. What acts by accelerations (their own derivatives, and the attitude, by the weight) follows
//! from the mass matrices of the blades, which are not differentiated.
mod blade_pass;
mod join;
mod masses;
mod shared_pass;
mod turn;

use super::instant::Instant;
use super::layout::Layout;
use super::model::System;
use super::rotor_loads::{RotorLoads, RotorShare};
use crate::numerics::scalar::{Dual, Real};
use crate::numerics::wide::DIRECTIONS;
use crate::vortex::threads::share;
use std::ops::Range;

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
    /// Rotor of the list.
    pub rotor: usize,
    /// Modal coordinates in y.
    pub modal: Range<usize>,
    /// Their rates.
    pub modal_rate: Range<usize>,
    /// Modal rows by own coordinates and rates (n_modes, 2 n_modes).
    pub own: Block,
    /// The same without the lag damper.
    undamped: Block,
    /// Modal rows by own modal accelerations (n_modes, n_modes).
    pub own_dot: Block,
    /// Modal rows by shared states (n_modes, n_shared).
    pub by_shared: Block,
    /// Modal rows by rates of shared states (n_modes, n_shared).
    pub by_shared_dot: Block,
    /// Shared rows by own coordinates and rates (n_shared, 2 n_modes).
    pub on_shared: Block,
    /// Shared rows by own modal accelerations (n_shared, n_modes).
    pub on_shared_dot: Block,
    // loads on the hub by the same directions as the modal rows
    loads: Block,
    loads_dot: Block,
    loads_by_shared: Block,
    loads_by_shared_dot: Block,
    // modal rows and loads by the attitude, through a wind
    by_wind: Block,
    loads_by_wind: Block,
}

/// What the shared rows feel of a rotor.
#[derive(Clone, Debug)]
struct RotorSlopes {
    /// Shared rows by the loads of the rotor (n_shared, 12).
    by_loads: Block,
    /// Shared rows by its flapping.
    by_flapping: Vec<f64>,
    /// Acceleration of the hub less gravity and angular acceleration, hub axes, by the carrier's (6, 6).
    hub_by_carrier: Option<[[f64; 6]; 6]>,
}

/// dF/dy and dF/dy_dot of one system in blocks, with the room to find them: made once, filled again and again.
///
/// The equations q_dot = s of the modal coordinates are left to whoever assembles a matrix.
#[derive(Clone, Debug)]
pub struct Slopes {
    layout: Layout,
    /// What each blade brings, rotor after rotor.
    pub blades: Vec<BladeSlopes>,
    rotors: Vec<RotorSlopes>,
    /// Index in y of every shared state.
    pub shared: Vec<usize>,
    /// Index among the shared states of every entry of y that is one.
    place: Vec<usize>,
    /// Shared rows by shared states (n_shared, n_shared).
    pub shared_y: Block,
    /// Shared rows by rates of shared states (n_shared, n_shared).
    pub shared_dot: Block,
    /// The same without the blades.
    alone_dot: Block,
    carrier_known: bool,
    y: Vec<D>,
    y_dot: Vec<D>,
    f: Vec<D>,
}

impl BladeSlopes {
    fn new(rotor: usize, modal: Range<usize>, modal_rate: Range<usize>, n: usize) -> Self {
        let m = modal.len();
        Self {
            rotor,
            modal,
            modal_rate,
            own: Block::new(m, 2 * m),
            undamped: Block::new(m, 2 * m),
            own_dot: Block::new(m, m),
            by_shared: Block::new(m, n),
            by_shared_dot: Block::new(m, n),
            on_shared: Block::new(n, 2 * m),
            on_shared_dot: Block::new(n, m),
            loads: Block::new(N_LOADS, 2 * m),
            loads_dot: Block::new(N_LOADS, m),
            loads_by_shared: Block::new(N_LOADS, n),
            loads_by_shared_dot: Block::new(N_LOADS, n),
            by_wind: Block::new(m, Layout::ATTITUDE.len()),
            loads_by_wind: Block::new(N_LOADS, Layout::ATTITUDE.len()),
        }
    }

    /// Modes of the blade.
    pub fn n_modes(&self) -> usize {
        self.modal.len()
    }
}

impl Slopes {
    /// Room for a system with this layout.
    pub fn new(layout: &Layout) -> Self {
        let shared = layout.shared();
        let n = shared.len();
        let mut place = vec![usize::MAX; layout.len()];
        for (k, &i) in shared.iter().enumerate() {
            place[i] = k;
        }
        let blades = layout.rotors.iter().enumerate();
        let blades = blades.flat_map(|(r, l)| {
            (0..l.n_blades).map(move |b| BladeSlopes::new(r, l.modal(b), l.modal_rate(b), n))
        });
        let rotor =
            RotorSlopes { by_loads: Block::new(n, N_LOADS), by_flapping: vec![0.0; n], hub_by_carrier: None };
        Self {
            blades: blades.collect(),
            rotors: vec![rotor; layout.rotors.len()],
            shared_y: Block::new(n, n),
            shared_dot: Block::new(n, n),
            alone_dot: Block::new(n, n),
            carrier_known: false,
            y: vec![D::zero(); layout.len()],
            y_dot: vec![D::zero(); layout.len()],
            f: vec![D::zero(); layout.len()],
            shared,
            place,
            layout: layout.clone(),
        }
    }

    /// Layout of the state.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    fn set_point(&mut self, y: &[f64], y_dot: &[f64]) {
        for (s, &v) in self.y.iter_mut().zip(y) {
            *s = D::cst(v);
        }
        for (s, &v) in self.y_dot.iter_mut().zip(y_dot) {
            *s = D::cst(v);
        }
    }

    /// a dF/dy + b dF/dy_dot as a dense matrix, row-major (n, n).
    pub fn dense(&self, a: f64, b: f64, out: &mut [f64]) {
        let n = self.layout.len();
        out[..n * n].fill(0.0);
        for blade in &self.blades {
            let (q, s, m) = (blade.modal.start, blade.modal_rate.start, blade.n_modes());
            for i in 0..m {
                out[(q + i) * n + q + i] = b;
                out[(q + i) * n + s + i] = -a;
                for j in 0..2 * m {
                    out[(s + i) * n + q + j] = a * blade.own.at(i, j);
                }
                for j in 0..m {
                    out[(s + i) * n + s + j] += b * blade.own_dot.at(i, j);
                }
                for (j, &column) in self.shared.iter().enumerate() {
                    out[(s + i) * n + column] =
                        a * blade.by_shared.at(i, j) + b * blade.by_shared_dot.at(i, j);
                }
            }
            for (i, &row) in self.shared.iter().enumerate() {
                for j in 0..2 * m {
                    out[row * n + q + j] = a * blade.on_shared.at(i, j);
                }
                for j in 0..m {
                    out[row * n + s + j] += b * blade.on_shared_dot.at(i, j);
                }
            }
        }
        for (i, &row) in self.shared.iter().enumerate() {
            for (j, &column) in self.shared.iter().enumerate() {
                out[row * n + column] = a * self.shared_y.at(i, j) + b * self.shared_dot.at(i, j);
            }
        }
    }
}

impl System {
    /// a dF/dy + b dF/dy_dot, row-major (n, n). The solver asks for (1, c_j), the mass matrix is (0, 1).
    pub fn jacobian(&self, at: &Instant<f64>, a: f64, b: f64, out: &mut [f64]) {
        let mut slopes = Slopes::new(&self.layout);
        self.slopes(at, &mut slopes);
        slopes.dense(a, b, out);
    }

    /// dF/dy and dF/dy_dot at an instant.
    pub fn slopes(&self, at: &Instant<f64>, slopes: &mut Slopes) {
        slopes.set_point(at.y, at.y_dot);
        let mut shares = Vec::with_capacity(self.rotors.len());
        let mut first = 0;
        for (r, rotor, _) in self.each_rotor() {
            let (blades, place) = (&mut slopes.blades[first..first + rotor.n_blades], &slopes.place);
            let mut on_hub = vec![None; rotor.n_blades];
            share(blades.iter_mut().zip(&mut on_hub).enumerate(), |(b, (blade, on_hub))| {
                *on_hub = Some(self.blade_slopes(at, b, blade, place));
                self.damper_by_turn(at, b, blade, place);
            });
            let mut loads = RotorLoads::zero();
            on_hub.iter().flatten().for_each(|blade| loads.add(blade));
            first += rotor.n_blades;
            shares
                .push(RotorShare { loads, beta_1c: self.flap_multiblade(r, self.spin(r, at).psi, at.y)[0] });
        }
        self.shared_slopes(at, &shares, slopes);
        self.masses(at, slopes);
        self.join(at, slopes);
        slopes.join_masses();
    }

    /// dF/dy_dot and what the lag dampers and the blades' weight have in dF/dy, at a small part of the cost; the rest is left as
    /// it was. The dampers belong here because their force has kinks.
    pub fn mass_slopes(&self, at: &Instant<f64>, slopes: &mut Slopes) {
        if !slopes.carrier_known {
            // the carrier's own inertia and the way of loads to its balance, once
            slopes.set_point(at.y, &vec![0.0; at.y.len()]);
            let shares: Vec<RotorShare<f64>> = (0..self.rotors.len())
                .map(|r| RotorShare {
                    loads: RotorLoads::zero(),
                    beta_1c: self.flap_multiblade(r, self.spin(r, at).psi, at.y)[0],
                })
                .collect();
            self.shared_slopes(at, &shares, slopes);
        }
        self.masses(at, slopes);
        slopes.join_masses();
    }
}
