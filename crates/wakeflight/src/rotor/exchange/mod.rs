//! The exchange between flight dynamics and the air at the end of a coupling step: motion in, inflow out.
//!
//! Three models behind one door, [`Exchange`]: dynamic inflow, which is in the state and has nothing to exchange; a relaxation
//! wake, steady for the motion of the last revolution and renewed when it is due; a marching wake, one step further each time.
//! What is held between exchanges (maps by azimuth, far inflow, convection of the sheet) is state of the exchange.

pub mod marching;
mod passages;
pub mod relaxation;
pub mod steady;

pub use marching::{ExchangeReport, MarchingExchange};
pub use relaxation::RelaxationExchange;
pub use steady::{Changes, Iteration, SteadyWake};

use super::circulation::{BladeInstant, Course};
use super::hub::Rotor;
use super::speed::Turning;
use crate::blade::aerodynamics::Air;
use crate::blade::hub_motion::HubMotion;
use crate::blade::kinematics::PitchMotion;
use crate::blade::memory_rows::MemoryRows;
use crate::inflow::disk::{DiskMean, LiftingDisk};
use crate::wake::{AirframeInWake, AtParts, HubMotion as WakeHub, Plane, WakeError};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Rotor, air and motion of the hub at the exchange.
#[derive(Clone, Copy)]
pub struct Place<'a> {
    /// The rotor.
    pub rotor: &'a Rotor,
    /// Air.
    pub air: Air,
    /// Motion of the hub.
    pub hub: &'a HubMotion<f64>,
    /// How the rotor turns.
    pub turning: Turning,
    /// What the air does of its own at the stations, as inflow (n_blades, n_stations); empty where it does nothing.
    pub gust: &'a [f64],
    /// Ground, where there is one.
    pub ground: Option<Plane>,
    /// Airframe, where there is one.
    pub airframe: Option<AirframeInWake>,
}

impl Place<'_> {
    /// Motion of the hub as the wake takes it.
    pub(crate) fn wake_hub(&self) -> WakeHub {
        WakeHub { velocity: self.hub.velocity.array(), rates: self.hub.omega.array() }
    }

    /// Time that a step of azimuth takes, over that at the nominal speed.
    pub(crate) fn pace(&self) -> f64 {
        self.rotor.omega / self.turning.omega
    }

    /// Motion of the hub as near wakes take it: over the azimuth they span the air passes by the time it takes.
    pub(crate) fn near_hub(&self) -> WakeHub {
        let hub = self.wake_hub();
        WakeHub { velocity: hub.velocity.map(|v| v * self.pace()), ..hub }
    }

    /// Motion of the hub as blades that turn at the nominal speed feel it.
    pub(crate) fn blade_hub(&self) -> HubMotion<f64> {
        if self.turning == Turning::steady(self.rotor.omega) {
            return *self.hub;
        }
        self.turning.carried_by(*self.hub, self.rotor.omega)
    }

    /// All of it.
    pub(crate) fn course(&self) -> Course {
        Course { blades: self.blade_hub(), near: self.near_hub(), pace: self.pace() }
    }
}

/// What the flight dynamics give when a step has been flown.
#[derive(Clone, Copy)]
pub struct Reached<'a> {
    /// Rotor, air, hub.
    pub place: Place<'a>,
    /// The blades at their present azimuths (n_blades,).
    pub blades: &'a [BladeInstant],
    /// Pitch of a blade at every azimuth (n_azimuths,) with the sticks where they are; needed where a wake is renewed.
    pub steady_pitch: &'a [PitchMotion<f64>],
    /// Time since the step began [s].
    pub elapsed: f64,
}

/// Inflow over the step that begins.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    /// Total inflow over the tip speed (n_blades, n_stations), thin sections twice as wide; none where it is in the state.
    pub inflow: Option<Vec<f64>>,
    /// How much more it is at the end of the step, like the rows; none where it stays.
    pub change: Option<Vec<f64>>,
    /// Its mean over the disk, zero where the inflow is in the state.
    pub mean: f64,
}

/// Every free trailer at an instant, root to tip: the last of a blade is its tip vortex.
#[derive(Clone, Debug, PartialEq)]
pub struct Lattice {
    /// Trailers of a blade.
    pub n_trailers: usize,
    /// Nodes (n_blades, n_trailers, n_ages) [m], hub axes.
    pub position: Vec<[f64; 3]>,
    /// Their circulation (n_blades, n_trailers, n_ages) [m2/s].
    pub circulation: Vec<f64>,
    /// Core radii of the segments (n_blades, n_trailers, n_ages - 1) [m].
    pub core_radius: Vec<f64>,
}

/// One of the inflow models of a flight, with all that it keeps between exchanges.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Exchange {
    /// Dynamic inflow: in the state, nothing to exchange; memory of sections that remember where the step begins, blade by blade.
    Dynamic(MemoryRows),
    /// Relaxation wake: inflow by azimuth, renewed as often as asked.
    Relaxation(Box<RelaxationExchange>),
    /// Time-marching wake: one step with every exchange.
    Marching(Box<MarchingExchange>),
}

impl Exchange {
    /// Inflow over the step that begins after `step` steps of azimuth.
    pub fn held(&self, step: usize) -> Held {
        match self {
            Self::Dynamic(_) => Held { inflow: None, change: None, mean: 0.0 },
            Self::Relaxation(wake) => wake.held(step),
            Self::Marching(wake) => wake.held(step),
        }
    }

