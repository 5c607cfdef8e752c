//! Velocity of the air relative to the hub axes: every vortex of the rotor at one instant, and the wind.

use super::error::{WakeError, finite};
use super::filament::Filaments;
use super::geometry::{BladeGrid, blade_point};
use super::lattice::{Viewer, bound, push_filament, push_shed};
use super::options::{BladeState, CoreDistance, HubMotion, Trailers, WakeOptions};
use crate::vortex::core::Core;
use crate::vortex::curvature::curvature_velocity;
use crate::vortex::induced_velocity::{Segments, add_segments_velocity};
use crate::vortex::threads::share;

/// Where induced velocity comes from.
pub trait InducedVelocity: Clone + Send + Sync {
    /// Adds to `velocity` the induced velocity at `points` [m/s, `_h`], given every vortex segment.
    fn add(&self, points: &[[f64; 3]], segments: &Segments, velocity: &mut [[f64; 3]]);

    /// Velocity that a marker owes to the curvature of its own filament [m/s], given its neighbours.
    fn self_induced(
        &self,
        prev: [f64; 3],
        here: [f64; 3],
        next: [f64; 3],
        circulation: f64,
        core_radius: f64,
    ) -> [f64; 3];
}

/// Induction of the straight vortex segments, core of Vatistas n = 2.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VortexSegments {
    /// Distance in the core factor.
    pub core_distance: CoreDistance,
    /// Whether markers get the velocity of the arc that their two chords lack.
    pub curvature_correction: bool,
}

impl VortexSegments {
    /// As the options say.
    pub fn new(options: &WakeOptions) -> Self {
        Self { core_distance: options.core_distance, curvature_correction: options.curvature_correction }
    }
}

impl InducedVelocity for VortexSegments {
    fn add(&self, points: &[[f64; 3]], segments: &Segments, velocity: &mut [[f64; 3]]) {
        segment_velocity(points, segments, Core::Vatistas2, self.core_distance, velocity);
    }

    fn self_induced(
        &self,
        prev: [f64; 3],
        here: [f64; 3],
        next: [f64; 3],
        circulation: f64,
        core_radius: f64,
    ) -> [f64; 3] {
        if self.curvature_correction {
            curvature_velocity(prev, here, next, circulation, core_radius)
        } else {
            [0.0; 3]
        }
    }
}

/// Induced velocity prescribed as a function of the point [m -> m/s, `_h`], whatever the vortices.
#[derive(Clone, Copy, Debug)]
pub struct Prescribed<F>(pub F);

impl<F: Fn([f64; 3]) -> [f64; 3] + Clone + Send + Sync> InducedVelocity for Prescribed<F> {
    fn add(&self, points: &[[f64; 3]], _segments: &Segments, velocity: &mut [[f64; 3]]) {
        for (v, p) in velocity.iter_mut().zip(points) {
            add_to(v, (self.0)(*p));
        }
    }

    fn self_induced(&self, _: [f64; 3], _: [f64; 3], _: [f64; 3], _: f64, _: f64) -> [f64; 3] {
        [0.0; 3]
    }
}

/// Velocity that grows linearly with the place, `at_origin` + `gradient` x [m/s, 1/s; `_h`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearField {
    at_origin: [f64; 3],
    gradient: [[f64; 3]; 3],
}

impl LinearField {
    /// From its value at the hub [m/s] and its gradient, row i the derivatives of component i [1/s].
    pub fn new(at_origin: [f64; 3], gradient: [[f64; 3]; 3]) -> Result<Self, WakeError> {
        finite("at_origin", &at_origin)?;
        finite("gradient", gradient.as_flattened())?;
        Ok(Self { at_origin, gradient })
    }

    /// Velocity at `point` [m -> m/s, `_h`].
    pub fn at(&self, point: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| {
            self.at_origin[i] + (0..3).map(|j| self.gradient[i][j] * point[j]).sum::<f64>()
        })
    }
}

/// Where a wake takes the induced velocity from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Induction {
    /// Its vortices.
    Vortices(VortexSegments),
    /// A prescribed linear field, whatever the vortices: for problems of convection whose solution is known.
    Linear(LinearField),
}

