//! Sources of induced velocity, packed in the order the sum visits them.

use super::core::{END_GUARD, LEAST_CORE};

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

/// All sources of one sum.
#[derive(Clone, Debug, Default)]
pub(super) struct Strands {
    /// Strands in their order.
    pub strands: Vec<Strand>,
    /// Pieces of all strands, one strand after the other.
    pub pieces: Vec<Piece>,
    /// Whether the next piece starts a strand, wherever it begins.
    cut: bool,
}

impl Strands {
    /// With room for `n_segments`.
    pub fn with_capacity(n_segments: usize) -> Self {
        Self { strands: Vec::new(), pieces: Vec::with_capacity(n_segments), cut: false }
    }

    /// Without sources; room is kept.
    pub fn clear(&mut self) {
        self.strands.clear();
        self.pieces.clear();
        self.cut = false;
    }

    /// Ends the last strand.
    pub fn cut(&mut self) {
        self.cut = true;
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
        match (self.strands.last_mut(), self.pieces.last()) {
            (Some(strand), Some(last)) if last.end == start && !self.cut => strand.n_pieces += 1,
            _ => self.strands.push(Strand { start, n_pieces: 1 }),
        }
        self.cut = false;
        let along = [end[0] - start[0], end[1] - start[1], end[2] - start[2]];
        let length_sq = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
        let least_sq = LEAST_CORE * LEAST_CORE * length_sq;
        let core_sq = if coreless { least_sq } else { least_sq.max(core_radius * core_radius) };
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
}