    /// Air at the parts of the airframe over the step that begins, mean over the last passage of a blade [m/s, `_h`];
    /// none where they do not feel the wake.
    pub fn wash(&self) -> Option<AtParts> {
        match self {
            Self::Dynamic(_) => None,
            Self::Relaxation(wake) => wake.steady.wash(),
            Self::Marching(wake) => wake.wash(),
        }
    }

    /// Whether the exchange at `step` renews a steady wake, and needs the pitch at every azimuth.
    pub fn renews(&self, step: usize) -> bool {
        matches!(self, Self::Relaxation(wake) if wake.renews(step))
    }

    /// The flight has reached `step`: the air answers. Steps are of azimuth, whatever the rotor's speed.
    pub fn advance(&mut self, step: usize, reached: &Reached) -> Result<(), WakeError> {
        match self {
            Self::Dynamic(_) => Ok(()),
            Self::Relaxation(wake) => wake.advance(step, reached),
            Self::Marching(wake) => wake.advance(&reached.place, reached.blades, reached.elapsed),
        }
    }

    /// Memory of sections that remember, where the step begins; blade by blade.
    pub fn memory(&self) -> &MemoryRows {
        match self {
            Self::Dynamic(memory) => memory,
            Self::Relaxation(wake) => &wake.memory,
            Self::Marching(wake) => &wake.memory,
        }
    }

    /// The marching wake with what goes with it; none of another model.
    pub fn marching(&self) -> Option<&MarchingExchange> {
        match self {
            Self::Marching(wake) => Some(wake),
            Self::Dynamic(_) | Self::Relaxation(_) => None,
        }
    }

    /// The same, to be marched.
    pub fn marching_mut(&mut self) -> Option<&mut MarchingExchange> {
        match self {
            Self::Marching(wake) => Some(wake),
            Self::Dynamic(_) | Self::Relaxation(_) => None,
        }
    }

    /// What the last exchange saw, by name: largest motion of a marker and odd-even content over R, smallest distance of blade and
    /// tip vortex in core radii, not a number where the model does not tell.
    pub fn monitors(&self) -> [(&'static str, f64); 3] {
        let seen = self.marching().and_then(|wake| wake.report);
        let (moved, odd_even, distance) =
            seen.map_or((0.0, 0.0, f64::NAN), |r| (r.max_displacement, r.odd_even, r.miss_distance));
        [("max_displacement", moved), ("odd_even", odd_even), ("vortex_blade_distance", distance)]
    }

    /// Counted work by name; none without a wake.
    pub fn counters(&self) -> Vec<(&'static str, u64)> {
        match self {
            Self::Dynamic(_) => Vec::new(),
            Self::Relaxation(wake) => vec![
                ("segment_evaluations", wake.steady.segment_evaluations()),
                ("unconverged_revolutions", wake.unconverged),
                ("relaxation_updates", wake.updates),
                ("relaxation_iterations", wake.steady.sweeps),
            ],
            Self::Marching(wake) => vec![
                ("segment_evaluations", wake.wake.segment_evaluations()),
                ("circulation_not_converged", wake.unsolved as u64),
                ("circulation_followed", wake.followed as u64),
            ],
        }
    }

    /// Every free trailer with the blades where they are after `step` steps; none without a wake.
    pub fn lattice(&self, step: usize) -> Option<Lattice> {
        match self {
            Self::Dynamic(_) => None,
            Self::Relaxation(wake) => wake.lattice(step),
            Self::Marching(wake) => Some(wake.lattice()),
        }
    }
}

/// Azimuth index of blade `b` of `n_blades` after `step` steps of `n` in a revolution.
pub fn row(step: usize, b: usize, n_blades: usize, n: usize) -> usize {
    (step + b * n / n_blades) % n
}

/// Azimuth [rad] of row `k` of `n`.
pub fn azimuth(k: usize, n: usize) -> f64 {
    TAU * k as f64 / n as f64
}

/// Steps of azimuth in an interval [rad] of which a revolution has `n`.
fn steps_of(interval: f64, n: usize) -> usize {
    (interval / TAU * n as f64).round() as usize
}

/// Rows of a map (n_azimuths, width) where the step begins, and how much more they are at its end.
fn over_step(map: &[f64], width: usize, step: usize, n_blades: usize) -> [Vec<f64>; 2] {
    let n = map.len() / width;
    let at = |step: usize| {
        (0..n_blades).flat_map(move |b| map[row(step, b, n_blades, n) * width..][..width].iter().copied())
    };
    [at(step).collect(), at(step).zip(at(step + 1)).map(|(now, ahead)| ahead - now).collect()]
}

impl Rotor {
    /// Means over the disk of this rotor.
    pub fn disk_mean(&self) -> DiskMean {
        let disk = self.lifting_disk();
        DiskMean::new(&disk.stations, &disk.widths)
    }

    /// The rotor as a circulation map needs it.
    pub fn lifting_disk(&self) -> LiftingDisk {
        LiftingDisk {
            n_blades: self.n_blades,
            omega: self.omega,
            radius: self.blade.radius,
            stations: self.blade.stations.iter().map(|s| s.shapes.x).collect(),
            widths: self.blade.stations.iter().map(|s| s.geometry.width).collect(),
        }
    }
}
