//! The layout of the state y: declared once, read by everything else.

use crate::blade::MAX_MODES;
use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use std::ops::Range;

/// Where the states of one rotor with blades live.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RotorLayout {
    /// Name in the list of rotors.
    pub name: String,
    /// First entry.
    start: usize,
    /// Blades.
    pub n_blades: usize,
    /// Modes per blade.
    pub n_modes: usize,
    /// Whether lambda_0, lambda_s, lambda_c are states.
    pub dynamic_inflow: bool,
    /// Whether azimuth and speed are.
    pub speed: SpeedStates,
}

/// What of a rotor's speed is a state.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpeedStates {
    /// Nothing: it is given.
    #[default]
    Given,
    /// Azimuth and speed, which is constant over the ground.
    OverGround,
    /// Azimuth and speed, by a torque that is given.
    Free,
    /// These, the integral of a governor and the power of the engines.
    Governed,
}

impl SpeedStates {
    fn len(self) -> usize {
        match self {
            Self::Given => 0,
            Self::OverGround | Self::Free => 2,
            Self::Governed => 4,
        }
    }

    /// Whether engines turn the rotor.
    pub fn has_engines(self) -> bool {
        match self {
            Self::Given | Self::OverGround => false,
            Self::Free | Self::Governed => true,
        }
    }
}

/// Where azimuth and speed of a rotor live.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpinPlace {
    /// Azimuth of the first blade [rad].
    pub azimuth: usize,
    /// Speed [rad/s].
    pub speed: usize,
}

/// Where the states of governed engines live.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EnginePlace {
    /// Integral of the excess of speed [rad].
    pub integral: usize,
    /// Power [W].
    pub power: usize,
}

impl RotorLayout {
    /// Modal coordinates of blade `b`.
    pub fn modal(&self, b: usize) -> Range<usize> {
        let start = self.start + 2 * self.n_modes * b;
        start..start + self.n_modes
    }
    /// Their rates.
    pub fn modal_rate(&self, b: usize) -> Range<usize> {
        let q = self.modal(b);
        q.end..q.end + self.n_modes
    }
    /// Dynamic inflow states.
    pub fn inflow(&self) -> Range<usize> {
        let start = self.start + 2 * self.n_modes * self.n_blades;
        start..start + if self.dynamic_inflow { 3 } else { 0 }
    }
    /// Azimuth, speed, and what governs them.
    pub fn turn(&self) -> Range<usize> {
        let start = self.inflow().end;
        start..start + self.speed.len()
    }
    /// Azimuth and speed, where they are states.
    #[inline(always)]
    pub fn spin(&self) -> Option<SpinPlace> {
        let azimuth = self.turn().start;
        (self.speed != SpeedStates::Given).then_some(SpinPlace { azimuth, speed: azimuth + 1 })
    }
    /// Azimuth and speed: nothing where they are given.
    #[inline(always)]
    pub fn spin_states(&self) -> Range<usize> {
        let turn = self.turn();
        turn.start..turn.end.min(turn.start + 2)
    }
    /// States of governed engines, where there are any.
    pub fn engine(&self) -> Option<EnginePlace> {
        let start = self.turn().start;
        (self.speed == SpeedStates::Governed).then_some(EnginePlace { integral: start + 2, power: start + 3 })
    }
    fn names(&self, names: &mut Vec<(String, &'static str)>) {
        let rotor = format!("rotor.{}", self.name);
        for b in 0..self.n_blades {
            let blade = format!("{rotor}.blade_{b}");
            names.extend((0..self.n_modes).map(|i| (format!("{blade}.modal_{i}"), "m kg^0.5")));
            names.extend((0..self.n_modes).map(|i| (format!("{blade}.modal_rate_{i}"), "m kg^0.5/s")));
        }
        if self.dynamic_inflow {
            names.extend(["inflow_0", "inflow_1s", "inflow_1c"].map(|n| (format!("{rotor}.{n}"), "1")));
        }
        let turn = [("azimuth", "rad"), ("speed", "rad/s"), ("governor", "rad"), ("engine_power", "W")];
        names.extend(turn.into_iter().take(self.speed.len()).map(|(n, unit)| (format!("{rotor}.{n}"), unit)));
    }
}

/// What a rotor of the list has as states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RotorStates {
    /// Name in the list of rotors.
    pub name: String,
    /// Blades.
    pub n_blades: usize,
    /// Modes per blade.
    pub n_modes: usize,
    /// Whether lambda_0, lambda_s, lambda_c are states.
    pub dynamic_inflow: bool,
    /// What of its speed is.
    pub speed: SpeedStates,
}

/// Where each part of y lives: the carrier where it flies, rotor after rotor, then the inflow of the closed-form rotors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Whether the carrier flies: its thirteen states come first.
    pub free: bool,
    /// Rotors with blades, in the order of the list.
    pub rotors: Vec<RotorLayout>,
    /// Names of the closed-form rotors.
    pub closed: Vec<String>,
}

impl Layout {
    /// u, v, w [m/s], of a carrier that flies.
    pub const VELOCITY: Range<usize> = 0..3;
    /// p, q, r [rad/s].
    pub const RATES: Range<usize> = 3..6;
    /// Attitude quaternion, body to inertial.
    pub const ATTITUDE: Range<usize> = 6..10;
    /// North, east, down [m].
    pub const POSITION: Range<usize> = 10..13;

