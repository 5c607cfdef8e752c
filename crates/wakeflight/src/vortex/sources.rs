//! Segments packed once for several sums, whole or in parts.

use super::strands::{Piece, Strand, Strands};

/// Straight segments in the order of the sum; joined ones share their nodes. Room is kept when they are cleared.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    pub(super) strands: Strands,
}

/// A place between two segments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mark {
    strands: usize,
    pieces: usize,
}

/// Some of the segments, in their order.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    pub(super) strands: &'a [Strand],
    pub(super) pieces: &'a [Piece],
}

/// Points and what they see: the parts are summed one after the other.
#[derive(Debug)]
pub struct Group<'a> {
    /// Where [m].
    pub points: &'a [[f64; 3]],
    /// What.
    pub sources: &'a [Part<'a>],
    /// Added to, one entry for each point [m/s].
    pub velocity: &'a mut [[f64; 3]],
}

impl Sources {
    /// Without segments.
    pub fn clear(&mut self) {
        self.strands.clear();
    }

    /// Appends a segment; one that starts where the last ended shares the node.
    pub fn push(&mut self, start: [f64; 3], end: [f64; 3], circulation: f64, core_radius: f64) {
        self.strands.push(start, end, circulation, core_radius, false);
    }

    /// The place after the last segment; a part may begin or end here.
    pub fn mark(&mut self) -> Mark {
        self.strands.cut();
        Mark { strands: self.strands.strands.len(), pieces: self.strands.pieces.len() }
    }

    /// What was appended between two marks.
    #[must_use]
    pub fn part(&self, from: Mark, to: Mark) -> Part<'_> {
        Part {
            strands: &self.strands.strands[from.strands..to.strands],
            pieces: &self.strands.pieces[from.pieces..to.pieces],
        }
    }

    /// Least core radius [m], at least that of rounding; infinite without segments.
    #[must_use]
    pub fn least_core(&self) -> f64 {
        self.strands.pieces.iter().fold(f64::INFINITY, |least, piece| least.min(piece.core_sq)).sqrt()
    }

    /// Everything.
    #[must_use]
    pub fn whole(&self) -> Part<'_> {
        Part::of(&self.strands)
    }
}

impl<'a> Part<'a> {
    pub(super) fn of(strands: &'a Strands) -> Self {
        Self { strands: &strands.strands, pieces: &strands.pieces }
    }

    /// Number of segments.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pieces.len()
    }

    /// Whether there is no segment.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }
}

impl Group<'_> {
    /// Evaluations of a segment at a point.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        (self.points.len() * self.sources.iter().map(Part::len).sum::<usize>()) as u64
    }
}
