//! What can be chosen of a free wake: schemes, vortex models, ways to sum.

use super::options::describe::{Kind, Plain, Value, Word, choices};
use crate::airfoil::unsteady::Model as Unsteady;
use crate::vortex::core;

impl Value for Unsteady {
    const KIND: Kind = Kind::Word;
    const WORDS: &'static [Word] = &[
        Word {
            word: Unsteady::QuasiSteady.name(),
            meaning: "The table at the angle of attack of the instant, with the damping by the pitch rate.",
        },
        Word {
            word: Unsteady::Attached.name(),
            meaning: "Attached compressible flow: shed wake and impulsive loads, on the table.",
        },
        Word { word: Unsteady::Oye.name(), meaning: "Stall with one state: the separation point lags." },
        Word {
            word: Unsteady::Hgm.name(),
            meaning: "Stall with four states: shed wake, pressure and separation point; no stall vortex.",
        },
    ];
    fn plain(self) -> Plain {
        Plain::Word(self.name())
    }
}

choices! {
    /// Corrector of the time-marching wake.
    pub enum Scheme {
        /// Second-order backward in azimuth at the new level, centred in age.
        Bdf2 = "bdf2",
        /// Second-order backward in azimuth at the centre of the cell.
        Pc2b = "pc2b",
        /// Five-point central in azimuth and age.
        Pcc = "pcc",
        /// Second-order backward along the path of every marker.
        Path2 = "path2",
    }
}

choices! {
    /// Predictor of the time-marching wake.
    pub enum Predictor {
        /// Stencil of the corrector.
        Same = "same",
        /// Five-point central.
        Central = "central",
    }
}

choices! {
    /// Fields that a step of the time-marching wake evaluates.
    pub enum Evaluation {
        /// Predict, evaluate, correct, evaluate: a step begins with the field of the corrected wake.
        Pece = "pece",
        /// Predict, evaluate, correct: a step begins with the field of the wake that the last step predicted.
        Pec = "pec",
    }
}

choices! {
    /// How the vortices are summed at the markers.
    pub enum Summation {
        /// By the tree where it was measured to be faster.
        Auto = "auto",
        /// Every segment at every point.
        Direct = "direct",
        /// By the tree.
        Tree = "tree",
    }
}

choices! {
    /// Numbers that the vortices are summed in.
    pub enum Precision {
        /// Double precision.
        Double = "double",
        /// Single precision, error about 1e-6 of the largest velocity; double at points asked for.
        Single = "single",
    }
}

choices! {
    /// Unknown that the stencils of the time-marching wake act on.
    pub enum Form {
        /// Displacement of a marker from the place of its release.
        Displacement = "displacement",
        /// Position.
        Position = "position",
    }
}

choices! {
    /// Circulation of the tip vortex from that of the blade.
    pub enum TipStrength {
        /// Uniform circulation of equal thrust.
        Equivalent = "equivalent",
        /// Crest of the outboard circulation.
        Max = "max",
        /// Mean of the outboard circulation.
        Mean = "mean",
    }
}

choices! {
    /// What trails inboard of the tip vortex, beyond the near wake.
    pub enum InboardWake {
        /// Nothing.
        None = "none",
        /// Rigid helical filaments that close the tip vortex inboard.
        Sheet = "sheet",
    }
}

choices! {
    /// Free filaments that leave a blade.
    pub enum Trailers {
        /// One, the tip vortex.
        Tip = "tip",
        /// One at every edge between panels, from root to tip, joined by shed vortices: a lattice of vortex rings.
        FullSpan = "full-span",
    }
}

choices! {
    /// Shed vortices of a full-span wake that blades and markers see.
    pub enum ShedWake {
        /// None: trailing vortices only.
        None = "none",
        /// All, but a blade sees what it shed over its near wake gathered at the near wake's end.
        Beyond = "beyond",
        /// All, at the places where they are.
        All = "all",
    }
}

choices! {
    /// What goes on behind the old ends of the free filaments.
    pub enum FarWake {
        /// The last turn carried on by the flow; nothing where there are no turns of it.
        Repeat = "repeat",
        /// A semi-infinite vortex cylinder; tip vortices alone, in hover and climb.
        Cylinder = "cylinder",
    }
}

choices! {
    /// Where along the chord the sections of a blade meet the air of its own wake.
    pub enum BladeModel {
        /// At the quarter chord, on the bound line.
        LiftingLine = "lifting-line",
        /// At three quarters of the chord of compressible flow, behind the bound line; by the tables at the angle there.
        SecondOrder = "second-order",
    }
}

choices! {
    /// What the parts of the airframe feel of the rotor.
    pub enum Wash {
        /// The tables or factors of the aircraft, on the mean inflow.
        Tables = "tables",
        /// The velocity of the wake itself, mean over a blade passage and over points of each part.
        Wake = "wake",
    }
}

choices! {
    /// What the blades feel of the fuselage.
    pub enum FuselageUpwash {
        /// Nothing.
        None = "none",
        /// Potential flow about a spheroid at its reference point, one rotor radius long and 0.3 thick.
        Spheroid = "spheroid",
    }
}

choices! {
    /// Distance that enters the core factor of a segment.
    pub enum CoreDistance {
        /// To the infinite line through the segment.
        Line = "line",
        /// To the segment itself.
        Segment = "segment",
    }
}

impl From<CoreDistance> for core::CoreDistance {
    fn from(distance: CoreDistance) -> Self {
        match distance {
            CoreDistance::Line => Self::Line,
            CoreDistance::Segment => Self::Segment,
        }
    }
}
