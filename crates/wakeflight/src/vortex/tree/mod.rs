//! Sums over many segments at many points, at a cost near N log N: far cells by their multipoles, near ones exactly.
//!
//! Segments are divided into cells (cells.rs); what a cell induces far away follows from the multipoles of its vector potential
//! (harmonics.rs) up to degree 4, or a lower one where it is far enough. Points are gathered into blocks of neighbours
//! (blocks.rs). A block takes a cell by its expansion where the estimated error of that cell is below a fraction of the largest
//! velocity found, and goes into the cell otherwise (lists.rs); what is not far is summed segment by segment with its core, as the
//! direct sum does: in single precision (in_single.rs) where rounding is a small part of the tolerance, else in double (sum.rs).
//! Same bits for any number of threads. Unlike in the direct sum a point's result depends, within the tolerance, on
//! which other points it is asked with.

mod blocks;
mod cells;
mod far_field;
mod harmonics;
mod in_single;
mod lists;
mod order;
mod rounding;
mod sum;
#[cfg(test)]
mod tests;

use super::core::{Core, CoreDistance};
use super::induced_velocity::{Filaments, Segments, add_groups_velocity};
use super::models::for_core;
use super::sources::{Group, Part};
use blocks::Blocks;
use cells::Cells;
use in_single::SingleCells;
use lists::{Acceptance, Found};
use serde::{Deserialize, Serialize};
use sum::TreeSum;

/// How a sum over segments is taken.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Every segment at every point, exact to rounding.
    Direct,
    /// By the tree.
    Tree {
        /// Error allowed over the largest induced velocity at the points.
        tolerance: f64,
        /// What sums are taken in.
        #[serde(default)]
        numbers: Numbers,
    },
    /// By the tree where it was measured to be faster, see [`tree_is_faster`]; else direct.
    Auto {
        /// As of the tree.
        tolerance: f64,
        /// What sums are taken in.
        #[serde(default)]
        numbers: Numbers,
    },
}

/// Precision of the numbers that sums are taken in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Numbers {
    /// Double.
    Double,
    /// The direct sum in double, the tree in single where rounding is a small part of its tolerance.
    #[default]
    Tolerance,
    /// Single, the tree where rounding is a small part of its tolerance.
    Single,
}

impl Method {
    /// Tolerance of the tree where it is to be taken for so many points and segments.
    #[must_use]
    pub fn tree(self, n_points: usize, n_segments: usize) -> Option<f64> {
        match self {
            Self::Tree { tolerance, .. } => Some(tolerance),
            Self::Auto { tolerance, numbers } => {
                tree_is_faster(n_points, n_segments, numbers).then_some(tolerance)
            }
            Self::Direct => None,
        }
        .filter(|_| n_points > 0 && n_segments > 0)
    }

    /// Whether the tree may sum in single precision.
    fn tree_in_single(self) -> bool {
        match self {
            Self::Tree { numbers, .. } | Self::Auto { numbers, .. } => numbers != Numbers::Double,
            Self::Direct => false,
        }
    }
}

/// Error of the tree over the largest induced velocity, where nothing else is asked for.
pub const DEFAULT_TOLERANCE: f64 = 1e-3;

/// What a sum cost, and what is known of its error.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Account {
    /// Evaluations of a segment at a point.
    pub segment_evaluations: u64,
    /// Evaluations of the expansion of a cell at a point; none of the direct sum.
    pub cell_evaluations: u64,
    /// Bound of what the expansions leave out of the velocity, over all points [m/s]; 0 of the direct sum.
    ///
    /// It assumes that all errors have one sign and is hundreds of times what is measured. Not in it: that far cells are
    /// taken without cores.
    pub truncation_bound: f64,
}

/// Points and segments from whose product on the tree is faster, where there are as many of each.
fn crossover(numbers: Numbers) -> f64 {
    match numbers {
        Numbers::Double => 4096.0,
        Numbers::Tolerance => 2048.0,
        Numbers::Single => 8192.0,
    }
}
/// Points from which on a tree can be worth it, whatever the number of segments, and the reverse.
const LEAST: usize = 512;
/// Points at which the direct sum tells how large velocities are.
const SAMPLES: usize = 64;
/// Estimated error of one cell over the error allowed of all: the estimate is a bound of one sign, what is left of many
/// cells cancels, less so along vortex sheets.
const SHARE: f64 = 0.5;

/// Whether the tree is faster at its default tolerance: measured on one core for wakes of helical filaments and for full-span
/// lattices (two segments for each point).
#[must_use]
pub fn tree_is_faster(n_points: usize, n_segments: usize, numbers: Numbers) -> bool {
    let both = (n_points as f64) * (n_segments as f64);
    n_points.min(n_segments) >= LEAST && both >= crossover(numbers).powi(2)
}

/// Adds to `velocity` the velocity that `filaments` induce at `points` [m/s], by the method of choice.
///
/// The error of the tree is below `tolerance` times the largest induced velocity at the points: not a theorem, but what
/// holds in every test, up to a million segments in the lattice of a wake; [`Account::truncation_bound`] is a theorem.
pub fn add_filaments_velocity_by(
    method: Method,
    points: &[[f64; 3]],
    filaments: &Filaments,
    core: Core,
    core_distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) -> Account {
    add_part_velocity_by(method, points, Part::of(&filaments.strands(core)), core, core_distance, velocity)
}

/// As [`add_filaments_velocity_by`], for separate segments.
pub fn add_segments_velocity_by(
    method: Method,
    points: &[[f64; 3]],
    segments: &Segments,
    core: Core,
    core_distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) -> Account {
    add_part_velocity_by(method, points, Part::of(&segments.strands(core)), core, core_distance, velocity)
}

/// As [`add_filaments_velocity_by`], for segments that are packed.
pub fn add_part_velocity_by(
    method: Method,
    points: &[[f64; 3]],
    part: Part<'_>,
    core: Core,
    core_distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) -> Account {
    let direct = |velocity: &mut [[f64; 3]], points: &[[f64; 3]]| {
        let sources = [part];
        let mut group = [Group { points, sources: &sources, velocity }];
        add_groups_velocity(&mut group, core, core_distance);
        group[0].evaluations()
    };
    let Some(tolerance) = method.tree(points.len(), part.len()) else {
        return Account { segment_evaluations: direct(velocity, points), ..Account::default() };
    };

    let sample: Vec<[f64; 3]> = points.iter().step_by(points.len().div_ceil(SAMPLES)).copied().collect();
    let mut sampled = vec![[0.0; 3]; sample.len()];
    let for_sample = direct(&mut sampled, &sample);
    let largest = sampled.iter().fold(0.0f64, |m, v| m.max(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])).sqrt();

    let cells = Cells::new(part);
    let blocks = Blocks::new(points);
    let acceptance = Acceptance { core, core_distance, tolerance: SHARE * tolerance * largest };
    let single = (method.tree_in_single() && SingleCells::knows(core))
        .then(|| SingleCells::new(&cells, &blocks))
        .flatten();
    let found = match single {
        Some(single) => single.add(&blocks, acceptance, velocity),
        None => {
            let mut found = Found::default();
            let sum = TreeSum { blocks: &blocks, cells: &cells, acceptance, velocity, found: &mut found };
            for_core(core, core_distance, sum);
            found
        }
    };
    Account {
        segment_evaluations: for_sample + found.near,
        cell_evaluations: found.far,
        truncation_bound: found.bound,
    }
}
