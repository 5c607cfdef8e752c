//! Where F is asked: time, state, its rate, and what acts.

/// Inflow of a rotor held over a coupling step.
#[derive(Clone, Debug)]
pub enum HeldInflow {
    /// The three states of y.
    Dynamic,
    /// Rows of [`held_inflow`](crate::rotor::hub::Rotor::held_inflow), blade after blade, and the disk mean.
    Stations {
        /// lambda at every station, positive down.
        inflow: Vec<f64>,
        /// Disk mean.
        mean: f64,
    },
    /// No air.
    Vacuum,
}

/// What acts on the system over one coupling step.
#[derive(Clone, Debug)]
pub struct Inputs {
    /// Controls at `t_start`: sticks lateral, longitudinal, collective, pedal [m from the stop] of an airframe; on a stand
    /// theta_0, theta_1c, theta_1s [rad] and nothing.
    pub stick: [f64; 4],
    /// Their rates [1/s].
    pub stick_rate: [f64; 4],
    /// Start of the step [s].
    pub t_start: f64,
    /// Inflow of every rotor with blades, in the order of the list.
    pub inflow: Vec<HeldInflow>,
    /// Stabilator incidence [rad].
    pub stabilator_incidence: f64,
}

impl Inputs {
    /// Controls at time `t`.
    pub fn stick_at(&self, t: f64) -> [f64; 4] {
        std::array::from_fn(|i| self.stick[i] + self.stick_rate[i] * (t - self.t_start))
    }

    /// Whether there is no air at all.
    pub fn vacuum(&self) -> bool {
        matches!(self.inflow.first(), Some(HeldInflow::Vacuum))
    }
}

/// The arguments of F.
#[derive(Clone, Copy, Debug)]
pub struct Instant<'a, S> {
    /// Time [s].
    pub t: f64,
    /// State.
    pub y: &'a [S],
    /// Its rate.
    pub y_dot: &'a [S],
    /// What acts.
    pub inputs: &'a Inputs,
}
