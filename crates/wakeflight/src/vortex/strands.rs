//! Sources of induced velocity, packed in the order the sum visits them.

use super::core::{END_GUARD, LEAST_CORE};
use super::single::SingleStrands;

/// One segment as the sum reads it, ending where the next of its strand starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// End point [m].
    pub end: [f64; 3],
    /// End minus start [m].
    pub along: [f64; 3],
    /// Circulation over 4 pi.
    pub strength: f64,
    /// length^2.
    pub length_sq: f64,
    /// core_radius^2.
    pub core_sq: f64,
    /// core_radius^2 length^2.
    pub area: f64,
    /// Square of `area`.
    pub area_sq: f64,
    /// r1 r2 below which the point lies on an end.
    pub end_guard: f64,
}

/// Joined segments: the end of one is the start of the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Strand {
    /// Start point of the first piece [m].
    pub start: [f64; 3],
    /// Number of pieces.
    pub n_pieces: usize,
}

/// What the segments of a sum are packed for; a unit of length [m] for single precision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Packing {
    /// Sums in double precision.
    #[default]
    Double,
    /// Sums in single precision alone.
    Single(f64),
    /// Either.
    Both(f64),
}

/// All sources of one sum.
#[derive(Clone, Debug)]
pub(super) struct Strands {
    /// Strands in their order.
    pub strands: Vec<Strand>,
    /// Pieces of all strands, one strand after the other; none where they are packed for single precision alone.
    pub pieces: Vec<Piece>,
    /// The same in single precision, where it is asked for.
    pub single: SingleStrands,
    /// Number of pieces, in whatever precision.
    pub n_pieces: usize,
    /// Least square of a core radius [m2], at least that of rounding.
    pub least_core_sq: f64,
    in_double: bool,
    /// Where the last piece ends; none where the next starts a strand, wherever it begins.
    end: Option<[f64; 3]>,
}

impl Default for Strands {
    fn default() -> Self {
        Self {
            strands: Vec::new(),
            pieces: Vec::new(),
            single: SingleStrands::default(),
            n_pieces: 0,
            least_core_sq: f64::INFINITY,
            in_double: true,
            end: None,
        }
    }
}

impl Strands {
    /// In double precision, with room for `n_segments`.
    pub fn with_capacity(n_segments: usize) -> Self {
        Self { pieces: Vec::with_capacity(n_segments), ..Self::default() }
    }

    /// Without sources; room is kept.
    pub fn clear(&mut self, packing: Packing) {
        let (in_double, unit) = match packing {
            Packing::Double => (true, None),
            Packing::Single(unit) => (false, Some(unit)),
            Packing::Both(unit) => (true, Some(unit)),
        };
        self.strands.clear();
        self.pieces.clear();
        self.single.clear(unit);
        (self.n_pieces, self.least_core_sq, self.in_double, self.end) = (0, f64::INFINITY, in_double, None);
    }

    /// Ends the last strand.
    pub fn cut(&mut self) {
        self.end = None;
    }

    /// Appends a segment; it continues the last strand where it starts at that strand's end.
    pub fn push(
        &mut self,
        start: [f64; 3],
        end: [f64; 3],
        circulation: f64,
        core_radius: f64,
        coreless: bool,
    ) {
        let new_strand = match self.strands.last_mut() {
            Some(strand) if self.end == Some(start) => {
                strand.n_pieces += 1;
                false
            }
            _ => {
                self.strands.push(Strand { start, n_pieces: 1 });
                true
            }
        };
        self.end = Some(end);
        self.n_pieces += 1;
        self.single.push([start, end], circulation, core_radius, new_strand);
        let along = [end[0] - start[0], end[1] - start[1], end[2] - start[2]];
        let length_sq = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
        let least_sq = LEAST_CORE * LEAST_CORE * length_sq;
        let core_sq = if coreless { least_sq } else { least_sq.max(core_radius * core_radius) };
        self.least_core_sq = self.least_core_sq.min(core_sq);
        if !self.in_double {
            return;
        }
        let area = core_sq * length_sq;
        self.pieces.push(Piece {
            end,
            along,
            strength: circulation / (4.0 * std::f64::consts::PI),
            length_sq,
            core_sq,
            area,
            area_sq: area * area,
            end_guard: END_GUARD * length_sq,
        });
    }

    /// Becomes a copy of `other` without cores below `floor` [m].
    pub fn copy_floored(&mut self, other: &Self, floor: f64) {
        let floor_sq = floor * floor;
        self.strands.clone_from(&other.strands);
        self.pieces.clone_from(&other.pieces);
        self.single.copy_floored(&other.single, floor);
        (self.n_pieces, self.in_double, self.end) = (other.n_pieces, other.in_double, other.end);
        self.least_core_sq = other.least_core_sq.max(floor_sq);
        for piece in &mut self.pieces {
            piece.core_sq = piece.core_sq.max(floor_sq);
            piece.area = piece.core_sq * piece.length_sq;
            piece.area_sq = piece.area * piece.area;
        }
    }
}
