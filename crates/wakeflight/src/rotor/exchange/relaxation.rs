//! The relaxation wake in flight: the motion of the last revolution taken as steady, the wake renewed when it is due.

use super::{Held, Lattice, Reached, SteadyWake, azimuth, over_step, row, steps_of};
use crate::blade::MAX_MODES;
use crate::blade::kinematics::ModalMotion;
use crate::blade::memory_rows::MemoryRows;
use crate::inflow::disk::DiskMean;
use crate::rotor::circulation::BladeInstant;
use crate::rotor::hub::Rotor;
use crate::wake::{RelaxationOptions, RelaxationWake, WakeError};
use serde::{Deserialize, Serialize};

/// Modal coordinates and rates of a blade at an azimuth.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Passage {
    q: [f64; MAX_MODES],
    q_dot: [f64; MAX_MODES],
}

impl From<&ModalMotion<f64>> for Passage {
    fn from(motion: &ModalMotion<f64>) -> Self {
        Self { q: motion.q, q_dot: motion.q_dot }
    }
}

/// Relaxation wake of a flight.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct RelaxationExchange {
    /// The wake with its circulation and inflow.
    pub steady: SteadyWake,
    n_blades: usize,
    area: DiskMean,
    /// Steps of azimuth from one renewal to the next.
    every: usize,
    /// Iterations of a renewal at most.
    most: usize,
    /// Memory of sections that remember where the step begins, blade by blade.
    pub memory: MemoryRows,
    /// Latest passage of a blade at every azimuth.
    passages: Vec<Passage>,
    /// Renewals so far.
    pub updates: u64,
    /// Those among them that did not come to rest.
    pub unconverged: u64,
}

impl RelaxationExchange {
    /// From the wake of a trim and the periodic motion of its blades (n_azimuths,), renewed as its `own` options say; counts begin
    /// anew.
    pub fn new(
        mut steady: SteadyWake,
        rotor: &Rotor,
        own: &RelaxationOptions,
        motion: &[ModalMotion<f64>],
    ) -> Self {
        (steady.sweeps, steady.followed) = (0, 0);
        let (n_blades, n) = (rotor.n_blades, motion.len());
        Self {
            memory: steady.memory.rows((0..n_blades).map(|b| row(0, b, n_blades, n))),
            steady,
            n_blades: rotor.n_blades,
            area: rotor.disk_mean(),
            every: steps_of(own.update_interval, motion.len()).max(1),
            most: own.max_loops_response,
            passages: motion.iter().map(Passage::from).collect(),
            updates: 0,
            unconverged: 0,
        }
    }

    /// Whether the wake is renewed at `step`.
    pub fn renews(&self, step: usize) -> bool {
        step.is_multiple_of(self.every)
    }

    pub(super) fn held(&self, step: usize) -> Held {
        let (map, width) = (&self.steady.inflow, self.steady.width());
        let [inflow, change] = over_step(map, width, step, self.n_blades);
        Held { inflow: Some(inflow), change: Some(change), mean: self.area.of(map, width) }
    }

    /// Remembers the motion of the blades at their azimuths; where it is due, converges wake and circulation anew.
    pub(super) fn advance(&mut self, step: usize, reached: &Reached) -> Result<(), WakeError> {
        let n = self.passages.len();
        for (b, blade) in reached.blades.iter().enumerate() {
            self.passages[row(step, b, self.n_blades, n)] = Passage::from(&blade.modal);
        }
        if self.renews(step) {
            self.renew(reached)?;
        }
        self.memory = self.kept(step, reached);
        Ok(())
    }

    /// Memory of the sections in the inflow of the map, in which the next step begins.
    fn kept(&self, step: usize, reached: &Reached) -> MemoryRows {
        let Reached { place, blades, elapsed, .. } = reached;
        let (rotor, width, hub) = (place.rotor, self.steady.width(), place.blade_hub());
        MemoryRows::of(self.rows(step).zip(*blades).enumerate().map(|(b, (k, blade))| {
            let inflow = rotor.held_inflow(&self.steady.inflow[k * width..(k + 1) * width]);
            rotor.kept(place.air, &hub, blade, &inflow, self.memory.step(b, *elapsed))
        }))
    }

    /// Converges wake and circulation anew for the motion of the last revolution.
    fn renew(&mut self, reached: &Reached) -> Result<(), WakeError> {
        let n = self.passages.len();
        let blades: Vec<BladeInstant> = self
            .passages
            .iter()
            .zip(reached.steady_pitch)
            .enumerate()
            .map(|(k, (at, control))| BladeInstant {
                psi: azimuth(k, n),
                modal: ModalMotion { q: at.q, q_dot: at.q_dot, q_ddot: [0.0; MAX_MODES] },
                control: *control,
            })
            .collect();
        let converged = self.steady.converge(&reached.place, &blades, self.most)?;
        self.updates += 1;
        self.unconverged += u64::from(!converged);
        Ok(())
    }

    fn rows(&self, step: usize) -> impl Iterator<Item = usize> {
        let (n_blades, n) = (self.n_blades, self.passages.len());
        (0..n_blades).map(move |b| row(step, b, n_blades, n))
    }

    /// The trailers of the map, with the circulation of the azimuth of their release.
    pub(super) fn lattice(&self, step: usize) -> Option<Lattice> {
        let wake: &RelaxationWake = self.steady.wake.as_ref()?;
        let n = self.passages.len();
        let (ages, n_trailers) = (wake.options().n_segments() + 1, wake.options().trailers_per_blade());
        let released = wake.released_circulation();
        let mut circulation = Vec::with_capacity(self.n_blades * n_trailers * ages);
        for row in self.rows(step) {
            for trailer in 0..n_trailers {
                circulation.extend((0..ages).map(|age| released[born(row, age, n) * n_trailers + trailer]));
            }
        }
        let position = picked(wake.position(), n_trailers * ages, self.rows(step));
        let core_radius = picked(&wake.core_radius(), n_trailers * (ages - 1), self.rows(step));
        Some(Lattice { n_trailers, position, circulation, core_radius })
    }
}

/// Row of the azimuth at which what is `age` steps old left a blade that is now at `row`.
fn born(row: usize, age: usize, n: usize) -> usize {
    (row + n - age % n) % n
}

/// Rows of `length` values.
fn picked<T: Copy>(values: &[T], length: usize, rows: impl Iterator<Item = usize>) -> Vec<T> {
    rows.flat_map(|row| values[row * length..(row + 1) * length].iter().copied()).collect()
}
