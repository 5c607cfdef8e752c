//! Velocity induced by many straight segments at many points.

use super::core::{Core, CoreDistance};
use super::kernel::Sum;
use super::models::{LambOseen, Model, Rankine, RosenheadMoore, Scully, Singular, Vatistas2};
use super::strands::Strands;
use super::threads::pool;
use pulp::{Arch, Scalar, Simd};
use rayon::prelude::*;

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
    /// Appends a filament; shape of `circulation` and `core_radius`: one less than of `nodes`.
    pub fn push(&mut self, nodes: &[[f64; 3]], circulation: &[f64], core_radius: &[f64]) {
        debug_assert!(nodes.len() == circulation.len() + 1 && nodes.len() == core_radius.len() + 1);
        self.nodes.extend_from_slice(nodes);
        self.n_nodes.push(nodes.len());
        self.circulation.extend_from_slice(circulation);
        self.core_radius.extend_from_slice(core_radius);
    }
}

/// Lanes the sums run in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// One point at a time.
    Scalar,
    /// The widest vectors of this machine that need no more than AVX2, NEON or SIMD128.
    Vector,
    /// Eight points at a time with reciprocal roots by estimate and refinement.
    Avx512,
}

impl InstructionSet {
    /// The widest of this machine.
    #[must_use]
    pub fn widest() -> Self {
        if avx512::available() { Self::Avx512 } else { Self::Vector }
    }
}

/// Points of one parallel task; a multiple of every number of lanes.
const CHUNK: usize = 64;
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
    add(points, &segments.strands(core), core, core_distance, InstructionSet::widest(), velocity);
}

/// As [`add_segments_velocity`], for filaments.
pub fn add_filaments_velocity(
    points: &[[f64; 3]],
    filaments: &Filaments,
    core: Core,
    core_distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) {
    add_filaments_velocity_on(InstructionSet::widest(), points, filaments, core, core_distance, velocity);
}

/// As [`add_filaments_velocity`] on given lanes, to compare and to time them; AVX-512 falls back where it is missing.
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
    fn strands(&self, core: Core) -> Strands {
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
    fn strands(&self, core: Core) -> Strands {
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

fn add(
    points: &[[f64; 3]],
    strands: &Strands,
    core: Core,
    core_distance: CoreDistance,
    instruction_set: InstructionSet,
    velocity: &mut [[f64; 3]],
) {
    match core {
        Core::Singular => modelled::<Singular>(points, strands, core_distance, instruction_set, velocity),
        Core::Scully => modelled::<Scully>(points, strands, core_distance, instruction_set, velocity),
        Core::Vatistas2 => modelled::<Vatistas2>(points, strands, core_distance, instruction_set, velocity),
        Core::Rankine => modelled::<Rankine>(points, strands, core_distance, instruction_set, velocity),
        Core::LambOseen => modelled::<LambOseen>(points, strands, core_distance, instruction_set, velocity),
        Core::RosenheadMoore => {
            modelled::<RosenheadMoore>(points, strands, core_distance, instruction_set, velocity)
        }
    }
}

fn modelled<M: Model>(
    points: &[[f64; 3]],
    strands: &Strands,
    core_distance: CoreDistance,
    instruction_set: InstructionSet,
    velocity: &mut [[f64; 3]],
) {
    match core_distance {
        CoreDistance::Line => shared::<M, false>(points, strands, instruction_set, velocity),
        CoreDistance::Segment => shared::<M, true>(points, strands, instruction_set, velocity),
    }
}

/// Shares the points among threads; every point sees all sources in order, whichever thread it is on.
fn shared<M: Model, const TO_SEGMENT: bool>(
    points: &[[f64; 3]],
    strands: &Strands,
    instruction_set: InstructionSet,
    velocity: &mut [[f64; 3]],
) {
    debug_assert_eq!(points.len(), velocity.len());
    let worth_sharing = points.len() > CHUNK && points.len() * strands.pieces.len() > LEAST_SHARED_WORK;
    match pool().filter(|_| worth_sharing) {
        Some(pool) => pool.install(|| {
            points.par_chunks(CHUNK).zip(velocity.par_chunks_mut(CHUNK)).for_each(|(points, velocity)| {
                run(Sum::<M, TO_SEGMENT>::new(points, strands, velocity), instruction_set);
            });
        }),
        None => run(Sum::<M, TO_SEGMENT>::new(points, strands, velocity), instruction_set),
    }
}

fn run<M: Model, const TO_SEGMENT: bool>(sum: Sum<M, TO_SEGMENT>, instruction_set: InstructionSet) {
    match instruction_set {
        InstructionSet::Scalar => Scalar.vectorize(sum),
        InstructionSet::Vector => avx512::without(sum),
        InstructionSet::Avx512 => avx512::with(sum),
    }
}

#[cfg(target_arch = "x86_64")]
mod avx512 {
    use super::{Arch, Model, Scalar, Simd, Sum};
    use crate::vortex::roots::Refined;
    use pulp::WithSimd;
    use pulp::x86::{V3, V4};

    pub fn available() -> bool {
        V4::is_available()
    }

    pub fn without<M: Model, const TO_SEGMENT: bool>(sum: Sum<M, TO_SEGMENT>) {
        match V3::try_new() {
            Some(simd) => Simd::vectorize(simd, sum),
            None => Scalar.vectorize(sum),
        }
    }

    /// The sum with the token of its instruction set, which `WithSimd` would only hand over as some `Simd`.
    struct Wide<'a, M, const TO_SEGMENT: bool>(V4, Sum<'a, M, TO_SEGMENT>);

    impl<M: Model, const TO_SEGMENT: bool> WithSimd for Wide<'_, M, TO_SEGMENT> {
        type Output = ();
        #[inline(always)]
        fn with_simd<S: Simd>(self, _: S) {
            self.1.run(self.0, Refined);
        }
    }

    pub fn with<M: Model, const TO_SEGMENT: bool>(sum: Sum<M, TO_SEGMENT>) {
        match V4::try_new() {
            Some(simd) => Simd::vectorize(simd, Wide(simd, sum)),
            None => Arch::new().dispatch(sum),
        }
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod avx512 {
    use super::{Arch, Model, Sum};

    pub fn available() -> bool {
        false
    }

    pub fn without<M: Model, const TO_SEGMENT: bool>(sum: Sum<M, TO_SEGMENT>) {
        Arch::new().dispatch(sum);
    }

    pub fn with<M: Model, const TO_SEGMENT: bool>(sum: Sum<M, TO_SEGMENT>) {
        without(sum);
    }
}
