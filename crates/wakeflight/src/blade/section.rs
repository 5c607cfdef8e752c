//! Spanwise properties of a blade.

use crate::numerics::tables::Table;
use serde::Deserialize;

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
    /// Structural damping ratio of elastic modes.
    pub structural_damping_ratio: f64,
    /// Pitch-flap coupling angle delta3 [rad]: flap up takes tan(delta3) of pitch away.
    pub delta3: f64,
    /// Fixed flap rotation of the blade [rad].
    pub precone: f64,
}
