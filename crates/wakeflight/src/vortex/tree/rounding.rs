//! What single precision rounds off of the velocity at a block of points.

use super::blocks::Block;
use super::cells::{Cell, Cells};
use super::lists::Lists;
use super::order::distance;

/// Rounding of a place over its distance, doubled: that of the place seen and of the one it is seen from.
const OF_PLACE: f64 = 1.2e-7;
/// Of the velocity of a segment over that of an endless line as far away: of its two cosines, from roots good to units of the
/// last place.
const OF_SEGMENT: f64 = 4e-7;
/// Of the velocity of an expansion over the largest that a cell of its strength could have there, places apart.
const OF_EXPANSION: f64 = 1e-6;

/// What the segments of a leaf can do at most: circulation over 4 pi [m2/s], that over the core radius [m/s] and over its square [1/s].
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Swirl {
    strength: f64,
    velocity: f64,
    slope: f64,
}

/// Farthest point over the radius of a leaf that is summed segment by segment: its eighth power keeps within range.
const FARTHEST: f64 = 1e4;

impl Swirl {
    /// Of a leaf whose numbers are out of range.
    pub const UNKNOWN: Self = Self { strength: f64::INFINITY, velocity: f64::INFINITY, slope: f64::INFINITY };

    /// Of every cell that is not divided; of the others nothing.
    pub fn of_all(cells: &Cells) -> Vec<Self> {
        let of = |cell: &Cell| {
            let pieces =
                cell.leaf.as_ref().map_or(&[][..], |leaf| &cells.sources.pieces[leaf.pieces.clone()]);
            pieces.iter().fold(Self::default(), |most, piece| {
                let (strength, core) = (piece.strength.abs(), piece.core_sq.sqrt());
                Self {
                    strength: most.strength.max(strength),
                    velocity: most.velocity.max(strength / core),
                    slope: most.slope.max(strength / piece.core_sq),
                }
            })
        };
        cells.cells.iter().map(of).collect()
    }

    /// No more than at the core's edge, no more than `gap` [m] beside an endless line: velocity, and its slope.
    fn beyond(&self, gap: f64) -> (f64, f64) {
        (self.velocity.min(self.strength / gap), self.slope.min(self.strength / (gap * gap)))
    }
}

/// Estimate of what is rounded off [m/s]: places of the nearest segments, beside it what cancels, as it does by chance.
pub(super) fn rounded_off(block: &Block<'_>, lists: &Lists<'_>, cells: &Cells, swirls: &[Swirl]) -> f64 {
    let (mut of_place, mut squares) = (0.0f64, OF_EXPANSION * OF_EXPANSION * lists.far_squares);
    for &(leaf, i) in &lists.near {
        let cell = &cells.cells[i];
        let away = distance(block.middle, cell.centre);
        if away + block.reach > FARTHEST * cell.radius {
            return f64::INFINITY;
        }
        let (velocity, slope) = swirls[i].beyond((away - cell.radius - block.reach).max(0.0));
        of_place = of_place.max(2.0 * slope * OF_PLACE * (away.max(cell.radius) + block.reach));
        let of_segment = OF_SEGMENT * velocity;
        squares += leaf.pieces.len() as f64 * of_segment * of_segment;
    }
    of_place + squares.sqrt()
}
