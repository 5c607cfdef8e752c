//! The equations a trim can be asked to meet.

use super::convention::Convention;
use super::error::ProblemError;
use serde::{Deserialize, Serialize};

/// An equation for a control, an angle of attitude or a free part of the path; loads are means over a revolution.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub enum Equation {
    /// Balance of forces along a body axis, over the mass [m/s2].
    Force(usize),
    /// Balance of moments about a body axis, over an inertia [rad/s2].
    Moment(usize),
    /// Bank or sideslip [rad].
    Convention(Convention),
    /// Load factor, the resultant of all loads but gravity over the weight: sqrt(1 + (turn rate x horizontal speed / g)^2).
    LoadFactor {
        /// Load factor.
        load_factor: f64,
        /// Direction of the turn: 1 to the right, -1 to the left.
        side: f64,
    },
    /// Power the engines give: main rotor, tail rotor, accessories [W]. No losses between.
    Power(f64),
    /// theta_0 given [rad].
    Collective(f64),
    /// theta_1c given [rad].
    LateralCyclic(f64),
    /// theta_1s given [rad].
    LongitudinalCyclic(f64),
    /// Aerodynamic thrust along the shaft given [N].
    Thrust(f64),
    /// Aerodynamic torque about the shaft given, what the drive must supply [N m].
    Torque(f64),
    /// Cosine of the first flap mode given [rad].
    FlapCosine(f64),
    /// Sine of the first flap mode given [rad].
    FlapSine(f64),
    /// Hub rolling moment given, right side down positive [N m].
    HubRoll(f64),
    /// Hub pitching moment given, nose up positive [N m].
    HubPitch(f64),
}

const FORCES: [&str; 3] = ["force_x", "force_y", "force_z"];
const MOMENTS: [&str; 3] = ["moment_x", "moment_y", "moment_z"];

impl Equation {
    /// From its name and numbers: none for a balance; bank, sideslip and share of the bank for `convention`; load factor and
    /// side for `load_factor`; else the value asked for, SI.
    pub fn named(name: &str, numbers: &[f64]) -> Result<Self, ProblemError> {
        let axis = |names: &[&str; 3]| names.iter().position(|each| *each == name);
        let unknown = ProblemError::Equation(name.into(), numbers.len());
        if !numbers.iter().all(|v| v.is_finite()) {
            return Err(ProblemError::NotFinite);
        }
        Ok(match *numbers {
            [] => match (axis(&FORCES), axis(&MOMENTS)) {
                (Some(i), _) => Self::Force(i),
                (_, Some(i)) => Self::Moment(i),
                _ => return Err(unknown),
            },
            [bank, sideslip, bank_share] if name == "convention" => {
                Self::Convention(Convention { bank, sideslip, bank_share })
            }
            [load_factor, side] if name == "load_factor" => Self::LoadFactor { load_factor, side },
            [value] => match name {
                "power" => Self::Power(value),
                "collective" => Self::Collective(value),
                "lateral_cyclic" => Self::LateralCyclic(value),
                "longitudinal_cyclic" => Self::LongitudinalCyclic(value),
                "thrust" => Self::Thrust(value),
                "torque" => Self::Torque(value),
                "beta_1c" => Self::FlapCosine(value),
                "beta_1s" => Self::FlapSine(value),
                "hub_roll" => Self::HubRoll(value),
                "hub_pitch" => Self::HubPitch(value),
                _ => return Err(unknown),
            },
            _ => return Err(unknown),
        })
    }

    /// Name, and unit of the residual.
    pub fn name(&self) -> (&'static str, &'static str) {
        match self {
            Self::Force(i) => (FORCES[*i], "m/s2"),
            Self::Moment(i) => (MOMENTS[*i], "rad/s2"),
            Self::Convention(_) => ("convention", "rad"),
            Self::LoadFactor { .. } => ("load_factor", "1"),
            Self::Power(_) => ("power", "1"),
            Self::Collective(_) => ("collective", "rad"),
            Self::LateralCyclic(_) => ("lateral_cyclic", "rad"),
            Self::LongitudinalCyclic(_) => ("longitudinal_cyclic", "rad"),
            Self::Thrust(_) => ("thrust", "1"),
            Self::Torque(_) => ("torque", "1"),
            Self::FlapCosine(_) => ("beta_1c", "rad"),
            Self::FlapSine(_) => ("beta_1s", "rad"),
            Self::HubRoll(_) => ("hub_roll", "1"),
            Self::HubPitch(_) => ("hub_pitch", "1"),
        }
    }

    /// Whether it is one of an airframe in flight.
    pub fn is_of_flight(&self) -> bool {
        matches!(self, Self::Force(_) | Self::Moment(_) | Self::Convention(_) | Self::LoadFactor { .. })
    }
}
