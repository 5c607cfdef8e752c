//! The sum over a tree in single precision, core of Vatistas n = 2: twice the lanes, half the memory.
//!
//! Places are seen from the middle of a leaf or of a block, where they are small, instead of from an origin far away: what
//! rounding leaves of a place is 6e-8 of the size of a leaf and a block, and of a velocity that over the core radius. Lengths are over
//! the radius of the largest cell, circulations over the largest one; in the expansions lengths are over the radius of the
//! cell, so that powers keep within range.

use super::blocks::{Block, Blocks};
use super::cells::Cells;
use super::far_field::over_harmonics;
use super::harmonics::{N_COEFFICIENTS, VELOCITY_DEGREE, degrees};
use super::lists::{Acceptance, Found, Lists, over_blocks};
use super::order::distance;
use crate::numerics::instruction_set::InstructionSet;
use crate::vortex::core::{Core, CoreDistance};
use crate::vortex::single::kernel::{Tile, Total, Vectors, gathered, over_sources, splats};
use crate::vortex::single::lanes::{Lanes, OverLanes, Root, run};
use crate::vortex::single::{LEAST_CORE, SingleStrands};
use pulp::Simd;

/// Rounding of a place over its distance, doubled: that of the place seen and of the one it is seen from.
const ROUNDING: f64 = 1.2e-7;
/// Share of the tolerance that rounding may take.
const SHARE_OF_ROUNDING: f64 = 0.05;
/// Largest place of a point from the middle of its block, and largest core radius, over the radius of the largest cell.
const LARGEST: f64 = 1e3;
/// Farthest point, over the same.
const FARTHEST: f64 = 1e8;

/// The cells of a tree once more in single precision.
pub(super) struct SingleCells<'a> {
    cells: &'a Cells,
    coefficients: Vec<[f32; N_COEFFICIENTS]>,
    sources: SingleStrands,
    /// Radius of the largest cell [m].
    unit: f64,
    /// Velocity of the largest circulation over the unit of length [m/s].
    unit_velocity: f64,
}

impl<'a> SingleCells<'a> {
    /// None where rounding would take more of the relative error `tolerance` than a small part, or numbers are out of range.
    pub fn new(cells: &'a Cells, blocks: &Blocks, tolerance: f64) -> Option<Self> {
        let largest = cells.cells.first()?;
        let unit = largest.radius;
        let strength = cells.sources.pieces.iter().fold(0.0f64, |most, piece| most.max(piece.strength.abs()));
        let (mut reach, mut farthest) = (0.0f64, 0.0f64);
        for block in blocks.each() {
            reach = reach.max(block.reach);
            farthest = farthest.max(distance(block.middle, largest.centre));
        }
        let fits = unit > 0.0
            && strength > 0.0
            && reach <= LARGEST * unit
            && farthest <= FARTHEST * unit
            && largest.core_radius <= LARGEST * unit;
        if !fits {
            return None;
        }
        let mut sources = SingleStrands::default();
        sources.clear(Some(unit));
        // a circulation of 4 pi units becomes one
        let circulation = 4.0 * std::f64::consts::PI * unit / strength;
        for cell in &cells.cells {
            let Some(leaf) = &cell.leaf else { continue };
            let allowed = ROUNDING * (cell.radius + reach) / (SHARE_OF_ROUNDING * tolerance);
            let least_core = allowed.max(f64::from(LEAST_CORE) * unit);
            let seen = |place: [f64; 3]| std::array::from_fn(|c| place[c] - cell.centre[c]);
            let mut pieces = cells.sources.pieces[leaf.pieces.clone()].iter();
            for strand in &cells.sources.strands[leaf.strands.clone()] {
                let mut from = strand.start;
                for (i, piece) in pieces.by_ref().take(strand.n_pieces).enumerate() {
                    let core_radius = piece.core_sq.sqrt();
                    if core_radius < least_core && piece.strength != 0.0 {
                        return None;
                    }
                    let ends = [seen(from), seen(piece.end)];
                    sources.push(ends, circulation * piece.strength, core_radius, i == 0);
                    from = piece.end;
                }
            }
        }
        let mut coefficients = Vec::with_capacity(cells.coefficients.len());
        for (cell, of_cell) in cells.cells.iter().zip(&cells.coefficients) {
            let per_radius = if cell.radius > 0.0 { 1.0 / cell.radius } else { 1.0 / unit };
            let scaled = scaled(of_cell, per_radius, unit / strength);
            if !scaled.iter().all(|c| c.is_finite()) {
                return None;
            }
            coefficients.push(scaled);
        }
        Some(Self { cells, coefficients, sources, unit, unit_velocity: strength / unit })
    }

