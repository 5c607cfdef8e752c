//! Velocity of the air relative to the hub axes: every vortex of the rotor at one instant, and the wind.

use super::choices::{CoreDistance, Precision};
use super::error::{WakeError, finite};
use super::far_cylinder::far_cylinder;
use super::filament::Filaments;
use super::ground::Plane;
use super::instant::RotorInstant;
use super::motion::HubMotion;
use super::options::WakeOptions;
use super::sources::{SEEN, WakeSources};
use super::vectors::add_to;
use crate::vortex::core::Core;
use crate::vortex::curvature::curvature_velocity;
use crate::vortex::cylinder::VortexCylinder;
use crate::vortex::induced_velocity::{add_alone, add_groups_velocity};
use crate::vortex::single;
use crate::vortex::sources::{Group, Part};
use crate::vortex::tree::{Method, add_part_velocity_by};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Where induced velocity comes from.
pub trait InducedVelocity: Clone + Send + Sync {
    /// Adds to the velocity of every group what is induced at its points [m/s, `_h`], given the vortices it sees;
    /// the number of segment evaluations.
    fn add(&self, groups: &mut [Group<'_>]) -> u64;

    /// The vortices, where a sum of so many segments at so many points is direct: what other threads can do piece by piece.
    fn in_pieces(&self, _n_points: usize, _n_segments: usize) -> Option<VortexSegments> {
        None
    }

    /// Adds what the far wake's cylinder induces; nothing where the velocity is prescribed.
    fn add_far(&self, _groups: &mut [Group<'_>], _cylinder: &VortexCylinder) {}

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
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct VortexSegments {
    /// Distance in the core factor.
    pub core_distance: CoreDistance,
    /// Whether markers get the velocity of the arc that their two chords lack.
    pub curvature_correction: bool,
    /// How the whole wake is summed.
    pub method: Method,
}

impl VortexSegments {
    /// As the options say.
    pub fn new(options: &WakeOptions) -> Self {
        Self {
            core_distance: options.core_distance,
            curvature_correction: options.curvature_correction,
            method: options.method(),
        }
    }

    /// Adds to the velocity of one group what is induced at its points, directly and by this thread alone.
    pub(super) fn add_alone(&self, group: &mut Group<'_>) {
        add_alone(group, Core::Vatistas2, self.core_distance.into());
    }
}

impl InducedVelocity for VortexSegments {
    fn add(&self, groups: &mut [Group<'_>]) -> u64 {
        let (core, distance) = (Core::Vatistas2, self.core_distance.into());
        let mut evaluations = 0;
        let mut direct = Vec::with_capacity(groups.len());
        for Group { points, sources, velocity } in groups {
            match sources {
                // what sees parts of the wake are stations: too few for a tree of their own
                [whole] if self.method.tree(points.len(), whole.len()).is_some() => {
                    let by = self.method;
                    let account = add_part_velocity_by(by, points, *whole, core, distance, velocity);
                    evaluations += account.segment_evaluations;
                }
                _ => direct.push(Group { points, sources, velocity }),
            }
        }
        if direct.iter().all(Group::is_single) {
            single::add_groups_velocity(&mut direct, distance);
        } else {
            add_groups_velocity(&mut direct, core, distance);
        }
        evaluations + direct.iter().map(Group::evaluations).sum::<u64>()
    }

    fn in_pieces(&self, n_points: usize, n_segments: usize) -> Option<VortexSegments> {
        self.method.tree(n_points, n_segments).is_none().then_some(*self)
    }

    fn add_far(&self, groups: &mut [Group<'_>], cylinder: &VortexCylinder) {
        for group in groups {
            for (point, v) in group.points.iter().zip(group.velocity.iter_mut()) {
                add_to(v, cylinder.velocity(*point));
            }
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
    fn add(&self, groups: &mut [Group<'_>]) -> u64 {
        for group in groups.iter_mut() {
            for (v, p) in group.velocity.iter_mut().zip(group.points) {
                add_to(v, (self.0)(*p));
            }
        }
        groups.iter().map(Group::evaluations).sum()
    }

    fn self_induced(&self, _: [f64; 3], _: [f64; 3], _: [f64; 3], _: f64, _: f64) -> [f64; 3] {
        [0.0; 3]
    }
}

/// Velocity that grows linearly with the place, `at_origin` + `gradient` x [m/s, 1/s; `_h`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
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
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub enum Induction {
    /// Its vortices.
    Vortices(VortexSegments),
    /// A prescribed linear field, whatever the vortices: for problems of convection whose solution is known.
    Linear(LinearField),
}

impl InducedVelocity for Induction {
    fn add(&self, groups: &mut [Group<'_>]) -> u64 {
        match self {
            Self::Vortices(vortices) => vortices.add(groups),
            Self::Linear(field) => Prescribed(|p| field.at(p)).add(groups),
        }
    }

    fn in_pieces(&self, n_points: usize, n_segments: usize) -> Option<VortexSegments> {
        match self {
            Self::Vortices(vortices) => vortices.in_pieces(n_points, n_segments),
            Self::Linear(_) => None,
        }
    }

    fn add_far(&self, groups: &mut [Group<'_>], cylinder: &VortexCylinder) {
        if let Self::Vortices(vortices) = self {
            vortices.add_far(groups, cylinder);
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

/// What a field at one instant is made with: the vortices packed, velocities at the stations. Kept from step to step.
#[derive(Debug, Default)]
pub struct FieldWork {
    pub(super) sources: Arc<WakeSources>,
    station_velocity: Vec<[f64; 3]>,
}

impl Clone for FieldWork {
    /// Empty: nothing in it outlives the field.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl FieldWork {
    /// The vortices of an instant; room that another sum still reads is left to it.
    pub(super) fn pack(&mut self, options: &WakeOptions, instant: &RotorInstant, for_stations: bool) {
        if Arc::get_mut(&mut self.sources).is_none() {
            self.sources = Arc::default();
        }
        if let Some(sources) = Arc::get_mut(&mut self.sources) {
            sources.pack(options, instant, for_stations);
        }
    }
}

/// Where the field of one instant is wanted: at markers, at stations, or at both in one pass.
#[derive(Debug, Default)]
pub struct Wanted<'a> {
    /// Velocity of the markers of the free filaments relative to the hub axes, with the wind of the hub's motion
    /// [m/s, `_h`].
    pub markers: Option<(&'a HubMotion, &'a mut Vec<[f64; 3]>)>,
    /// Induced inflow at the blade stations without that of the own near wake, -v_z/(omega R) (n_blades, n_stations).
    pub stations: Option<&'a mut Vec<f64>>,
}

/// The field of one instant where it is wanted; the number of segment evaluations.
pub fn field_at<F: InducedVelocity>(
    field: &F,
    options: &WakeOptions,
    instant: &RotorInstant,
    work: &mut FieldWork,
    wanted: Wanted<'_>,
) -> u64 {
    work.pack(options, instant, wanted.stations.is_some());
    field_of_packed(field, options, instant, work, wanted)
}

/// The field of the instant whose vortices are packed.
pub(super) fn field_of_packed<F: InducedVelocity>(
    field: &F,
    options: &WakeOptions,
    instant: &RotorInstant,
    work: &mut FieldWork,
    wanted: Wanted<'_>,
) -> u64 {
    let Wanted { mut markers, stations } = wanted;
    let FieldWork { sources, station_velocity } = work;
    let n_seen = if stations.is_some() { options.rotor.n_blades } else { 0 };
    let seen: Vec<[Part<'_>; SEEN]> = (0..n_seen).map(|blade| sources.seen_from(blade)).collect();
    station_velocity.clear();
    station_velocity.resize(n_seen * options.n_stations, [0.0; 3]);

    let whole = [sources.whole()];
    let mut groups = Vec::with_capacity(n_seen + 1);
    if let Some((hub, velocity)) = &mut markers {
        let points = &instant.free.position;
        velocity.clear();
        velocity.extend(points.iter().map(|p| hub.wind(*p)));
        groups.push(Group { points, sources: &whole, velocity });
    }
    let at_blades = instant.station.chunks_exact(options.n_stations);
    for ((points, velocity), parts) in
        at_blades.zip(station_velocity.chunks_exact_mut(options.n_stations)).zip(&seen)
    {
        groups.push(Group { points, sources: parts, velocity });
    }
    let mut evaluations = field.add(&mut groups);
    let cylinder = far_cylinder(options, &instant.free);
    if let Some(cylinder) = &cylinder {
        field.add_far(&mut groups, cylinder);
    }
    if let Some(plane) = &instant.ground {
        evaluations += add_images(field, plane, &whole, cylinder.as_ref(), &mut groups);
    }

    if let Some((_, velocity)) = markers {
        for (m, velocity) in velocity.iter_mut().enumerate() {
            add_self_induced(field, &instant.free, m, velocity);
        }
    }
    if let Some(inflow) = stations {
        inflow.clear();
        inflow.extend(station_velocity.iter().map(|v| -v[2] / options.tip_speed()));
    }
    evaluations
}

/// Adds what the images in the ground of all vortices induce: the flow at the images of the points, mirrored. Blades see the image of
/// all of themselves.
fn add_images<F: InducedVelocity>(
    field: &F,
    plane: &Plane,
    whole: &[Part<'_>],
    cylinder: Option<&VortexCylinder>,
    groups: &mut [Group<'_>],
) -> u64 {
    let points: Vec<[f64; 3]> =
        groups.iter().flat_map(|group| group.points.iter().map(|p| plane.image(*p))).collect();
    let mut velocity = vec![[0.0; 3]; points.len()];
    let mut images = [Group { points: &points, sources: whole, velocity: &mut velocity }];
    let evaluations = field.add(&mut images);
    if let Some(cylinder) = cylinder {
        field.add_far(&mut images, cylinder);
    }
    let felt = groups.iter_mut().flat_map(|group| group.velocity.iter_mut());
    for (v, image) in felt.zip(&velocity) {
        add_to(v, plane.reflected(*image));
    }
    evaluations
}

/// Adds what marker `m` owes to the curvature of its own filament.
pub(super) fn add_self_induced<F: InducedVelocity>(
    field: &F,
    free: &Filaments,
    m: usize,
    velocity: &mut [f64; 3],
) {
    let (i, k) = (m / (free.n_segments + 1), m % (free.n_segments + 1));
    if k == 0 || k == free.n_segments {
        return;
    }
    let segment = i * free.n_segments + k;
    let core = (0.5 * (free.core_squared[segment - 1] + free.core_squared[segment])).sqrt();
    let [before, here, after] = [m - 1, m, m + 1].map(|m| free.position[m]);
    add_to(velocity, field.self_induced(before, here, after, free.circulation[m], core));
}

/// Velocity induced by rotor and wake at `points` [m/s, `_h`], in double precision; bound vortices included, near-wake
/// trailers not.
pub fn point_velocity<F: InducedVelocity>(
    field: &F,
    options: &WakeOptions,
    instant: &RotorInstant,
    points: &[[f64; 3]],
) -> Vec<[f64; 3]> {
    let mut velocity = vec![[0.0; 3]; points.len()];
    let mut sources = WakeSources::default();
    sources.pack(&WakeOptions { precision: Precision::Double, ..*options }, instant, false);
    let whole = [sources.whole()];
    let mut groups = [Group { points, sources: &whole, velocity: &mut velocity }];
    field.add(&mut groups);
    let cylinder = far_cylinder(options, &instant.free);
    if let Some(cylinder) = &cylinder {
        field.add_far(&mut groups, cylinder);
    }
    if let Some(plane) = &instant.ground {
        add_images(field, plane, &whole, cylinder.as_ref(), &mut groups);
    }
    velocity
}
