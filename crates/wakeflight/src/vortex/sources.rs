//! Segments packed once for several sums, whole or in parts.

pub use super::strands::Packing;

use super::single::SinglePart;
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
    pub(super) single: Option<SinglePart<'a>>,
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
    /// Without segments; those that come are packed as told.
    pub fn clear(&mut self, packing: Packing) {
        self.strands.clear(packing);
    }

    /// Appends a segment; one that starts where the last ended shares the node.
    pub fn push(&mut self, start: [f64; 3], end: [f64; 3], circulation: f64, core_radius: f64) {
        self.strands.push(start, end, circulation, core_radius, false);
    }

    /// Becomes a copy of `other` without cores below `floor` [m]: the bits of its segments appended with the larger of the two.
    pub fn copy_floored(&mut self, other: &Self, floor: f64) {
        self.strands.copy_floored(&other.strands, floor);
    }

    /// The place after the last segment; a part may begin or end here.
    pub fn mark(&mut self) -> Mark {
        self.strands.cut();
        Mark { strands: self.strands.strands.len(), pieces: self.strands.n_pieces }
    }

    /// What was appended between two marks.
    #[must_use]
    pub fn part(&self, from: Mark, to: Mark) -> Part<'_> {
        let (strands, pieces) = (from.strands..to.strands, from.pieces..to.pieces);
        Part {
            strands: &self.strands.strands[strands.clone()],
            pieces: self.strands.pieces.get(pieces.clone()).unwrap_or_default(),
            single: self.strands.single.part(strands, pieces),
        }
    }

    /// Least core radius [m], at least that of rounding; infinite without segments.
    #[must_use]
    pub fn least_core(&self) -> f64 {
        self.strands.least_core_sq.sqrt()
    }

    /// Everything.
    #[must_use]
    pub fn whole(&self) -> Part<'_> {
        Part::of(&self.strands)
    }
}

impl<'a> Part<'a> {
    pub(super) fn of(strands: &'a Strands) -> Self {
        let single = strands.single.part(0..strands.strands.len(), 0..strands.n_pieces);
        Self { strands: &strands.strands, pieces: &strands.pieces, single }
    }

    /// Number of segments.
    #[must_use]
    pub fn len(&self) -> usize {
        self.single.map_or(self.pieces.len(), |single| single.len())
    }

    /// Whether there is no segment.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Group<'_> {
    /// Whether all that is seen was packed for sums in single precision.
    #[must_use]
    pub fn is_single(&self) -> bool {
        self.sources.iter().all(|part| part.single.is_some())
    }

    /// Evaluations of a segment at a point.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        (self.points.len() * self.sources.iter().map(Part::len).sum::<usize>()) as u64
    }
}
