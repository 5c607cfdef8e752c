//! Velocity induced by many straight segments at many points.

use super::core::{Core, CoreDistance};
use super::dispatch::{OverLanes, run};
use super::kernel::Sum;
use super::lanes::Roots;
use super::models::{ForModel, Model, for_core};
use super::single;
use super::sources::{Group, Part};
use super::strands::Strands;
use super::threads::share;
use crate::numerics::instruction_set::InstructionSet;
use pulp::Simd;
use std::marker::PhantomData;

/// Straight segments from `start` to `end`, one entry each.
#[derive(Clone, Debug, Default)]
pub struct Segments {
    /// Start points [m].
    pub start: Vec<[f64; 3]>,
    /// End points [m]; vorticity points from start to end.
    pub end: Vec<[f64; 3]>,
    /// Circulation [m2/s].
    pub circulation: Vec<f64>,
    /// Core radius [m].
    pub core_radius: Vec<f64>,
}

/// Filaments of joined straight segments; faster than `Segments`, since each node is visited once.
#[derive(Clone, Debug, Default)]
pub struct Filaments {
    /// Nodes of all filaments, one filament after the other [m].
    pub nodes: Vec<[f64; 3]>,
    /// Number of nodes of each filament.
    pub n_nodes: Vec<usize>,
    /// Circulation of each segment, positive along the order of the nodes, filament after filament [m2/s].
    pub circulation: Vec<f64>,
    /// Core radius of each segment, of peak swirl [m].
    pub core_radius: Vec<f64>,
}

impl Filaments {
    /// Whether nodes and segments are as many as the filaments need.
    #[must_use]
    pub fn belong_together(&self) -> bool {
        let n_segments: usize = self.n_nodes.iter().map(|n| n.saturating_sub(1)).sum();
        self.n_nodes.iter().sum::<usize>() == self.nodes.len()
            && self.circulation.len() == n_segments
            && self.core_radius.len() == n_segments
    }

    /// Appends a filament; shape of `circulation` and `core_radius`: one less than of `nodes`.
    pub fn push(&mut self, nodes: &[[f64; 3]], circulation: &[f64], core_radius: &[f64]) {
        debug_assert!(nodes.len() == circulation.len() + 1 && nodes.len() == core_radius.len() + 1);
        self.nodes.extend_from_slice(nodes);
        self.n_nodes.push(nodes.len());
        self.circulation.extend_from_slice(circulation);
        self.core_radius.extend_from_slice(core_radius);
    }
}

/// Points of one piece of work; a multiple of every number of lanes. Small: at the end threads wait for one piece at most.
pub(super) const CHUNK: usize = 16;
/// Evaluations below which one thread is faster than sharing the work.
const LEAST_SHARED_WORK: usize = 30_000;

/// Adds to `velocity` the velocity induced at `points` [m/s]; sources in their order for every point, parallel over points.
///
/// The core factor is taken at the distance to the line. Same bits for any number of threads.
pub fn add_induced_velocity(points: &[[f64; 3]], segments: &Segments, core: Core, velocity: &mut [[f64; 3]]) {
    add_segments_velocity(points, segments, core, CoreDistance::Line, velocity);
}

/// As [`add_induced_velocity`], with the distance that the core factor is taken at.
pub fn add_segments_velocity(
    points: &[[f64; 3]],
    segments: &Segments,
    core: Core,
    core_distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) {
    add(points, &segments.strands(core), core, core_distance, InstructionSet::in_use(), velocity);
}

/// As [`add_segments_velocity`], for filaments.
pub fn add_filaments_velocity(
    points: &[[f64; 3]],
    filaments: &Filaments,
    core: Core,
    core_distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) {
    add_filaments_velocity_on(InstructionSet::in_use(), points, filaments, core, core_distance, velocity);
}

/// As [`add_filaments_velocity`] on given lanes, to compare and to time them; a set that is missing falls back to a narrower one.
pub fn add_filaments_velocity_on(
    instruction_set: InstructionSet,
    points: &[[f64; 3]],
    filaments: &Filaments,
    core: Core,
    core_distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) {
    add(points, &filaments.strands(core), core, core_distance, instruction_set, velocity);
}

impl Segments {
    pub(super) fn strands(&self, core: Core) -> Strands {
        let mut strands = Strands::with_capacity(self.start.len());
        let ends = self.start.iter().zip(&self.end);
        for ((start, end), (circulation, core_radius)) in
            ends.zip(self.circulation.iter().zip(&self.core_radius))
        {
            strands.push(*start, *end, *circulation, *core_radius, core == Core::Singular);
        }
        strands
    }
}

impl Filaments {
    pub(super) fn strands(&self, core: Core) -> Strands {
        let mut strands = Strands::with_capacity(self.circulation.len());
        let (mut nodes, mut values) = (self.nodes.as_slice(), self.circulation.iter().zip(&self.core_radius));
        for &n_nodes in &self.n_nodes {
            let (filament, others) = nodes.split_at(n_nodes.min(nodes.len()));
            nodes = others;
            for (ends, (circulation, core_radius)) in filament.windows(2).zip(&mut values) {
                strands.push(ends[0], ends[1], *circulation, *core_radius, core == Core::Singular);
            }
        }
        strands
    }
}

