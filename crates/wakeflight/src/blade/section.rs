//! Spanwise properties of a blade.

use super::error::BladeError;
use super::hinge::HingeStops;
use crate::numerics::tables::Table;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_2;

/// Piecewise constant structural properties; every list has one entry per segment, inboard to outboard.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Structure {
    /// Inner end of the segment, from the hub centre [m].
    pub r_in: Vec<f64>,
    /// Outer end [m].
    pub r_out: Vec<f64>,
    /// Mass per length [kg/m].
    pub mass: Vec<f64>,
    /// Flapwise bending stiffness [N m2].
    pub ei_flap: Vec<f64>,
    /// Chordwise bending stiffness [N m2].
    pub ei_lag: Vec<f64>,
    /// Torsional stiffness [N m2].
    pub gj: Vec<f64>,
    /// Torsional moment of inertia per length about the section's centre of gravity [kg m].
    pub i_theta: Vec<f64>,
    /// Centre of gravity ahead (+) of the elastic axis [m].
    pub x_cg: Vec<f64>,
}

/// How the blade is held at its root.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Root {
    /// Coincident flap and lag hinges at `root_station`.
    Hinged,
    /// Flap hinge at `root_station`, clamped in lag.
    Flapping,
    /// Clamped in flap and lag at `root_station`; the pitch bearing sits there too.
    Clamped,
}

/// A blade without its discretisation.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BladeProperties {
    /// Held how.
    pub root: Root,
    /// Hinge offset, or station of the clamp [m].
    pub root_station: f64,
    /// Tip [m].
    pub radius: f64,
    /// Start of the aerodynamic blade [m].
    pub root_cutout: f64,
    /// Structural distributions, clipped to root_station..radius.
    pub structure: Structure,
    /// Built-in twist [rad] against station [m], nose up.
    pub twist: Table,
    /// Chord [m] against station [m].
    pub chord: Table,
    /// Elastic (pitch) axis as a fraction of the chord behind the leading edge.
    pub pitch_axis_chord_fraction: f64,
    /// Root torsion spring, pitch link included [N m/rad].
    pub control_stiffness: f64,
    /// Flapwise share of the polar radius of gyration.
    pub km1_over_ktheta: f64,
    /// Area radius of gyration over mass radius of gyration (tension-twist coupling).
    pub ka_over_ktheta: f64,
    /// Structural damping ratio of elastic modes: all of a clamped blade, those above 1.5/rev of a hinged one.
    pub structural_damping_ratio: f64,
    /// Pitch-flap coupling angle delta3 [rad]: flap up takes tan(delta3) of pitch away.
    pub delta3: f64,
    /// Fixed flap rotation of the blade [rad].
    pub precone: f64,
    /// Spring about the flap hinge, neutral along the precone [N m/rad].
    #[serde(default)]
    pub flap_spring: f64,
    /// Spring about the lag hinge, neutral straight out [N m/rad].
    #[serde(default)]
    pub lag_spring: f64,
    /// Stops of the flap hinge, its angle as the spring counts it.
    #[serde(default)]
    pub flap_stops: Option<HingeStops>,
    /// Stops of the lag hinge, forward positive.
    #[serde(default)]
    pub lag_stops: Option<HingeStops>,
    /// Whether the blade keeps its shape: it moves about its hinges alone, or not at all where it is clamped.
    #[serde(default)]
    pub rigid: bool,
}

/// Structure of the blade at one station, per length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Section {
    /// Mass per length [kg/m].
    pub mass: f64,
    /// Flapwise bending stiffness [N m2].
    pub ei_flap: f64,
    /// Chordwise bending stiffness [N m2].
    pub ei_lag: f64,
    /// Torsional stiffness [N m2].
    pub gj: f64,
    /// Spread of the mass along the chord about the centre of gravity, m k_m2^2 [kg m].
    pub i_chord: f64,
    /// Spread of the mass normal to the chord, m k_m1^2 [kg m].
    pub i_flap: f64,
    /// Centre of gravity ahead (+) of the elastic axis [m].
    pub x_cg: f64,
    /// Square of the area radius of gyration k_A of the tension [m2].
    pub ka_squared: f64,
}

