//! The sum over segments, several points at a time.

use super::models::{Model, Seen};
use super::roots::Roots;
use super::strands::{Piece, Strands};
use pulp::{Simd, WithSimd};
use pulp::bytemuck::{cast_slice, cast_slice_mut};
use std::marker::PhantomData;

/// Keeps the reciprocal root finite where everything vanishes; reached below lengths of 1e-18 m only.
const LEAST_DENOMINATOR: f64 = 1e-300;

/// A sum over segments at some points, for one core model and distance.
pub(super) struct Sum<'a, M, const TO_SEGMENT: bool> {
    points: &'a [[f64; 3]],
    strands: &'a Strands,
    velocity: &'a mut [[f64; 3]],
    model: PhantomData<M>,
}

/// Position or velocity of several points.
type Vectors<S> = [<S as Simd>::f64s; 3];

/// Points seen from one node: separation, its square and its (softened) length.
struct FromNode<S: Simd> {
    separation: Vectors<S>,
    distance_sq: S::f64s,
    distance: S::f64s,
}

impl<'a, M: Model, const TO_SEGMENT: bool> Sum<'a, M, TO_SEGMENT> {
    /// Adds to `velocity` at `points`, one entry each.
    pub fn new(points: &'a [[f64; 3]], strands: &'a Strands, velocity: &'a mut [[f64; 3]]) -> Self {
        Self { points, strands, velocity, model: PhantomData }
    }

    /// Runs on lanes of `S`, with roots by `roots`.
    #[inline(always)]
    pub fn run<S: Simd, R: Roots<S>>(self, simd: S, roots: R) {
        let lanes = S::F64_LANES;
        for (points, velocity) in self.points.chunks(lanes).zip(self.velocity.chunks_mut(lanes)) {
            let sum = over_sources::<S, R, M, TO_SEGMENT>(simd, roots, gathered(simd, points), self.strands);
            let components: &[f64] = cast_slice(&sum);
            for (i, v) in velocity.iter_mut().enumerate() {
                for (axis, component) in v.iter_mut().enumerate() {
                    *component += components[axis * lanes + i];
                }
            }
        }
    }
}

impl<M: Model, const TO_SEGMENT: bool> WithSimd for Sum<'_, M, TO_SEGMENT> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        self.run(simd, super::roots::Exact);
    }
}

/// Coordinates across lanes; lanes past the end repeat the last point, so that they cost nothing special.
#[inline(always)]
fn gathered<S: Simd>(simd: S, points: &[[f64; 3]]) -> Vectors<S> {
    let mut coordinates = [simd.splat_f64s(0.0); 3];
    for (axis, lanes) in coordinates.iter_mut().enumerate() {
        let lanes: &mut [f64] = cast_slice_mut(std::slice::from_mut(lanes));
        for (i, lane) in lanes.iter_mut().enumerate() {
            *lane = points[i.min(points.len() - 1)][axis];
        }
    }
    coordinates
}

#[inline(always)]
fn over_sources<S: Simd, R: Roots<S>, M: Model, const TO_SEGMENT: bool>(
    simd: S,
    roots: R,
    points: Vectors<S>,
    strands: &Strands,
) -> Vectors<S> {
    let mut sum = [simd.splat_f64s(0.0); 3];
    let mut rest = strands.pieces.as_slice();
    for strand in &strands.strands {
        let (pieces, others) = rest.split_at(strand.n_pieces);
        rest = others;
        let mut from_start = from_node(simd, roots, &points, &strand.start);
        for piece in pieces {
            let from_end = from_node(simd, roots, &points, &piece.end);
            add_piece::<S, R, M, TO_SEGMENT>(simd, roots, &from_start, &from_end, piece, &mut sum);
            from_start = from_end;
        }
    }
    sum
}

#[inline(always)]
fn from_node<S: Simd, R: Roots<S>>(simd: S, roots: R, points: &Vectors<S>, node: &[f64; 3]) -> FromNode<S> {
    let [x, y, z] = [0, 1, 2].map(|axis| simd.sub_f64s(points[axis], simd.splat_f64s(node[axis])));
    let distance_sq = dot(simd, &[x, y, z], &[x, y, z]);
    let distance = roots.sqrt(simd, simd.max_f64s(distance_sq, simd.splat_f64s(LEAST_DENOMINATOR)));
    FromNode { separation: [x, y, z], distance_sq, distance }
}