impl InducedVelocity for Induction {
    fn add(&self, points: &[[f64; 3]], segments: &Segments, velocity: &mut [[f64; 3]]) {
        match self {
            Self::Vortices(vortices) => vortices.add(points, segments, velocity),
            Self::Linear(field) => Prescribed(|p| field.at(p)).add(points, segments, velocity),
        }
    }

    fn self_induced(
        &self,
        prev: [f64; 3],
        here: [f64; 3],
        next: [f64; 3],
        circulation: f64,
        core_radius: f64,
    ) -> [f64; 3] {
        match self {
            Self::Vortices(vortices) => vortices.self_induced(prev, here, next, circulation, core_radius),
            Self::Linear(_) => [0.0; 3],
        }
    }
}

/// The one door to the segment law.
pub(crate) fn segment_velocity(
    points: &[[f64; 3]],
    segments: &Segments,
    core: Core,
    core_distance: CoreDistance,
    velocity: &mut [[f64; 3]],
) {
    add_segments_velocity(points, segments, core, core_distance.into(), velocity);
}

/// The rotor and its wake at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RotorInstant {
    /// Free filaments, blade after blade, each from root to tip: the tip vortices, or all trailers.
    pub free: Filaments,
    /// Filaments of the inboard sheet, blade after blade; none without a sheet.
    pub sheet: Filaments,
    /// Edges of the bound elements (n_blades, n_stations + 1) [m, `_h`].
    pub edge: Vec<[f64; 3]>,
    /// Stations (n_blades, n_stations) [m, `_h`].
    pub station: Vec<[f64; 3]>,
    /// Bound circulation (n_blades, n_stations) [m2/s].
    pub circulation: Vec<f64>,
    /// Edges that the trailers of a blade leave from.
    trailer_edges: Vec<usize>,
}

impl RotorInstant {
    /// Blades and empty filaments.
    pub fn new(options: &WakeOptions, grid: &BladeGrid) -> Self {
        RotorInstant {
            free: Filaments::new(options, options.n_blades * options.trailers_per_blade()),
            sheet: Filaments::new(options, options.n_blades * options.sheet_filaments()),
            edge: vec![[0.0; 3]; options.n_blades * (options.n_stations + 1)],
            station: vec![[0.0; 3]; options.n_blades * options.n_stations],
            circulation: vec![0.0; options.n_blades * options.n_stations],
            trailer_edges: grid.trailer_edges.clone(),
        }
    }

    /// Places blade `i_blade` with its bound circulation (n_stations) [m2/s].
    pub fn place_blade(
        &mut self,
        options: &WakeOptions,
        grid: &BladeGrid,
        i_blade: usize,
        blade: &BladeState,
        circulation: &[f64],
    ) {
        let n = options.n_stations;
        for (j, r) in grid.edges.iter().enumerate() {
            self.edge[i_blade * (n + 1) + j] = blade_point(options, blade, *r);
        }
        for (j, r) in grid.stations.iter().enumerate() {
            self.station[i_blade * n + j] = blade_point(options, blade, *r);
        }
        self.circulation[i_blade * n..(i_blade + 1) * n].copy_from_slice(circulation);
    }

    /// Every segment in its fixed order. Seen from the stations of `own_blade`: without its bound vortex, its filaments
    /// beyond the near wake only, and no core smaller than the floor.
    pub fn segments(&self, options: &WakeOptions, own_blade: Option<usize>) -> Segments {
        let mut segments = Segments::default();
        let floor = match own_blade {
            Some(_) => options.station_core_floor * options.chord,
            None => 0.0,
        };
        let (n_free, n_sheet) = (options.trailers_per_blade(), options.sheet_filaments());
        let own = |blade: usize| own_blade == Some(blade);
        let viewer =
            |blade: usize| Viewer { first: if own(blade) { options.near_wake_markers() } else { 0 }, floor };
        for i in 0..self.free.n_filaments {
            push_filament(&mut segments, options, &self.free, i, viewer(i / n_free));
        }
        for blade in 0..options.n_blades {
            push_shed(&mut segments, options, &self.free, blade, own(blade), viewer(blade));
        }
        for i in 0..self.sheet.n_filaments {
            push_filament(&mut segments, options, &self.sheet, i, viewer(i / n_sheet));
        }
        let n = options.n_stations;
        let bound_core = (options.bound_core * options.chord).max(floor);
        for blade in (0..options.n_blades).filter(|b| !own(*b)) {
            let strength: Vec<f64> = match options.trailers {
                Trailers::Tip => self.circulation[blade * n..(blade + 1) * n].to_vec(),
                Trailers::FullSpan => bound(options, &self.trailer_edges, &self.free, blade).collect(),
            };
            for (j, gamma) in strength.into_iter().enumerate() {
                let edge = blade * (n + 1) + j;
                push(&mut segments, self.edge[edge], self.edge[edge + 1], gamma, bound_core);
            }
        }
        segments
    }
}