    /// Of a carrier that flies (`free`) or stays, with rotors with blades and closed-form ones.
    pub fn new(free: bool, rotors: impl IntoIterator<Item = RotorStates>, closed: Vec<String>) -> Self {
        let mut layout = Self { free, rotors: Vec::new(), closed };
        for r in rotors {
            let start = layout.rotors_end();
            let RotorStates { name, n_blades, n_modes, dynamic_inflow, speed } = r;
            layout.rotors.push(RotorLayout { name, start, n_blades, n_modes, dynamic_inflow, speed });
        }
        layout
    }

    /// States of the carrier: none on a stand.
    pub fn carrier(&self) -> Range<usize> {
        0..if self.free { Self::POSITION.end } else { 0 }
    }
    /// Velocity and rates of the carrier: none on a stand.
    pub fn carrier_motion(&self) -> Range<usize> {
        0..if self.free { Self::RATES.end } else { 0 }
    }
    /// Attitude of the carrier: none on a stand.
    pub fn attitude(&self) -> Range<usize> {
        if self.free { Self::ATTITUDE } else { 0..0 }
    }
    fn rotors_end(&self) -> usize {
        self.rotors.last().map_or(self.carrier().end, |r| r.turn().end)
    }
    /// The first rotor with blades: the main rotor of a helicopter.
    pub fn main(&self) -> &RotorLayout {
        &self.rotors[0]
    }
    /// Inflow of the closed-form rotors, one state each.
    pub fn closed_inflow(&self) -> Range<usize> {
        let start = self.rotors_end();
        start..start + self.closed.len()
    }
    /// Length of y.
    pub fn len(&self) -> usize {
        self.closed_inflow().end
    }
    /// Whether there is no state.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Entries of y that all blades share: carrier, inflow, speed.
    pub fn shared(&self) -> Vec<usize> {
        let of_rotors = self.rotors.iter().flat_map(|r| r.inflow().chain(r.turn()));
        self.carrier().chain(of_rotors).chain(self.closed_inflow()).collect()
    }
    /// Gives the quaternion of a carrier that flies its length of one: it has no meaning and drifts with the error of a method.
    pub fn normalise(&self, y: &mut [f64]) {
        let attitude = &mut y[self.attitude()];
        let norm = attitude.iter().map(|q| q * q).sum::<f64>().sqrt();
        for q in attitude {
            *q /= norm;
        }
    }
    /// Name and unit of every state.
    pub fn names(&self) -> Vec<(String, &'static str)> {
        let mut names: Vec<(String, &'static str)> = Vec::with_capacity(self.len());
        if self.free {
            names.extend(["u", "v", "w"].map(|n| (n.to_string(), "m/s")));
            names.extend(["p", "q", "r"].map(|n| (n.to_string(), "rad/s")));
            names.extend((0..4).map(|i| (format!("quaternion_{i}"), "1")));
            names.extend(["north", "east", "down"].map(|n| (n.to_string(), "m")));
        }
        for rotor in &self.rotors {
            rotor.names(&mut names);
        }
        names.extend(self.closed.iter().map(|name| (format!("rotor.{name}.inflow"), "1")));
        names
    }
}

/// Three entries of y as a body vector.
#[inline(always)]
pub fn body_vector<S: Real>(y: &[S], range: Range<usize>) -> Vec3<S, Body> {
    Vec3::new(y[range.start], y[range.start + 1], y[range.start + 2])
}

/// Entries of y as a modal array.
#[inline(always)]
pub fn modal_array<S: Real>(y: &[S], range: Range<usize>) -> [S; MAX_MODES] {
    let mut out = [S::zero(); MAX_MODES];
    for (o, i) in out.iter_mut().zip(range) {
        *o = y[i];
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rotor(
        name: &str,
        (n_blades, n_modes): (usize, usize),
        dynamic_inflow: bool,
        speed: SpeedStates,
    ) -> RotorStates {
        RotorStates { name: name.into(), n_blades, n_modes, dynamic_inflow, speed }
    }

    #[test]
    fn every_state_has_one_place_and_one_name() {
        let kinds = [SpeedStates::Given, SpeedStates::OverGround, SpeedStates::Free, SpeedStates::Governed];
        for (free, speed) in [true, false].into_iter().flat_map(|free| kinds.map(|kind| (free, kind))) {
            let rotors =
                [rotor("main", (4, 3), true, speed), rotor("tail", (2, 1), false, SpeedStates::Given)];
            let l = Layout::new(free, rotors.clone(), vec!["propeller".into()]);
            let mut all: Vec<usize> = l.shared();
            for r in &l.rotors {
                all.extend((0..r.n_blades).flat_map(|b| r.modal(b).chain(r.modal_rate(b))));
            }
            all.sort_unstable();
            assert_eq!(all, (0..l.len()).collect::<Vec<_>>());
            let names = l.names();
            assert_eq!(names.len(), l.len());
            let named = |i: usize| names[i].0.as_str();
            if let Some(place) = l.main().spin() {
                assert_eq!(named(place.azimuth), "rotor.main.azimuth");
                assert_eq!(named(place.speed), "rotor.main.speed");
            }
            if let Some(place) = l.main().engine() {
                assert_eq!(named(place.integral), "rotor.main.governor");
                assert_eq!(named(place.power), "rotor.main.engine_power");
            }
            assert_eq!(names[l.rotors[1].modal_rate(1).start].0, "rotor.tail.blade_1.modal_rate_0");
            assert_eq!(names[l.closed_inflow().start].0, "rotor.propeller.inflow");
        }
    }
}