    /// As [`TreeSum`](super::sum::TreeSum).
    pub fn add(&self, blocks: &Blocks, acceptance: Acceptance, velocity: &mut [[f64; 3]]) -> Found {
        let set = InstructionSet::in_use();
        over_blocks(blocks, self.cells, acceptance, velocity, |block: &Block<'_>, lists, velocity| {
            let points: Vec<[f64; 3]> =
                block.points.iter().map(|p| std::array::from_fn(|c| p[c] - block.middle[c])).collect();
            let (cells, middle) = (self, block.middle);
            match acceptance.core_distance {
                CoreDistance::Line => {
                    run(BlockSum::<false> { points: &points, middle, cells, lists, velocity }, set)
                }
                CoreDistance::Segment => {
                    run(BlockSum::<true> { points: &points, middle, cells, lists, velocity }, set)
                }
            }
            for v in velocity {
                *v = v.map(|c| c * self.unit_velocity);
            }
        })
    }

    /// Adds the expansions of the cells `far` to velocity degree `HIGHEST` at points given from `middle`.
    #[inline(always)]
    fn add_far<S: Simd, R: Root<S>, const HIGHEST: usize>(
        &self,
        on: Lanes<S, R>,
        middle: [f64; 3],
        far: &[usize],
        seen: &mut [(Vectors<S>, Tile<S>, Total<S>)],
    ) {
        for &i in far {
            let cell = &self.cells.cells[i];
            let centre = from_middle(middle, cell.centre, 1.0 / self.unit);
            let per_radius = if cell.radius > 0.0 { (self.unit / cell.radius) as f32 } else { 1.0 };
            let per_radius = on.splat(per_radius);
            for (points, _, total) in &mut *seen {
                let at = seen_from(on, points, &centre);
                let at = [on.mul(at[0], per_radius), on.mul(at[1], per_radius), on.mul(at[2], per_radius)];
                let mut sum = Tile::new(on);
                over_harmonics::<_, HIGHEST>(on, &at, &self.coefficients[i], &mut sum.sum);
                total.add(on, sum);
            }
        }
    }

    /// Whether sums with this core can be taken so.
    pub fn knows(core: Core) -> bool {
        core == Core::Vatistas2
    }
}

/// Coefficients for lengths over the radius of a cell, over a velocity.
fn scaled(coefficients: &[f64; N_COEFFICIENTS], per_radius: f64, per_velocity: f64) -> [f32; N_COEFFICIENTS] {
    let mut scaled = [0.0; N_COEFFICIENTS];
    for ((scaled, value), degree) in scaled.iter_mut().zip(coefficients).zip(degrees()) {
        *scaled = (value * per_velocity * per_radius.powi(degree as i32 + 1)) as f32;
    }
    scaled
}

/// The sum of the lists of one block.
struct BlockSum<'a, const TO_SEGMENT: bool> {
    /// Seen from the middle of the block [m].
    points: &'a [[f64; 3]],
    middle: [f64; 3],
    cells: &'a SingleCells<'a>,
    lists: &'a Lists<'a>,
    velocity: &'a mut [[f64; 3]],
}

impl<const TO_SEGMENT: bool> OverLanes for BlockSum<'_, TO_SEGMENT> {
    #[inline(always)]
    fn run<S: Simd, R: Root<S>>(self, simd: S, root: R) {
        let (on, count) = (Lanes::new(simd, root), Lanes::<S, R>::COUNT);
        let SingleCells { cells, sources, unit, .. } = self.cells;
        let per_unit = 1.0 / unit;
        let mut seen = Vec::with_capacity(self.points.len().div_ceil(count));
        for points in self.points.chunks(count) {
            seen.push((gathered(on, points, per_unit), Tile::new(on), Total::new(on)));
        }
        // source by source for all points: what is read of a source is read once
        for &(leaf, i) in &self.lists.near {
            let Some(part) = sources.part(leaf.strands.clone(), leaf.pieces.clone()) else { continue };
            let strands = &cells.sources.strands[leaf.strands.start..leaf.strands.end];
            let centre = from_middle(self.middle, cells.cells[i].centre, per_unit);
            for (points, tile, total) in &mut seen {
                let at = seen_from(on, points, &centre);
                *tile = over_sources::<S, R, TO_SEGMENT>(on, &at, strands, part, *tile, total);
            }
        }
        let [dipoles, quadrupoles, octupoles, all] = &self.lists.far;
        self.cells.add_far::<S, R, 2>(on, self.middle, dipoles, &mut seen);
        self.cells.add_far::<S, R, 3>(on, self.middle, quadrupoles, &mut seen);
        self.cells.add_far::<S, R, 4>(on, self.middle, octupoles, &mut seen);
        self.cells.add_far::<S, R, VELOCITY_DEGREE>(on, self.middle, all, &mut seen);
        for ((_, tile, total), velocity) in seen.iter_mut().zip(self.velocity.chunks_mut(count)) {
            total.add(on, *tile);
            total.scatter(velocity);
        }
    }
}

/// A place over the unit of length, seen from `middle`.
fn from_middle(middle: [f64; 3], place: [f64; 3], per_unit: f64) -> [f32; 3] {
    [
        ((place[0] - middle[0]) * per_unit) as f32,
        ((place[1] - middle[1]) * per_unit) as f32,
        ((place[2] - middle[2]) * per_unit) as f32,
    ]
}

/// Points seen from `centre`.
#[inline(always)]
fn seen_from<S: Simd, R: Root<S>>(on: Lanes<S, R>, points: &Vectors<S>, centre: &[f32; 3]) -> Vectors<S> {
    let centre = splats(on, centre);
    [on.sub(points[0], centre[0]), on.sub(points[1], centre[1]), on.sub(points[2], centre[2])]
}
