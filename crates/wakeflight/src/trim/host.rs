//! What a trim asks of what carries the rotor.

use super::path::Path;
use crate::blade::aerodynamics::Air;
use crate::blade::hub_loads::BladeLoads;
use crate::blade::hub_motion::HubMotion;
use crate::blade::kinematics::PitchMotion;
use crate::inflow::pitt_peters::PittPeters;
use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use crate::rotor::hub::Rotor;
use crate::wake::AtParts;

/// Unknowns at the head of the list, and what of the path is given.
#[derive(Clone, Copy, Debug)]
pub struct Head<S> {
    /// Controls of the host; those it does not have are zero.
    pub controls: [S; 4],
    /// Bank, right side down positive [rad].
    pub roll: S,
    /// Pitch attitude, nose up positive [rad].
    pub pitch: S,
    /// Heading against the track, nose right positive [rad].
    pub yaw: S,
    /// Path.
    pub path: Path<S>,
    /// lambda_0, lambda_s, lambda_c of dynamic inflow; zero on a held map.
    pub inflow: [S; 3],
    /// Inflow of the tail rotor.
    pub tail_inflow: S,
}

/// The host in its steady motion.
#[derive(Clone, Debug)]
pub struct Carried<S> {
    /// Its state, blades at rest; a stand has none.
    pub y: Vec<S>,
    /// Motion of the hub.
    pub hub: HubMotion<S>,
}

/// What the rotor brings to the airframe, in the mean over a revolution.
#[derive(Clone, Copy, Debug)]
pub struct RotorMean<'a, S> {
    /// Loads of all blades on the hub.
    pub loads: &'a BladeLoads<S>,
    /// Cosine of the first flap mode [rad].
    pub beta_1c: S,
    /// Mean inflow.
    pub inflow: S,
    /// Air of the wake at the parts of the airframe [m/s], body axes; none where washes act on the mean inflow.
    pub wash: Option<AtParts>,
}

/// What is missing to the balances of an airframe.
#[derive(Clone, Copy, Debug)]
pub struct Balances<S> {
    /// Forces over the mass, body axes [m/s2].
    pub force: [S; 3],
    /// Moments over reference inertias, body axes [rad/s2].
    pub moment: [S; 3],
    /// Velocity, body axes [m/s].
    pub velocity: Vec3<S, Body>,
    /// Power of tail rotor and accessories [W].
    pub other_power: S,
    /// Rate of the tail-rotor inflow [1/s].
    pub tail_inflow_rate: S,
}

/// What carries the rotor.
pub trait Host {
    /// Names and units of its controls, four at most.
    fn controls(&self) -> &'static [(&'static str, &'static str)];
    /// Whether it is an airframe: its attitude is unknown, its balances are equations.
    fn flies(&self) -> bool;
    /// Whether it has a tail rotor whose inflow is an unknown.
    fn has_tail_rotor(&self) -> bool;
    /// The rotor.
    fn rotor(&self) -> &Rotor;
    /// Air.
    fn air(&self) -> Air;
    /// Dynamic inflow model.
    fn pitt_peters(&self) -> &PittPeters;
    /// Gravity [m/s2].
    fn gravity(&self) -> f64;
    /// theta_1c, theta_1s, theta_0 and the pitch of the tail rotor [rad].
    fn pitch<S: Real>(&self, controls: [S; 4]) -> [S; 4];
    /// Pitch of the blade at azimuth `psi` [rad] for these pitch controls, with exact rates.
    fn blade_pitch<S: Real>(&self, pitch: &[S; 4], psi: f64) -> PitchMotion<S>;
    /// Its state and the motion of the hub.
    fn carried<S: Real>(&self, head: &Head<S>) -> Carried<S>;
    /// Height of the hub above ground [m]; none where there is none.
    fn hub_height<S: Real>(&self, carried: &Carried<S>) -> Option<S>;
    /// Its balances; none on a stand.
    fn balances<S: Real>(
        &self,
        head: &Head<S>,
        carried: &Carried<S>,
        rotor: &RotorMean<S>,
    ) -> Option<Balances<S>>;
}
