//! The sum over a tree in single precision, core of Vatistas n = 2: twice the lanes, half the memory.
//!
//! Places are seen from the middle of a cell, where they are small, instead of from an origin far away, and lengths are over its
//! radius: a wake may hold very fine parts. Circulations are over the largest one. A block where rounding could take more than a
//! small part of the tolerance (rounding.rs) is summed in double precision.

use super::blocks::{Block, Blocks};
use super::cells::Cells;
use super::far_field::over_harmonics;
use super::harmonics::{N_COEFFICIENTS, VELOCITY_DEGREE, degrees};
use super::lists::{Acceptance, Found, Lists, over_blocks};
use super::order::distance;
use super::rounding::{Swirl, rounded_off};
use super::sum::add_block;
use crate::numerics::instruction_set::InstructionSet;
use crate::vortex::arithmetic::Arithmetic;
use crate::vortex::core::{Core, CoreDistance};
use crate::vortex::models::Vatistas2;
use crate::vortex::single::kernel::{Tile, Total, Vectors, gathered, over_sources, splats};
use crate::vortex::single::lanes::{Lanes, OverLanes, Root, run};
use crate::vortex::single::{SingleStrands, within_range};
use pulp::Simd;

/// Share of the error allowed of a cell that rounding may take at a point.
const SHARE_OF_ROUNDING: f64 = 0.1;
/// Largest place of a point from the middle of its block over the radius of the largest cell.
const LARGEST: f64 = 1e3;
/// Farthest point, over the same.
const FARTHEST: f64 = 1e8;
/// Smallest cell, over the same.
const SMALLEST: f64 = 1e-9;
/// Square of the least distance from a cell that is taken by its expansion, over the cell's radius; more than one but for rounding.
const LEAST_SQUARE: f64 = 0.5;

/// The cells of a tree once more in single precision.
pub(super) struct SingleCells<'a> {
    cells: &'a Cells,
    coefficients: Vec<[f32; N_COEFFICIENTS]>,
    sources: SingleStrands,
    swirls: Vec<Swirl>,
    /// Radius of the largest cell [m].
    unit: f64,
    /// Velocity of the largest circulation over the unit of length [m/s].
    unit_velocity: f64,
}

impl<'a> SingleCells<'a> {
    /// None where numbers are out of range.
    pub fn new(cells: &'a Cells, blocks: &Blocks) -> Option<Self> {
        let largest = cells.cells.first()?;
        let unit = largest.radius;
        let strength = cells.sources.pieces.iter().fold(0.0f64, |most, piece| most.max(piece.strength.abs()));
        let (mut reach, mut farthest) = (0.0f64, 0.0f64);
        for block in blocks.each() {
            reach = reach.max(block.reach);
            farthest = farthest.max(distance(block.middle, largest.centre));
        }
        let fits = unit > SMALLEST * distance(largest.centre, [0.0; 3])
            && strength > 0.0
            && reach <= LARGEST * unit
            && farthest <= FARTHEST * unit
            && cells.cells.iter().all(|cell| cell.radius >= SMALLEST * unit);
        if !fits {
            return None;
        }
        // packed as they are: lengths are over the radius of the cell already
        let mut sources = SingleStrands::default();
        sources.clear(Some(1.0));
        let circulation = 4.0 * std::f64::consts::PI * unit / strength;
        let mut swirls = Swirl::of_all(cells);
        for (cell, swirl) in cells.cells.iter().zip(&mut swirls) {
            let Some(leaf) = &cell.leaf else { continue };
            let per_radius = 1.0 / cell.radius;
            let seen = |place: [f64; 3]| std::array::from_fn(|c| per_radius * (place[c] - cell.centre[c]));
            let mut pieces = cells.sources.pieces[leaf.pieces.clone()].iter();
            for strand in &cells.sources.strands[leaf.strands.clone()] {
                let mut from = strand.start;
                for (i, piece) in pieces.by_ref().take(strand.n_pieces).enumerate() {
                    let core_radius = per_radius * piece.core_sq.sqrt();
                    let gamma = per_radius * circulation * piece.strength;
                    if !within_range(core_radius, gamma) {
                        *swirl = Swirl::UNKNOWN;
                    }
                    let ends = [seen(from), seen(piece.end)];
                    sources.push(ends, gamma, core_radius, i == 0);
                    from = piece.end;
                }
            }
        }
        let mut coefficients = Vec::with_capacity(cells.coefficients.len());
        for (cell, of_cell) in cells.cells.iter().zip(&cells.coefficients) {
            let scaled = scaled(of_cell, 1.0 / cell.radius, unit / strength);
            if !scaled.iter().all(|c| c.is_finite()) {
                return None;
            }
            coefficients.push(scaled);
        }
        Some(Self { cells, coefficients, sources, swirls, unit, unit_velocity: strength / unit })
    }

    /// As [`TreeSum`](super::sum::TreeSum).
    pub fn add(&self, blocks: &Blocks, acceptance: Acceptance, velocity: &mut [[f64; 3]]) -> Found {
        let set = InstructionSet::in_use();
        over_blocks(blocks, self.cells, acceptance, velocity, |block: &Block<'_>, lists, velocity| {
            let to_segment = acceptance.core_distance == CoreDistance::Segment;
            let rounded_off = rounded_off(block, lists, self.cells, &self.swirls);
            if rounded_off.is_nan() || rounded_off > SHARE_OF_ROUNDING * acceptance.tolerance {
                return if to_segment {
                    add_block::<Vatistas2, true>(block, self.cells, lists, velocity, set);
                } else {
                    add_block::<Vatistas2, false>(block, self.cells, lists, velocity, set);
                };
            }
            let points: Vec<[f64; 3]> =
                block.points.iter().map(|p| std::array::from_fn(|c| p[c] - block.middle[c])).collect();
            let (cells, middle) = (self, block.middle);
            if to_segment {
                run(BlockSum::<true> { points: &points, middle, cells, lists, velocity }, set);
            } else {
                run(BlockSum::<false> { points: &points, middle, cells, lists, velocity }, set);
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
            let per_radius = (self.unit / cell.radius) as f32;
            for (points, _, total) in &mut *seen {
                let at = seen_from(on, points, &centre, per_radius);
                let mut sum = Tile::new(on);
                over_harmonics::<_, HIGHEST>(on, &at, LEAST_SQUARE, &self.coefficients[i], &mut sum.sum);
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
            let cell = &cells.cells[i];
            let centre = from_middle(self.middle, cell.centre, per_unit);
            let per_radius = (unit / cell.radius) as f32;
            for (points, tile, total) in &mut seen {
                let at = seen_from(on, points, &centre, per_radius);
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

/// Points seen from `centre`, times `per_radius`.
#[inline(always)]
fn seen_from<S: Simd, R: Root<S>>(
    on: Lanes<S, R>,
    points: &Vectors<S>,
    centre: &[f32; 3],
    per_radius: f32,
) -> Vectors<S> {
    let (centre, per_radius) = (splats(on, centre), on.splat(per_radius));
    [
        on.mul(per_radius, on.sub(points[0], centre[0])),
        on.mul(per_radius, on.sub(points[1], centre[1])),
        on.mul(per_radius, on.sub(points[2], centre[2])),
    ]
}