/// Neighbouring segments may differ by this fraction of the radius: rounding of the published stations.
const STATION_ROUNDING: f64 = 1e-6;

impl BladeProperties {
    /// Section at station `x` [m] of segment `segment`.
    ///
    /// Inboard of the first segment (a gap at the hinge) the blade is massless and as stiff as that segment.
    /// Rotary inertia is split by `km1_over_ktheta`; k_A = `ka_over_ktheta` sqrt(i_theta/mass).
    pub fn section(&self, segment: usize, x: f64) -> Section {
        let s = &self.structure;
        let stiffness = Section {
            ei_flap: s.ei_flap[segment],
            ei_lag: s.ei_lag[segment],
            gj: s.gj[segment],
            ..Section::default()
        };
        if x < s.r_in[segment] {
            return stiffness;
        }
        let (mass, i_theta) = (s.mass[segment], s.i_theta[segment]);
        let share = self.km1_over_ktheta * self.km1_over_ktheta;
        let k_theta_squared = if mass > 0.0 { i_theta / mass } else { 0.0 };
        Section {
            mass,
            i_chord: (1.0 - share) * i_theta,
            i_flap: share * i_theta,
            x_cg: s.x_cg[segment],
            ka_squared: self.ka_over_ktheta * self.ka_over_ktheta * k_theta_squared,
            ..stiffness
        }
    }

    /// Angular velocity of a blade of a rotor turning at `omega` [rad/s] along the preconed span axes.
    pub fn rate(&self, omega: f64) -> [f64; 3] {
        [omega * self.precone.sin(), 0.0, omega * self.precone.cos()]
    }

    /// Refuses data that describe no blade, naming the entry.
    pub fn check(&self) -> Result<(), BladeError> {
        let value = |field, value: f64, allowed, good: bool| {
            if good && value.is_finite() { Ok(()) } else { Err(BladeError::Value { field, value, allowed }) }
        };
        value("root_station", self.root_station, "not negative", self.root_station >= 0.0)?;
        value("radius", self.radius, "more than root_station", self.radius > self.root_station)?;
        let stiffness = self.control_stiffness;
        value("control_stiffness", stiffness, "not negative", stiffness >= 0.0)?;
        let split = self.km1_over_ktheta;
        value("km1_over_ktheta", split, "from 0 to 1", (0.0..=1.0).contains(&split))?;
        let ka = self.ka_over_ktheta;
        value("ka_over_ktheta", ka, "not negative", ka >= 0.0)?;
        let (flap, lag) = (self.flap_spring, self.lag_spring);
        let [no_flap_hinge, no_lag_hinge] = [self.root == Root::Clamped, self.root != Root::Hinged];
        value(
            "flap_spring",
            flap,
            "not negative, and zero without a flap hinge",
            flap == 0.0 || (flap > 0.0 && !no_flap_hinge),
        )?;
        value(
            "lag_spring",
            lag,
            "not negative, and zero without a lag hinge",
            lag == 0.0 || (lag > 0.0 && !no_lag_hinge),
        )?;
        value("delta3", self.delta3, "below a right angle", self.delta3.abs() < FRAC_PI_2)?;
        value("precone", self.precone, "below a right angle", self.precone.abs() < FRAC_PI_2)?;
        check_table("twist.x", "twist.y", &self.twist)?;
        // a rigid blade without hinges does not move: its mass is of no account
        let moves = !(self.rigid && self.root == Root::Clamped);
        self.structure.check(self.root_station, self.radius, moves)
    }
}

