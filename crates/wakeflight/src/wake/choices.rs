//! What can be chosen of a free wake: schemes, vortex models, ways to sum.

use crate::vortex::core;
use serde::{Deserialize, Serialize};

/// Corrector of the time-marching wake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Scheme {
    /// Second-order backward in azimuth at the new level, centred in age.
    Bdf2,
    /// Second-order backward in azimuth at the centre of the cell.
    Pc2b,
    /// Five-point central in azimuth and age.
    Pcc,
}

/// Predictor of the time-marching wake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Predictor {
    /// Stencil of the corrector.
    Same,
    /// Five-point central.
    Central,
}

/// Fields that a step of the time-marching wake evaluates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Evaluation {
    /// Predict, evaluate, correct, evaluate: a step begins with the field of the corrected wake.
    Pece,
    /// Predict, evaluate, correct: a step begins with the field of the wake that the last step predicted.
    Pec,
}

/// How the vortices are summed at the markers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Summation {
    /// By the tree where it was measured to be faster.
    Auto,
    /// Every segment at every point.
    Direct,
    /// By the tree.
    Tree,
}

/// Unknown that the stencils of the time-marching wake act on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Form {
    /// Displacement of a marker from the place of its release.
    Displacement,
    /// Position.
    Position,
}

/// Circulation of the tip vortex from that of the blade.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TipStrength {
    /// Uniform circulation of equal thrust.
    Equivalent,
    /// Crest of the outboard circulation.
    Max,
    /// Mean of the outboard circulation.
    Mean,
}

/// What trails inboard of the tip vortex, beyond the near wake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum InboardWake {
    /// Nothing.
    None,
    /// Rigid helical filaments.
    Sheet,
}

/// Free filaments that leave a blade.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Trailers {
    /// One, the tip vortex.
    Tip,
    /// One at every edge between panels, from root to tip, joined by shed vortices: a lattice of vortex rings.
    FullSpan,
}

/// Shed vortices of a full-span wake that blades and markers see.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ShedWake {
    /// None: trailing vortices only.
    None,
    /// All, but a blade sees what it shed over its near wake gathered at the near wake's end.
    Beyond,
    /// All, at the places where they are.
    All,
}

/// What goes on behind the old ends of the free filaments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FarWake {
    /// `far_wake_turns` repeats of the last turn; nothing where that is 0.
    Repeat,
    /// A semi-infinite vortex cylinder; tip vortices alone, in hover and climb.
    Cylinder,
}

/// Distance that enters the core factor of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CoreDistance {
    /// To the infinite line through the segment.
    Line,
    /// To the segment itself.
    Segment,
}

impl From<CoreDistance> for core::CoreDistance {
    fn from(distance: CoreDistance) -> Self {
        match distance {
            CoreDistance::Line => Self::Line,
            CoreDistance::Segment => Self::Segment,
        }
    }
}
