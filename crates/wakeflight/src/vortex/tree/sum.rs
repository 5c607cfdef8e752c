//! The sum over a tree at blocks of points in double precision, for any core.

use super::blocks::{Block, Blocks};
use super::cells::Cells;
use super::far_field::over_harmonics;
use super::harmonics::VELOCITY_DEGREE;
use super::lists::{Acceptance, Found, Lists, over_blocks};
use crate::numerics::instruction_set::InstructionSet;
use crate::vortex::arithmetic::Arithmetic;
use crate::vortex::dispatch::{OverLanes, run};
use crate::vortex::kernel::{Vectors, gathered, over_sources, scattered, splats};
use crate::vortex::lanes::{LEAST_SQUARE, Lanes, Roots};
use crate::vortex::models::{ForModel, Model};
use pulp::Simd;
use std::marker::PhantomData;

/// The sum of a tree at points.
pub(super) struct TreeSum<'a> {
    /// Where.
    pub blocks: &'a Blocks,
    /// Of what.
    pub cells: &'a Cells,
    /// How exact.
    pub acceptance: Acceptance,
    /// Added to, one entry for each point in the order they were given in.
    pub velocity: &'a mut [[f64; 3]],
    /// Largest bound, and evaluations of all blocks.
    pub found: &'a mut Found,
}

impl ForModel for TreeSum<'_> {
    fn run<M: Model, const TO_SEGMENT: bool>(self) {
        let (cells, instruction_set) = (self.cells, InstructionSet::in_use());
        *self.found = over_blocks(
            self.blocks,
            cells,
            self.acceptance,
            self.velocity,
            |block: &Block<'_>, lists, velocity| {
                add_block::<M, TO_SEGMENT>(block, cells, lists, velocity, instruction_set);
            },
        );
    }
}

/// Adds what the lists of one block hold.
pub(super) fn add_block<M: Model, const TO_SEGMENT: bool>(
    block: &Block<'_>,
    cells: &Cells,
    lists: &Lists<'_>,
    velocity: &mut [[f64; 3]],
    instruction_set: InstructionSet,
) {
    let (points, model) = (block.points, PhantomData::<M>);
    run(BlockSum::<M, TO_SEGMENT> { points, cells, lists, velocity, model }, instruction_set);
}

/// The sum of the lists of one block.
struct BlockSum<'a, M, const TO_SEGMENT: bool> {
    points: &'a [[f64; 3]],
    cells: &'a Cells,
    lists: &'a Lists<'a>,
    velocity: &'a mut [[f64; 3]],
    model: PhantomData<M>,
}

impl<M: Model, const TO_SEGMENT: bool> OverLanes for BlockSum<'_, M, TO_SEGMENT> {
    #[inline(always)]
    fn run<S: Simd, R: Roots<S>>(self, simd: S, roots: R) {
        let (on, count) = (Lanes::new(simd, roots), Lanes::<S, R>::COUNT);
        let sources = &self.cells.sources;
        for (points, velocity) in self.points.chunks(count).zip(self.velocity.chunks_mut(count)) {
            let points = gathered(on, points);
            let mut sum = [on.splat(0.0); 3];
            for &(leaf, _) in &self.lists.near {
                let strands = &sources.strands[leaf.strands.start..leaf.strands.end];
                let pieces = &sources.pieces[leaf.pieces.start..leaf.pieces.end];
                over_sources::<S, R, M, TO_SEGMENT>(on, &points, strands, pieces, &mut sum);
            }
            let [dipoles, quadrupoles, octupoles, all] = &self.lists.far;
            add_far::<S, R, 2>(on, &points, self.cells, dipoles, &mut sum);
            add_far::<S, R, 3>(on, &points, self.cells, quadrupoles, &mut sum);
            add_far::<S, R, 4>(on, &points, self.cells, octupoles, &mut sum);
            add_far::<S, R, VELOCITY_DEGREE>(on, &points, self.cells, all, &mut sum);
            scattered::<S>(&sum, velocity);
        }
    }
}

/// Adds the expansions of the cells `far` to velocity degree `HIGHEST`.
#[inline(always)]
fn add_far<S: Simd, R: Roots<S>, const HIGHEST: usize>(
    on: Lanes<S, R>,
    points: &Vectors<S>,
    cells: &Cells,
    far: &[usize],
    sum: &mut Vectors<S>,
) {
    for &i in far {
        let centre = splats(on, &cells.cells[i].centre);
        let separation =
            [on.sub(points[0], centre[0]), on.sub(points[1], centre[1]), on.sub(points[2], centre[2])];
        over_harmonics::<_, HIGHEST>(on, &separation, LEAST_SQUARE, &cells.coefficients[i], sum);
    }
}
