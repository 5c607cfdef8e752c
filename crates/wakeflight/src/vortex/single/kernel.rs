//! The sum over segments in single precision, several points at a time; rules of writing as in the sum in double precision.

use super::lanes::{Lanes, OverLanes, Root};
use super::packed::{SinglePart, SinglePiece, scaled};
use crate::vortex::arithmetic::Arithmetic;
use crate::vortex::sources::Part;
use crate::vortex::strands::Strand;
use pulp::Simd;
use pulp::bytemuck::{cast_slice, cast_slice_mut};

/// Square of a distance, in units of length, that is added to all: where there is no other the point lies on a node. Above that of
/// rounding, so that the cosine to an end that is nearly met stays of order one, and below what changes any other distance.
const LEAST_SQUARE: f32 = 1e-13;
/// Least product under the reciprocal root of a core at the distance to the segment.
const LEAST_PRODUCT: f32 = 1e-36;
/// Segments that are summed plainly before their sum is added with its rounding kept.
const TILE: usize = 32;

/// A sum over segments at some points, for the distance of the core.
pub(super) struct Sum<'a, const TO_SEGMENT: bool> {
    points: &'a [[f64; 3]],
    parts: &'a [Part<'a>],
    velocity: &'a mut [[f64; 3]],
}

/// Position or velocity of several points.
pub(in crate::vortex) type Vectors<S> = [<S as Simd>::f32s; 3];

/// Points seen from one node: separation, its square, twice one over its length, and whether there is any.
struct FromNode<S: Simd> {
    separation: Vectors<S>,
    distance_sq: S::f32s,
    twice_per_distance: S::f32s,
    apart: S::m32s,
}

/// A sum of tiles: what is rounded off when a tile is added is carried on.
pub(in crate::vortex) struct Total<S: Simd> {
    sum: Vectors<S>,
    rest: Vectors<S>,
}

/// Segments summed plainly, and how many they are.
#[derive(Clone, Copy)]
pub(in crate::vortex) struct Tile<S: Simd> {
    /// Their sum.
    pub sum: Vectors<S>,
    n: usize,
}

impl<'a, const TO_SEGMENT: bool> Sum<'a, TO_SEGMENT> {
    /// Adds to `velocity` at `points`, one entry each.
    pub fn new(points: &'a [[f64; 3]], parts: &'a [Part<'a>], velocity: &'a mut [[f64; 3]]) -> Self {
        Self { points, parts, velocity }
    }
}

impl<const TO_SEGMENT: bool> OverLanes for Sum<'_, TO_SEGMENT> {
    /// A point's result does not depend on its neighbours.
    #[inline(always)]
    fn run<S: Simd, R: Root<S>>(self, simd: S, root: R) {
        let (on, count) = (Lanes::new(simd, root), Lanes::<S, R>::COUNT);
        for (points, velocity) in self.points.chunks(count).zip(self.velocity.chunks_mut(count)) {
            let (mut total, mut tile) = (Total::new(on), Tile::new(on));
            for part in self.parts {
                if let Some(single) = part.single {
                    let at = gathered(on, points, single.per_unit);
                    tile = over_sources::<S, R, TO_SEGMENT>(on, &at, part.strands, single, tile, &mut total);
                }
            }
            total.add(on, tile);
            total.scatter(velocity);
        }
    }
}

/// Coordinates across lanes; lanes past the end repeat the last point, so that all lanes do the same.
#[inline(always)]
pub(in crate::vortex) fn gathered<S: Simd, R: Root<S>>(
    on: Lanes<S, R>,
    points: &[[f64; 3]],
    per_unit: f64,
) -> Vectors<S> {
    let mut coordinates = [on.splat(0.0); 3];
    for i in 0..Lanes::<S, R>::COUNT {
        let place = scaled(points[i.min(points.len() - 1)], per_unit);
        for axis in 0..3 {
            let lanes: &mut [f32] = cast_slice_mut(std::slice::from_mut(&mut coordinates[axis]));
            lanes[i] = place[axis];
        }
    }
    coordinates
}