impl Structure {
    /// Every list as long as the first, stations ascending without holes up to `radius`, no negative entries.
    fn check(&self, root_station: f64, radius: f64, moves: bool) -> Result<(), BladeError> {
        let lists: [(&'static str, &Vec<f64>, Sign); 8] = [
            ("structure.r_in", &self.r_in, Sign::NotNegative),
            ("structure.r_out", &self.r_out, Sign::NotNegative),
            ("structure.mass", &self.mass, Sign::NotNegative),
            ("structure.ei_flap", &self.ei_flap, Sign::Positive),
            ("structure.ei_lag", &self.ei_lag, Sign::Positive),
            ("structure.gj", &self.gj, Sign::Positive),
            ("structure.i_theta", &self.i_theta, Sign::NotNegative),
            ("structure.x_cg", &self.x_cg, Sign::Any),
        ];
        let n = self.r_in.len();
        for (field, list, sign) in lists {
            if list.len() != n || n == 0 {
                return Err(BladeError::Length { field, found: list.len(), expected: n });
            }
            for (index, &value) in list.iter().enumerate() {
                if let Some(allowed) = sign.refusal(value) {
                    return Err(BladeError::Entry { field, index, value, allowed });
                }
            }
        }
        let rounding = STATION_ROUNDING * radius;
        for i in 0..n {
            let entry = |field, value, allowed| BladeError::Entry { field, index: i, value, allowed };
            if self.r_out[i] <= self.r_in[i] {
                return Err(entry("structure.r_out", self.r_out[i], "more than r_in"));
            }
            if self.mass[i] == 0.0 && self.i_theta[i] > 0.0 {
                return Err(entry("structure.i_theta", self.i_theta[i], "zero where mass is zero"));
            }
            if i > 0 && self.r_in[i] < self.r_out[i - 1] - rounding {
                return Err(entry("structure.r_in", self.r_in[i], "not inboard of the last r_out"));
            }
            let hole = i > 0 && self.r_in[i] > self.r_out[i - 1] + rounding;
            if hole && self.r_in[i] > root_station && self.r_out[i - 1] < radius {
                return Err(BladeError::NotCovered { from: self.r_out[i - 1], to: self.r_in[i] });
            }
        }
        let last = self.r_out[n - 1];
        if last < radius - rounding {
            return Err(BladeError::NotCovered { from: last, to: radius });
        }
        let on_blade = |i: &usize| self.r_out[*i] > root_station && self.r_in[*i] < radius;
        if moves && !(0..n).filter(on_blade).any(|i| self.mass[i] > 0.0) {
            return Err(BladeError::Value {
                field: "structure.mass",
                value: 0.0,
                allowed: "more than zero somewhere between root_station and radius",
            });
        }
        Ok(())
    }
}

/// What sign the entries of a list may have.
#[derive(Clone, Copy)]
enum Sign {
    Any,
    NotNegative,
    Positive,
}

impl Sign {
    /// What is allowed, if `value` is not.
    fn refusal(self, value: f64) -> Option<&'static str> {
        match self {
            _ if !value.is_finite() => Some("finite"),
            Sign::NotNegative if value < 0.0 => Some("not negative"),
            Sign::Positive if value <= 0.0 => Some("more than zero"),
            _ => None,
        }
    }
}

fn check_table(x: &'static str, y: &'static str, table: &Table) -> Result<(), BladeError> {
    let n = table.x.len();
    for (field, list) in [(x, &table.x), (y, &table.y)] {
        if list.len() != n || n == 0 {
            return Err(BladeError::Length { field, found: list.len(), expected: n });
        }
        if let Some((index, &value)) = list.iter().enumerate().find(|(_, v)| !v.is_finite()) {
            return Err(BladeError::Entry { field, index, value, allowed: "finite" });
        }
    }
    match (1..n).find(|&i| table.x[i] <= table.x[i - 1]) {
        Some(index) => {
            let value = table.x[index];
            Err(BladeError::Entry { field: x, index, value, allowed: "more than the entry before" })
        }
        None => Ok(()),
    }
}
