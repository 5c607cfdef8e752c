//! The sum over a tree at blocks of points: near cells segment by segment, far cells by their expansion.

use super::cells::{Cell, Cells, Leaf};
use super::far_field::over_harmonics;
use super::harmonics::remainder;
use super::order::{bounds, distance, into_blocks, middle};
use crate::numerics::instruction_set::InstructionSet;
use crate::vortex::core::{Core, CoreDistance, LAMB_OSEEN_ALPHA};
use crate::vortex::dispatch::{OverLanes, run};
use crate::vortex::kernel::{gathered, over_sources, scattered};
use crate::vortex::lanes::{Lanes, Roots};
use crate::vortex::models::{ForModel, Model};
use crate::vortex::threads::share;
use pulp::Simd;
use std::marker::PhantomData;

/// Points that share their lists of cells; a multiple of every number of lanes.
const BLOCK: usize = 32;

/// Weight of errors that have one sign over those that cancel.
const ONE_SIGN: f64 = 4.0;
/// The same for the many cells of vortex sheets.
const SHEETS: f64 = 16.0;

/// When a cell may be taken by its expansion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Acceptance {
    /// Core model of the segments.
    pub core: Core,
    /// Distance in the core factor.
    pub core_distance: CoreDistance,
    /// Largest estimated error of one cell [m/s].
    pub tolerance: f64,
}

/// What a block found.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Found {
    /// Bound of the sum of what the expansions leave out [m/s].
    pub bound: f64,
    /// Segment evaluations.
    pub near: u64,
    /// Cell evaluations.
    pub far: u64,
}

impl Acceptance {
    /// Bound of what the expansion of `cell` leaves out, and estimate of that with the cores it does not know, at
    /// `distance` from its centre [m/s].
    fn error(&self, cell: &Cell, distance: f64) -> (f64, f64) {
        let scale = cell.strength / (distance * distance);
        let bound = scale * remainder(cell.radius / distance);
        (bound, bound + scale * self.core_part(cell.core_radius / (distance - cell.radius)))
    }

    /// 1 - F of a far core, by core radius over distance; for the distance to the line the root mean square over the
    /// directions of the segment, as 1 - F near its prolongation stays 1.
    fn core_part(&self, ratio: f64) -> f64 {
        let ratio_sq = ratio * ratio;
        match (self.core, self.core_distance) {
            (Core::Singular, _) => 0.0,
            // slow decay: of one sign for all segments, what many cells leave out does not cancel
            (Core::RosenheadMoore | Core::Scully, _) => ONE_SIGN * 1.5 * ratio_sq,
            // in the sheets of a wake with cores wider than their spacing it does not cancel either, and cells are many
            (_, CoreDistance::Line) => SHEETS * 1.5 * ratio_sq,
            (Core::Vatistas2, _) => SHEETS * 0.5 * ratio_sq * ratio_sq,
            (Core::Rankine, _) => f64::from(u8::from(ratio > 1.0)),
            (Core::LambOseen, _) => (-LAMB_OSEEN_ALPHA / ratio_sq).exp(),
        }
    }
}

/// The sum of a tree at points.
pub(super) struct TreeSum<'a> {
    /// Where.
    pub points: &'a [[f64; 3]],
    /// Of what.
    pub cells: &'a Cells,
    /// How exact.
    pub acceptance: Acceptance,
    /// Added to.
    pub velocity: &'a mut [[f64; 3]],
    /// Largest bound, and evaluations of all blocks.
    pub found: &'a mut Found,
}

impl ForModel for TreeSum<'_> {
    /// Blocks are the same for any number of threads, and so is every sum.
    fn run<M: Model, const TO_SEGMENT: bool>(self) {
        let mut order: Vec<usize> = (0..self.points.len()).collect();
        into_blocks(&mut order, self.points, BLOCK);
        let points: Vec<[f64; 3]> = order.iter().map(|i| self.points[*i]).collect();
        let mut velocity = vec![[0.0; 3]; points.len()];
        let mut found = vec![Found::default(); points.len().div_ceil(BLOCK)];
        let (cells, acceptance, instruction_set) = (self.cells, self.acceptance, InstructionSet::in_use());
        let sum = |points: &[[f64; 3]], velocity: &mut [[f64; 3]], found: &mut Found| {
            let lists = Lists::new(points, cells, acceptance);
            *found = lists.found;
            let model = PhantomData::<M>;
            run(BlockSum::<M, TO_SEGMENT> { points, cells, lists: &lists, velocity, model }, instruction_set);
        };
        let blocks = points.chunks(BLOCK).zip(velocity.chunks_mut(BLOCK)).zip(&mut found);
        share(blocks, |((points, velocity), found)| sum(points, velocity, found));
        for (i, added) in order.iter().zip(&velocity) {
            for c in 0..3 {
                self.velocity[*i][c] += added[c];
            }
        }
        for block in &found {
            self.found.bound = self.found.bound.max(block.bound);
            self.found.near += block.near;
            self.found.far += block.far;
        }
    }
}

/// Cells that a block of points sees.
struct Lists<'a> {
    near: Vec<&'a Leaf>,
    far: Vec<usize>,
    found: Found,
}

impl<'a> Lists<'a> {
    /// Largest cells whose estimated error is allowed at every point of the block; the rest segment by segment.
    fn new(points: &[[f64; 3]], cells: &'a Cells, acceptance: Acceptance) -> Self {
        let here = middle(bounds(points.iter().copied()));
        let reach = points.iter().fold(0.0f64, |reach, p| reach.max(distance(here, *p)));
        let mut lists = Self { near: Vec::new(), far: Vec::new(), found: Found::default() };
        let mut i = 0;
        while let Some(cell) = cells.cells.get(i) {
            let least = distance(here, cell.centre) - reach;
            if least > cell.radius {
                let (bound, error) = acceptance.error(cell, least);
                if error <= acceptance.tolerance {
                    lists.far.push(i);
                    lists.found.bound += bound;
                    lists.found.far += points.len() as u64;
                    i = cell.next;
                    continue;
                }
            }
            if let Some(leaf) = &cell.leaf {
                lists.found.near += (points.len() * leaf.pieces.len()) as u64;
                lists.near.push(leaf);
            }
            i += 1;
        }
        lists
    }
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
        let Cells { cells, coefficients, sources } = self.cells;
        for (points, velocity) in self.points.chunks(count).zip(self.velocity.chunks_mut(count)) {
            let points = gathered(on, points);
            let mut sum = [on.splat(0.0); 3];
            for &leaf in &self.lists.near {
                let strands = &sources.strands[leaf.strands.start..leaf.strands.end];
                let pieces = &sources.pieces[leaf.pieces.start..leaf.pieces.end];
                over_sources::<S, R, M, TO_SEGMENT>(on, &points, strands, pieces, &mut sum);
            }
            for &i in &self.lists.far {
                over_harmonics(on, &points, &cells[i].centre, &coefficients[i], &mut sum);
            }
            scattered::<S>(&sum, velocity);
        }
    }
}