/// Appends one segment.
pub(crate) fn push(
    segments: &mut Segments,
    start: [f64; 3],
    end: [f64; 3],
    circulation: f64,
    core_radius: f64,
) {
    segments.start.push(start);
    segments.end.push(end);
    segments.circulation.push(circulation);
    segments.core_radius.push(core_radius);
}

/// Velocity of the markers of the free filaments relative to the hub axes, with the wind [m/s, `_h`]; also the number of
/// segment evaluations.
pub fn marker_velocity<F: InducedVelocity>(
    field: &F,
    options: &WakeOptions,
    instant: &RotorInstant,
    hub: &HubMotion,
    velocity: &mut Vec<[f64; 3]>,
) -> u64 {
    let free = &instant.free;
    velocity.clear();
    velocity.extend(free.position.iter().map(|p| hub.wind(*p)));
    let segments = instant.segments(options, None);
    field.add(&free.position, &segments, velocity);
    for i in 0..free.n_filaments {
        for k in 1..free.n_segments {
            let m = free.marker(i, k);
            let core = (0.5
                * (free.core_squared[i * free.n_segments + k - 1]
                    + free.core_squared[i * free.n_segments + k]))
                .sqrt();
            let local = field.self_induced(
                free.position[m - 1],
                free.position[m],
                free.position[m + 1],
                free.circulation[m],
                core,
            );
            add_to(&mut velocity[m], local);
        }
    }
    (free.position.len() * segments.start.len()) as u64
}

/// Induced inflow at the blade stations without that of the own near wake, -v_z/(omega R) (n_blades, n_stations); also
/// the number of segment evaluations.
pub fn station_inflow<F: InducedVelocity>(
    field: &F,
    options: &WakeOptions,
    instant: &RotorInstant,
) -> (Vec<f64>, u64) {
    let n = options.n_stations;
    let mut inflow = vec![0.0; options.n_blades * n];
    let mut evaluations = vec![0; options.n_blades];
    let blades = inflow.chunks_mut(n).zip(&mut evaluations).enumerate();
    share(blades, |(blade, (inflow, evaluations))| {
        let segments = instant.segments(options, Some(blade));
        let mut velocity = vec![[0.0; 3]; n];
        field.add(&instant.station[blade * n..(blade + 1) * n], &segments, &mut velocity);
        for (lambda, v) in inflow.iter_mut().zip(&velocity) {
            *lambda = -v[2] / options.tip_speed();
        }
        *evaluations = (n * segments.start.len()) as u64;
    });
    let evaluations = evaluations.iter().sum();
    (inflow, evaluations)
}

/// Velocity induced by rotor and wake at `points` [m/s, `_h`]; bound vortices included, near-wake trailers not.
pub fn point_velocity<F: InducedVelocity>(
    field: &F,
    options: &WakeOptions,
    instant: &RotorInstant,
    points: &[[f64; 3]],
) -> Vec<[f64; 3]> {
    let mut velocity = vec![[0.0; 3]; points.len()];
    field.add(points, &instant.segments(options, None), &mut velocity);
    velocity
}

/// Sum of two vectors.
pub(crate) fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Adds `b` to `a`.
pub(crate) fn add_to(a: &mut [f64; 3], b: [f64; 3]) {
    for c in 0..3 {
        a[c] += b[c];
    }
}
