//! Segments as the sum in single precision reads them.

/// Farthest place from the origin, in units of length: beyond it, where a wake induces nothing any more, places are taken there.
pub(super) const FARTHEST: f32 = 1e4;
/// Least core radius in units of length: places are known to a tenth of it and better within a unit's distance.
pub(super) const LEAST_CORE: f32 = 1e-5;
/// Square of the length, in units of length, below which a segment has none.
const LEAST_LENGTH_SQ: f32 = 1e-18;
/// Largest circulation over 16 pi and the unit of length [m/s]: products stay finite.
pub(super) const MOST_STRENGTH: f32 = 1e6;

/// One segment, ending where the next of its strand starts; lengths over the unit.
#[derive(Clone, Copy, Debug)]
pub(in crate::vortex) struct SinglePiece {
    /// End point.
    pub(super) end: [f32; 3],
    /// Unit vector from start to end; zero without length.
    pub(super) direction: [f32; 3],
    /// Length.
    pub(super) length: f32,
    /// One over it; zero without length.
    pub(super) per_length: f32,
    /// A quarter of circulation over 4 pi and the unit of length [m/s]: the two roots of the law come twice as large.
    pub(super) strength: f32,
    /// Fourth power of the core radius.
    pub(super) core_4: f32,
}

/// The strands once more in single precision; empty without a unit of length.
#[derive(Clone, Debug, Default)]
pub(in crate::vortex) struct SingleStrands {
    /// One over the unit of length [1/m].
    pub(in crate::vortex) per_unit: Option<f64>,
    starts: Vec<[f32; 3]>,
    pieces: Vec<SinglePiece>,
}

/// Some of them.
#[derive(Clone, Copy, Debug)]
pub(in crate::vortex) struct SinglePart<'a> {
    /// One over the unit of length [1/m].
    pub(super) per_unit: f64,
    /// Starts of the strands.
    pub(super) starts: &'a [[f32; 3]],
    /// Pieces of all strands, one strand after the other.
    pub(super) pieces: &'a [SinglePiece],
}

/// Whether a core radius over the unit of length, and a circulation over the same [m/s], are packed as they are.
pub(in crate::vortex) fn within_range(core_radius: f64, circulation: f64) -> bool {
    let strength = circulation.abs() / (16.0 * std::f64::consts::PI);
    (f64::from(LEAST_CORE)..=f64::from(FARTHEST)).contains(&core_radius)
        && strength <= f64::from(MOST_STRENGTH)
}

/// A place over the unit of length; not a number stays not a number.
#[inline(always)]
pub(super) fn scaled(place: [f64; 3], per_unit: f64) -> [f32; 3] {
    place.map(|x| ((x * per_unit) as f32).clamp(-FARTHEST, FARTHEST))
}

/// Fourth power of a core radius over the unit of length.
#[inline(always)]
fn core_4(core_radius: f64, per_unit: f64) -> f32 {
    let core = ((core_radius * per_unit) as f32).clamp(LEAST_CORE, FARTHEST);
    (core * core) * (core * core)
}

impl SinglePart<'_> {
    /// Number of segments.
    pub(in crate::vortex) fn len(&self) -> usize {
        self.pieces.len()
    }
}

impl SingleStrands {
    /// Without sources, for lengths over `unit` [m]; room is kept.
    pub(in crate::vortex) fn clear(&mut self, unit: Option<f64>) {
        self.per_unit = unit.map(|unit| 1.0 / unit);
        self.starts.clear();
        self.pieces.clear();
    }

    /// Appends a segment [m, m2/s], of a new strand or of the last.
    pub(in crate::vortex) fn push(
        &mut self,
        [start, end]: [[f64; 3]; 2],
        circulation: f64,
        core_radius: f64,
        new_strand: bool,
    ) {
        let Some(per_unit) = self.per_unit else { return };
        if new_strand {
            self.starts.push(scaled(start, per_unit));
        }
        let along = scaled([end[0] - start[0], end[1] - start[1], end[2] - start[2]], per_unit);
        let length_sq = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
        let length = length_sq.sqrt();
        let (length, per_length) =
            if length_sq < LEAST_LENGTH_SQ { (0.0, 0.0) } else { (length, 1.0 / length) };
        let strength = (circulation / (16.0 * std::f64::consts::PI) * per_unit) as f32;
        self.pieces.push(SinglePiece {
            end: scaled(end, per_unit),
            direction: along.map(|a| a * per_length),
            length,
            per_length,
            strength: strength.clamp(-MOST_STRENGTH, MOST_STRENGTH),
            core_4: core_4(core_radius, per_unit),
        });
    }

    /// Becomes a copy of `other` without cores below `floor` [m].
    pub(in crate::vortex) fn copy_floored(&mut self, other: &Self, floor: f64) {
        self.per_unit = other.per_unit;
        self.starts.clone_from(&other.starts);
        self.pieces.clone_from(&other.pieces);
        let least = self.per_unit.map_or(0.0, |per_unit| core_4(floor, per_unit));
        for piece in &mut self.pieces {
            piece.core_4 = piece.core_4.max(least);
        }
    }

    /// Those of a range of strands and of their pieces; none where nothing was packed.
    pub(in crate::vortex) fn part(
        &self,
        strands: std::ops::Range<usize>,
        pieces: std::ops::Range<usize>,
    ) -> Option<SinglePart<'_>> {
        let per_unit = self.per_unit?;
        Some(SinglePart { per_unit, starts: self.starts.get(strands)?, pieces: self.pieces.get(pieces)? })
    }
}
