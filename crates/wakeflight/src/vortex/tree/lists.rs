//! Which cells a block of points takes by their expansion, and which segment by segment.

use super::blocks::{BLOCK, Block, Blocks};
use super::cells::{Cell, Cells, Leaf};
use super::harmonics::{DEGREE, remainder};
use super::order::square_of_distance;
use crate::vortex::core::{Core, CoreDistance, LAMB_OSEEN_ALPHA};
use crate::vortex::threads::share;

/// Part of the error allowed of one cell below which what a lower degree leaves out must be: cells of full degree are spread below
/// the limit, many of a lower one would lie at it.
const SHARE_OF_LOWER: f64 = 0.25;
/// Rounding of distances that a cell is kept away from a point, over what they are made of.
const ROUNDED: f64 = 1e-12;
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

/// Bound of what an expansion of `cell` to degree `p` leaves out at `distance` from its centre [m/s].
fn bound(cell: &Cell, p: usize, distance: f64) -> f64 {
    cell.strength / (distance * distance) * remainder(p, cell.radius / distance)
}

/// Least distance above `least` that is `allowed`, to a thousandth, where all beyond it are; infinite where none is.
fn least_allowed(least: f64, allowed: impl Fn(f64) -> bool) -> f64 {
    let (mut below, mut above) = (least, 2.0 * least.max(f64::MIN_POSITIVE));
    while !allowed(above) {
        (below, above) = (above, 2.0 * above);
        if above.is_infinite() {
            return above;
        }
    }
    while above - below > 1e-3 * above {
        let between = 0.5 * (below + above);
        if allowed(between) {
            above = between;
        } else {
            below = between;
        }
    }
    above
}

impl Acceptance {
    /// Distances from the centre of `cell` from which on it may be taken by its expansion to degree 1 to `DEGREE` [m];
    /// infinite where it never may.
    pub fn distances(&self, cell: &Cell) -> [f64; DEGREE] {
        let core = |d: f64| cell.strength / (d * d) * self.core_part(cell.core_radius / (d - cell.radius));
        let mut distances = [0.0; DEGREE];
        distances[DEGREE - 1] =
            least_allowed(cell.radius, |d| bound(cell, DEGREE, d) + core(d) <= self.tolerance);
        for p in (1..DEGREE).rev() {
            let allowed = |d: f64| bound(cell, p, d) <= SHARE_OF_LOWER * self.tolerance;
            let before = distances[p];
            distances[p - 1] = if allowed(before) { before } else { least_allowed(before, allowed) };
        }
        distances
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

/// What a block has to know of a cell to place it.
pub(super) struct Sight {
    centre: [f64; 3],
    /// As of [`Acceptance::distances`], and no less than rounding of a place; minus infinity where it induces nothing.
    from: [f64; DEGREE],
    /// Index after the last cell inside this one.
    next: usize,
}

impl Sight {
    /// Of every cell.
    pub fn of_all(cells: &Cells, acceptance: Acceptance) -> Vec<Self> {
        let of = |cell: &Cell| {
            let least = ROUNDED * square_of_distance(cell.centre, [0.0; 3]).sqrt();
            let from = if cell.strength == 0.0 {
                [f64::NEG_INFINITY; DEGREE]
            } else {
                acceptance.distances(cell).map(|from| from.max(least))
            };
            Self { centre: cell.centre, from, next: cell.next }
        };
        cells.cells.iter().map(of).collect()
    }
}

/// Cells that a block of points sees.
pub(super) struct Lists<'a> {
    /// Those summed segment by segment, and their indices.
    pub near: Vec<(&'a Leaf, usize)>,
    /// Indices of those taken by their expansion, by its degree, from 1 on.
    pub far: [Vec<usize>; DEGREE],
    /// Sum of the squares of what rounding takes of cells of their strengths, over `OF_EXPANSION` [m2/s2].
    pub far_squares: f64,
    /// What that costs and leaves out.
    pub found: Found,
}

impl<'a> Lists<'a> {
    /// Largest cells that are far enough from every point of the block, to the lowest degree that is allowed there; the rest
    /// segment by segment.
    pub fn new(block: &Block<'_>, cells: &'a Cells, sights: &[Sight]) -> Self {
        let Block { points, middle, reach } = *block;
        let mut lists =
            Self { near: Vec::new(), far: Default::default(), far_squares: 0.0, found: Found::default() };
        let mut i = 0;
        while let Some(sight) = sights.get(i) {
            if sight.from[DEGREE - 1] == f64::NEG_INFINITY {
                i = sight.next;
                continue;
            }
            let least = (1.0 + ROUNDED) * (sight.from[DEGREE - 1] + reach);
            let distance_sq = square_of_distance(middle, sight.centre);
            if distance_sq > least * least {
                let away = distance_sq.sqrt();
                let distance = away - reach;
                let lower = sight.from.iter().filter(|from| **from > distance).count().min(DEGREE - 1);
                lists.far[lower].push(i);
                let cell = &cells.cells[i];
                lists.found.bound += bound(cell, lower + 1, distance);
                // places seen from the middle of the block are known to rounding of how far they are
                let most = cell.strength / (distance * distance) * (1.0 + 0.5 * (away + reach) / distance);
                lists.far_squares += most * most;
                lists.found.far += points.len() as u64;
                i = sight.next;
                continue;
            }
            // one that is divided is followed by its parts
            if sight.next == i + 1
                && let Some(leaf) = &cells.cells[i].leaf
            {
                lists.found.near += (points.len() * leaf.pieces.len()) as u64;
                lists.near.push((leaf, i));
            }
            i += 1;
        }
        lists
    }
}

/// Adds to `velocity`, in the order in which points were given, what `sum` adds block by block with the block's lists; the
/// largest bound and the evaluations of all.
///
/// Blocks are the same for any number of threads, and so is every sum.
pub(super) fn over_blocks(
    blocks: &Blocks,
    cells: &Cells,
    acceptance: Acceptance,
    velocity: &mut [[f64; 3]],
    sum: impl Fn(&Block<'_>, &Lists<'_>, &mut [[f64; 3]]) + Sync,
) -> Found {
    let sights = Sight::of_all(cells, acceptance);
    let mut sums = blocks.zeros();
    let mut found: Vec<Found> = blocks.each().map(|_| Found::default()).collect();
    share(blocks.each().zip(sums.chunks_mut(BLOCK)).zip(&mut found), |((block, velocity), found)| {
        let lists = Lists::new(&block, cells, &sights);
        *found = lists.found;
        sum(&block, &lists, velocity);
    });
    blocks.add_to(velocity, &sums);
    found.iter().fold(Found::default(), |all, block| Found {
        bound: all.bound.max(block.bound),
        near: all.near + block.near,
        far: all.far + block.far,
    })
}
