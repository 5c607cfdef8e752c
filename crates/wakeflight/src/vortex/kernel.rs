//! The sum over segments, several points at a time.
//!
//! No closure and no iterator adapter touches a vector: such functions do not inherit the instruction set of their
//! caller, and one that is compiled on its own costs ten times the arithmetic.

use super::dispatch::OverLanes;
use super::lanes::{LEAST_SQUARE, Lanes, Roots};
use super::models::{Model, Seen};
use super::sources::Part;
use super::strands::{Piece, Strand};
use crate::vortex::arithmetic::Arithmetic;
use pulp::Simd;
use pulp::bytemuck::{cast_slice, cast_slice_mut};
use std::marker::PhantomData;

/// A sum over segments at some points, for one core model and distance.
pub(super) struct Sum<'a, M, const TO_SEGMENT: bool> {
    points: &'a [[f64; 3]],
    parts: &'a [Part<'a>],
    velocity: &'a mut [[f64; 3]],
    model: PhantomData<M>,
}

/// Position or velocity of several points.
pub(super) type Vectors<S> = [<S as Simd>::f64s; 3];

/// Points seen from one node: separation, its square and its length.
struct FromNode<S: Simd> {
    separation: Vectors<S>,
    distance_sq: S::f64s,
    distance: S::f64s,
}

impl<'a, M: Model, const TO_SEGMENT: bool> Sum<'a, M, TO_SEGMENT> {
    /// Adds to `velocity` at `points`, one entry each.
    pub fn new(points: &'a [[f64; 3]], parts: &'a [Part<'a>], velocity: &'a mut [[f64; 3]]) -> Self {
        Self { points, parts, velocity, model: PhantomData }
    }
}

impl<M: Model, const TO_SEGMENT: bool> OverLanes for Sum<'_, M, TO_SEGMENT> {
    /// A point's result does not depend on its neighbours.
    #[inline(always)]
    fn run<S: Simd, R: Roots<S>>(self, simd: S, roots: R) {
        let (on, count) = (Lanes::new(simd, roots), Lanes::<S, R>::COUNT);
        for (points, velocity) in self.points.chunks(count).zip(self.velocity.chunks_mut(count)) {
            let mut sum = [on.splat(0.0); 3];
            let points = gathered(on, points);
            for part in self.parts {
                over_sources::<S, R, M, TO_SEGMENT>(on, &points, part.strands, part.pieces, &mut sum);
            }
            scattered::<S>(&sum, velocity);
        }
    }
}

/// Coordinates across lanes; lanes past the end repeat the last point, so that all lanes do the same.
#[inline(always)]
pub(super) fn gathered<S: Simd, R: Roots<S>>(on: Lanes<S, R>, points: &[[f64; 3]]) -> Vectors<S> {
    let mut coordinates = [on.splat(0.0); 3];
    for (axis, component) in coordinates.iter_mut().enumerate() {
        let lanes: &mut [f64] = cast_slice_mut(std::slice::from_mut(component));
        for (i, lane) in lanes.iter_mut().enumerate() {
            *lane = points[i.min(points.len() - 1)][axis];
        }
    }
    coordinates
}

/// Adds the lanes of `sum` to `velocity`.
#[inline(always)]
pub(super) fn scattered<S: Simd>(sum: &Vectors<S>, velocity: &mut [[f64; 3]]) {
    for axis in 0..3 {
        let component: &[f64] = cast_slice(std::slice::from_ref(&sum[axis]));
        for i in 0..velocity.len() {
            velocity[i][axis] += component[i];
        }
    }
}

/// Adds what `strands` with their `pieces` induce at `points`.
#[inline(always)]
pub(super) fn over_sources<S: Simd, R: Roots<S>, M: Model, const TO_SEGMENT: bool>(
    on: Lanes<S, R>,
    points: &Vectors<S>,
    strands: &[Strand],
    pieces: &[Piece],
    sum: &mut Vectors<S>,
) {
    let mut rest = pieces;
    for strand in strands {
        let (pieces, others) = rest.split_at(strand.n_pieces);
        rest = others;
        let mut from_start = from_node(on, points, &strand.start);
        for piece in pieces {
            let from_end = from_node(on, points, &piece.end);
            add_piece::<S, R, M, TO_SEGMENT>(on, &from_start, &from_end, piece, sum);
            from_start = from_end;
        }
    }
}

