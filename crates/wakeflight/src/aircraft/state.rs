//! The layout of the state y: declared once, read by everything else.

use crate::blade::MAX_MODES;
use crate::numerics::frames::{Body, Vec3};
use crate::numerics::scalar::Real;
use std::ops::Range;

/// Where each part of y lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Blades.
    pub n_blades: usize,
    /// Modes per blade.
    pub n_modes: usize,
    /// Whether lambda_0, lambda_s, lambda_c are states.
    pub dynamic_inflow: bool,
    /// Whether the tail rotor's inflow is a state.
    pub tail_rotor: bool,
}

impl Layout {
    /// u, v, w [m/s].
    pub const VELOCITY: Range<usize> = 0..3;
    /// p, q, r [rad/s].
    pub const RATES: Range<usize> = 3..6;
    /// Attitude quaternion, body to inertial.
    pub const ATTITUDE: Range<usize> = 6..10;
    /// North, east, down [m].
    pub const POSITION: Range<usize> = 10..13;

    /// Modal coordinates of blade `b`.
    pub fn modal(&self, b: usize) -> Range<usize> {
        let start = 13 + 2 * self.n_modes * b;
        start..start + self.n_modes
    }
    /// Their rates.
    pub fn modal_rate(&self, b: usize) -> Range<usize> {
        let q = self.modal(b);
        q.end..q.end + self.n_modes
    }
    /// Dynamic inflow states.
    pub fn inflow(&self) -> Range<usize> {
        let start = 13 + 2 * self.n_modes * self.n_blades;
        start..start + if self.dynamic_inflow { 3 } else { 0 }
    }
    /// Tail-rotor inflow.
    pub fn tail_inflow(&self) -> Range<usize> {
        let start = self.inflow().end;
        start..start + usize::from(self.tail_rotor)
    }
    /// Length of y.
    pub fn len(&self) -> usize {
        self.tail_inflow().end
    }
    /// Never: the body states are always there.
    pub fn is_empty(&self) -> bool {
        false
    }
    /// Name and unit of every state.
    pub fn names(&self) -> Vec<(String, &'static str)> {
        let mut names: Vec<(String, &'static str)> = Vec::with_capacity(self.len());
        names.extend(["u", "v", "w"].map(|n| (n.to_string(), "m/s")));
        names.extend(["p", "q", "r"].map(|n| (n.to_string(), "rad/s")));
        names.extend((0..4).map(|i| (format!("quaternion_{i}"), "1")));
        names.extend(["north", "east", "down"].map(|n| (n.to_string(), "m")));
        for b in 0..self.n_blades {
            names.extend((0..self.n_modes).map(|i| (format!("blade_{b}_modal_{i}"), "m kg^0.5")));
            names.extend((0..self.n_modes).map(|i| (format!("blade_{b}_modal_rate_{i}"), "m kg^0.5/s")));
        }
        if self.dynamic_inflow {
            names.extend(["inflow_0", "inflow_1s", "inflow_1c"].map(|n| (n.to_string(), "1")));
        }
        if self.tail_rotor {
            names.push(("tail_rotor_inflow".to_string(), "1"));
        }
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