#[inline(always)]
fn dot<S: Simd>(simd: S, a: &Vectors<S>, b: &Vectors<S>) -> S::f64s {
    simd.mul_add_e_f64s(a[0], b[0], simd.mul_add_e_f64s(a[1], b[1], simd.mul_f64s(a[2], b[2])))
}

/// a1 b2 - a2 b1.
#[inline(always)]
fn minor<S: Simd>(simd: S, a1: S::f64s, b1: S::f64s, a2: S::f64s, b2: S::f64s) -> S::f64s {
    simd.negate_mul_add_e_f64s(a2, b1, simd.mul_f64s(a1, b2))
}

/// Adds circulation / (4 pi) (r1 + r2) / (r1 r2) s F / |c|^2 c, as in `segment_velocity`, under one reciprocal root.
#[inline(always)]
fn add_piece<S: Simd, R: Roots<S>, M: Model, const TO_SEGMENT: bool>(
    simd: S,
    roots: R,
    from_start: &FromNode<S>,
    from_end: &FromNode<S>,
    piece: &Piece,
    sum: &mut Vectors<S>,
) {
    let splat = |x: f64| simd.splat_f64s(x);
    let along = piece.along.map(splat);
    let r = &from_start.separation;
    let cross = [
        minor(simd, along[1], r[1], along[2], r[2]),
        minor(simd, along[2], r[2], along[0], r[0]),
        minor(simd, along[0], r[0], along[1], r[1]),
    ];
    let mut cross_sq = dot(simd, &cross, &cross);
    let mut d = dot(simd, &from_start.separation, &from_end.separation);
    let bare_product = simd.mul_f64s(from_start.distance, from_end.distance);

    let (area, area_sq) = if TO_SEGMENT && !M::SOFTENED {
        // beyond an end the distance to it replaces h: L^2 = |c|^2 / r^2 instead of length^2
        let nearest_sq = simd.min_f64s(from_start.distance_sq, from_end.distance_sq);
        let beyond = simd.greater_than_f64s(d, nearest_sq);
        let ratio_sq = simd.div_f64s(cross_sq, simd.max_f64s(nearest_sq, splat(LEAST_DENOMINATOR)));
        let spread_sq = simd.select_f64s(beyond, ratio_sq, splat(piece.length_sq));
        let area = simd.mul_f64s(splat(piece.core_sq), spread_sq);
        (area, simd.mul_f64s(area, area))
    } else {
        (splat(piece.area), splat(piece.area_sq))
    };
    let (mut r1, mut r2, mut product) = (from_start.distance, from_end.distance, bare_product);
    if M::SOFTENED {
        let core_sq = splat(piece.core_sq);
        let soft = |square| roots.sqrt(simd, simd.max_f64s(simd.add_f64s(square, core_sq), splat(LEAST_DENOMINATOR)));
        (r1, r2) = (soft(from_start.distance_sq), soft(from_end.distance_sq));
        product = simd.mul_f64s(r1, r2);
        d = simd.add_f64s(d, core_sq);
        cross_sq = simd.add_f64s(cross_sq, area);
    }

    // s = width for d <= 0, |c|^2 / width for d > 0
    let width = simd.add_f64s(product, simd.abs_f64s(d));
    let ahead = simd.greater_than_f64s(d, splat(0.0));
    let above = simd.select_f64s(ahead, cross_sq, width);
    let below = simd.mul_f64s(product, simd.select_f64s(ahead, width, splat(1.0)));
    let core = M::denominator_sq(simd, Seen { cross_sq, area, area_sq });
    let square = simd.mul_f64s(simd.mul_f64s(below, below), core);
    let inverse = roots.reciprocal_sqrt(simd, simd.max_f64s(square, splat(LEAST_DENOMINATOR)));

    let strength = simd.mul_f64s(splat(piece.strength), simd.add_f64s(r1, r2));
    let weight = simd.mul_f64s(simd.mul_f64s(strength, above), inverse);
    let on_end = simd.less_than_or_equal_f64s(bare_product, splat(piece.end_guard));
    let weight = simd.select_f64s(on_end, splat(0.0), weight);
    for (total, c) in sum.iter_mut().zip(cross) {
        *total = simd.mul_add_e_f64s(weight, c, *total);
    }
}