#[inline(always)]
fn from_node<S: Simd, R: Roots<S>>(on: Lanes<S, R>, points: &Vectors<S>, node: &[f64; 3]) -> FromNode<S> {
    let node = splats(on, node);
    let separation = [on.sub(points[0], node[0]), on.sub(points[1], node[1]), on.sub(points[2], node[2])];
    let distance_sq = dot(on, &separation, &separation);
    let distance = on.sqrt(on.max(distance_sq, on.splat(LEAST_SQUARE)));
    FromNode { separation, distance_sq, distance }
}

#[inline(always)]
pub(super) fn dot<S: Simd, R: Roots<S>>(on: Lanes<S, R>, a: &Vectors<S>, b: &Vectors<S>) -> S::f64s {
    on.mul_add(a[0], b[0], on.mul_add(a[1], b[1], on.mul(a[2], b[2])))
}

#[inline(always)]
pub(super) fn cross<S: Simd, R: Roots<S>>(on: Lanes<S, R>, a: &Vectors<S>, b: &Vectors<S>) -> Vectors<S> {
    [
        on.sub_mul(on.mul(a[1], b[2]), a[2], b[1]),
        on.sub_mul(on.mul(a[2], b[0]), a[0], b[2]),
        on.sub_mul(on.mul(a[0], b[1]), a[1], b[0]),
    ]
}

/// The same vector for all points.
#[inline(always)]
pub(super) fn splats<S: Simd, R: Roots<S>>(on: Lanes<S, R>, a: &[f64; 3]) -> Vectors<S> {
    [on.splat(a[0]), on.splat(a[1]), on.splat(a[2])]
}

/// Square root of the softened square of a distance.
#[inline(always)]
fn softened<S: Simd, R: Roots<S>>(on: Lanes<S, R>, square: S::f64s, core_sq: S::f64s) -> S::f64s {
    on.sqrt(on.max(on.add(square, core_sq), on.splat(LEAST_SQUARE)))
}

/// Adds circulation / (4 pi) (r1 + r2) / (r1 r2) s F / |c|^2 c, as in `segment_velocity`, under one reciprocal root.
#[inline(always)]
fn add_piece<S: Simd, R: Roots<S>, M: Model, const TO_SEGMENT: bool>(
    on: Lanes<S, R>,
    from_start: &FromNode<S>,
    from_end: &FromNode<S>,
    piece: &Piece,
    sum: &mut Vectors<S>,
) {
    let cross = cross(on, &splats(on, &piece.along), &from_start.separation);
    let mut cross_sq = dot(on, &cross, &cross);
    let mut d = dot(on, &from_start.separation, &from_end.separation);
    let (mut r1, mut r2) = (from_start.distance, from_end.distance);
    let mut product = on.mul(r1, r2);
    let on_end = on.not_greater(product, on.splat(piece.end_guard));

    let (mut area, mut area_sq) = (on.splat(piece.area), on.splat(piece.area_sq));
    if M::SOFTENED {
        let core_sq = on.splat(piece.core_sq);
        r1 = softened(on, from_start.distance_sq, core_sq);
        r2 = softened(on, from_end.distance_sq, core_sq);
        product = on.mul(r1, r2);
        d = on.add(d, core_sq);
        cross_sq = on.add(cross_sq, area);
    } else if TO_SEGMENT {
        // beyond an end the distance to it replaces h: L^2 = |c|^2 / r^2 instead of length^2
        let nearest_sq = on.min(from_start.distance_sq, from_end.distance_sq);
        let beyond = on.greater(d, nearest_sq);
        let ratio_sq = on.div(cross_sq, on.max(nearest_sq, on.splat(LEAST_SQUARE)));
        area = on.mul(on.splat(piece.core_sq), on.select(beyond, ratio_sq, on.splat(piece.length_sq)));
        area_sq = on.mul(area, area);
    }

    // s = width for d <= 0, |c|^2 / width for d > 0
    let width = on.add(product, on.abs(d));
    let ahead = on.greater(d, on.splat(0.0));
    let above = on.select(ahead, cross_sq, width);
    let below = on.mul(product, on.select(ahead, width, on.splat(1.0)));
    let seen = Seen { cross_sq, area, area_sq };
    let square = on.mul(on.mul(below, below), M::denominator_sq(on, seen));
    let inverse = on.reciprocal_sqrt(on.max(square, on.splat(LEAST_SQUARE)));

    let strength = on.mul(on.mul(on.splat(piece.strength), on.add(r1, r2)), M::factor(on, seen));
    let weight = on.select(on_end, on.splat(0.0), on.mul(on.mul(strength, above), inverse));
    for axis in 0..3 {
        sum[axis] = on.mul_add(weight, cross[axis], sum[axis]);
    }
}