impl<S: Simd> Tile<S> {
    /// Of nothing.
    #[inline(always)]
    pub fn new<R: Root<S>>(on: Lanes<S, R>) -> Self {
        Self { sum: [on.splat(0.0); 3], n: 0 }
    }
}

impl<S: Simd> Total<S> {
    /// Of nothing.
    #[inline(always)]
    pub fn new<R: Root<S>>(on: Lanes<S, R>) -> Self {
        Self { sum: [on.splat(0.0); 3], rest: [on.splat(0.0); 3] }
    }

    /// Adds a tile; an empty one comes back.
    #[inline(always)]
    pub fn add<R: Root<S>>(&mut self, on: Lanes<S, R>, tile: Tile<S>) -> Tile<S> {
        for axis in 0..3 {
            let added = on.add(tile.sum[axis], self.rest[axis]);
            let sum = on.add(self.sum[axis], added);
            self.rest[axis] = on.sub(added, on.sub(sum, self.sum[axis]));
            self.sum[axis] = sum;
        }
        Tile::new(on)
    }

    /// Adds the lanes to `velocity`.
    #[inline(always)]
    pub fn scatter(&self, velocity: &mut [[f64; 3]]) {
        for axis in 0..3 {
            let (sum, rest) = (self.sum[axis], self.rest[axis]);
            let sum: &[f32] = cast_slice(std::slice::from_ref(&sum));
            let rest: &[f32] = cast_slice(std::slice::from_ref(&rest));
            for i in 0..velocity.len() {
                velocity[i][axis] += f64::from(sum[i]) + f64::from(rest[i]);
            }
        }
    }
}

/// Adds what `strands` with the pieces of `single` induce at `points`, through the tile that is begun; the one left unfinished.
#[inline(always)]
pub(in crate::vortex) fn over_sources<S: Simd, R: Root<S>, const TO_SEGMENT: bool>(
    on: Lanes<S, R>,
    points: &Vectors<S>,
    strands: &[Strand],
    single: SinglePart<'_>,
    mut tile: Tile<S>,
    total: &mut Total<S>,
) -> Tile<S> {
    let mut rest = single.pieces;
    for (strand, start) in strands.iter().zip(single.starts) {
        let (pieces, others) = rest.split_at(strand.n_pieces);
        rest = others;
        let mut from_start = from_node(on, points, start);
        for piece in pieces {
            let from_end = from_node(on, points, &piece.end);
            let (weight, height) = if TO_SEGMENT {
                by_segment(on, &from_start, &from_end, piece)
            } else {
                by_line(on, &from_start, &from_end, piece)
            };
            // from a start on the point the vector is zero, from an end rounding
            let weight = on.select(from_end.apart, weight, on.splat(0.0));
            for axis in 0..3 {
                tile.sum[axis] = on.mul_add(weight, height[axis], tile.sum[axis]);
            }
            tile.n += 1;
            if tile.n == TILE {
                tile = total.add(on, tile);
            }
            from_start = from_end;
        }
    }
    tile
}

#[inline(always)]
fn from_node<S: Simd, R: Root<S>>(on: Lanes<S, R>, points: &Vectors<S>, node: &[f32; 3]) -> FromNode<S> {
    let node = splats(on, node);
    let separation = [on.sub(points[0], node[0]), on.sub(points[1], node[1]), on.sub(points[2], node[2])];
    let least = on.splat(LEAST_SQUARE);
    let [x, y, z] = separation;
    let distance_sq = on.mul_add(x, x, on.mul_add(y, y, on.mul_add(z, z, least)));
    FromNode {
        separation,
        distance_sq,
        twice_per_distance: on.twice_reciprocal_sqrt(distance_sq),
        apart: on.greater(distance_sq, least),
    }
}

#[inline(always)]
fn dot<S: Simd, R: Root<S>>(on: Lanes<S, R>, a: &Vectors<S>, b: &Vectors<S>) -> S::f32s {
    on.mul_add(a[0], b[0], on.mul_add(a[1], b[1], on.mul(a[2], b[2])))
}