/// Adds the sum over all `strands`.
pub(super) fn add(
    points: &[[f64; 3]],
    strands: &Strands,
    core: Core,
    core_distance: CoreDistance,
    instruction_set: InstructionSet,
    velocity: &mut [[f64; 3]],
) {
    let sources = [Part::of(strands)];
    let mut groups = [Group { points, sources: &sources, velocity }];
    for_core(core, core_distance, Direct { groups: &mut groups, instruction_set });
}

/// Adds to every group's velocity what its sources induce at its points, directly; all groups in one pass over the threads.
///
/// Same bits for any number of threads, and for any points beside a point.
pub fn add_groups_velocity(groups: &mut [Group<'_>], core: Core, core_distance: CoreDistance) {
    for_core(core, core_distance, Direct { groups, instruction_set: InstructionSet::in_use() });
}

/// As [`add_groups_velocity`], for one group and by the calling thread alone; in single precision, with the core of Vatistas n = 2,
/// where its sources are packed for that.
pub(crate) fn add_alone(group: &mut Group<'_>, core: Core, core_distance: CoreDistance) {
    let is_single = group.is_single();
    let Group { points, sources, velocity } = group;
    // a piece of work is not shared
    for (points, velocity) in points.chunks(CHUNK).zip(velocity.chunks_mut(CHUNK)) {
        let mut piece = [Group { points, sources, velocity }];
        if is_single {
            single::add_groups_velocity(&mut piece, core_distance);
        } else {
            add_groups_velocity(&mut piece, core, core_distance);
        }
    }
}

/// Adds what each of the `parts` induces at the points by itself to its rows of `velocity` (n_parts, n_points); by the calling
/// thread alone.
pub fn add_each_velocity(
    points: &[[f64; 3]],
    parts: &[Part<'_>],
    core: Core,
    core_distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) {
    debug_assert_eq!(velocity.len(), parts.len() * points.len());
    for_core(core, core_distance, Each { points, parts, velocity });
}

/// The sums of some parts, each by itself: one call into wide code for all of them.
struct Each<'a> {
    points: &'a [[f64; 3]],
    parts: &'a [Part<'a>],
    velocity: &'a mut [[f64; 3]],
}

impl ForModel for Each<'_> {
    fn run<M: Model, const TO_SEGMENT: bool>(self) {
        run(EachSum::<M, TO_SEGMENT> { each: self, model: PhantomData }, InstructionSet::in_use());
    }
}

struct EachSum<'a, M, const TO_SEGMENT: bool> {
    each: Each<'a>,
    model: PhantomData<M>,
}

impl<M: Model, const TO_SEGMENT: bool> OverLanes for EachSum<'_, M, TO_SEGMENT> {
    #[inline(always)]
    fn run<S: Simd, R: Roots<S>>(self, simd: S, roots: R) {
        let Each { points, parts, velocity } = self.each;
        for (part, velocity) in parts.iter().zip(velocity.chunks_exact_mut(points.len().max(1))) {
            Sum::<M, TO_SEGMENT>::new(points, std::slice::from_ref(part), velocity).run(simd, roots);
        }
    }
}

/// The sum of every segment at every point.
struct Direct<'a, 'b> {
    groups: &'a mut [Group<'b>],
    instruction_set: InstructionSet,
}

impl ForModel for Direct<'_, '_> {
    /// Shares the points among threads; every point sees all its sources in order, whichever thread it is on.
    fn run<M: Model, const TO_SEGMENT: bool>(self) {
        let Self { groups, instruction_set } = self;
        over_groups(groups, |points: &[[f64; 3]], parts: &[Part<'_>], velocity: &mut [[f64; 3]]| {
            run(Sum::<M, TO_SEGMENT>::new(points, parts, velocity), instruction_set);
        });
    }
}

/// Sums for some points at a time, (points, what they see, velocity): shared among threads where that is worth it.
pub(super) fn over_groups(
    groups: &mut [Group<'_>],
    sum: impl Fn(&[[f64; 3]], &[Part<'_>], &mut [[f64; 3]]) + Sync,
) {
    let (n_points, evaluations) =
        groups.iter().fold((0, 0), |(n, all), g| (n + g.points.len(), all + g.evaluations()));
    let pieces = groups.iter_mut().flat_map(|group| {
        let Group { points, sources, velocity } = group;
        debug_assert_eq!(points.len(), velocity.len());
        let sources: &[Part<'_>] = sources;
        points.chunks(CHUNK).zip(velocity.chunks_mut(CHUNK)).map(move |(p, v)| (p, sources, v))
    });
    if n_points > CHUNK && evaluations > LEAST_SHARED_WORK as u64 {
        share(pieces, |(points, parts, velocity)| sum(points, parts, velocity));
    } else {
        pieces.for_each(|(points, parts, velocity)| sum(points, parts, velocity));
    }
}