#[inline(always)]
fn cross<S: Simd, R: Root<S>>(on: Lanes<S, R>, a: &Vectors<S>, b: &Vectors<S>) -> Vectors<S> {
    [
        on.sub_mul(on.mul(a[1], b[2]), a[2], b[1]),
        on.sub_mul(on.mul(a[2], b[0]), a[0], b[2]),
        on.sub_mul(on.mul(a[0], b[1]), a[1], b[0]),
    ]
}

/// The same vector for all points.
#[inline(always)]
pub(in crate::vortex) fn splats<S: Simd, R: Root<S>>(on: Lanes<S, R>, a: &[f32; 3]) -> Vectors<S> {
    [on.splat(a[0]), on.splat(a[1]), on.splat(a[2])]
}

/// Velocity strength (cos1 - cos2) / sqrt(h^4 + core^4) h, as a weight and the vector h; h the distance from the line along its normal of rotation, cos1 and cos2
/// those of the angles at which the ends see the point.
///
/// The difference of the cosines is known to rounding of 1, not of itself: far away that is 1e-7 of the velocity of an
/// infinite line at the same distance h, inside the core less.
#[inline(always)]
fn by_line<S: Simd, R: Root<S>>(
    on: Lanes<S, R>,
    from_start: &FromNode<S>,
    from_end: &FromNode<S>,
    piece: &SinglePiece,
) -> (S::f32s, Vectors<S>) {
    let direction = splats(on, &piece.direction);
    let height = cross(on, &direction, &from_start.separation);
    let height_sq = dot(on, &height, &height);
    let past_start = dot(on, &direction, &from_start.separation);
    let past_end = on.sub(past_start, on.splat(piece.length));
    let cosines =
        on.sub_mul(on.mul(past_start, from_start.twice_per_distance), past_end, from_end.twice_per_distance);
    let inverse = on.twice_reciprocal_sqrt(on.mul_add(height_sq, height_sq, on.splat(piece.core_4)));
    (on.mul(on.mul(on.splat(piece.strength), cosines), inverse), height)
}

/// The same with the core at the distance to the segment, beyond its ends that to the nearer end.
///
/// There nothing limits what rounding leaves of a difference on the prolongation: the form without cancellation of
/// `segment_velocity`, under one reciprocal root.
#[inline(always)]
fn by_segment<S: Simd, R: Root<S>>(
    on: Lanes<S, R>,
    from_start: &FromNode<S>,
    from_end: &FromNode<S>,
    piece: &SinglePiece,
) -> (S::f32s, Vectors<S>) {
    let height = cross(on, &splats(on, &piece.direction), &from_start.separation);
    let height_sq = dot(on, &height, &height);
    let d = dot(on, &from_start.separation, &from_end.separation);
    let half = on.splat(0.5);
    let r1 = on.mul(on.mul(half, from_start.distance_sq), from_start.twice_per_distance);
    let r2 = on.mul(on.mul(half, from_end.distance_sq), from_end.twice_per_distance);
    let width = on.mul_add(r1, r2, on.abs(d));
    let nearest_sq = on.min(from_start.distance_sq, from_end.distance_sq);
    let ahead = on.greater(d, on.splat(0.0));
    let distance_sq = on.select(on.greater(d, nearest_sq), nearest_sq, height_sq);

    let above = on.select(ahead, distance_sq, width);
    let below = on.select(ahead, width, on.splat(1.0));
    let scale = on.select(ahead, on.splat(piece.length), on.splat(piece.per_length));
    let core = on.mul_add(distance_sq, distance_sq, on.splat(piece.core_4));
    let product = on.mul(core, on.mul(below, below));
    let inverse = on.twice_reciprocal_sqrt(on.max(product, on.splat(LEAST_PRODUCT)));
    let per_distances = on.add(from_start.twice_per_distance, from_end.twice_per_distance);
    let shape = on.mul(on.mul(per_distances, above), on.mul(scale, inverse));
    (on.mul(on.splat(piece.strength), shape), height)
}
