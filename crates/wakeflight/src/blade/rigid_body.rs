//! The mass of a blade that does not bend, about its hinge.

use super::kinematics::{BladeAxes, SectionMotion};
use super::stations::{AeroStation, StructuralPoint};
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;

/// Mass of the blade about its hinge in the triad of its root, and where its stations lie in it.
#[derive(Clone, Debug)]
pub struct RigidBlade {
    /// Mass [kg].
    pub(super) mass: f64,
    /// First moment along t, c, n [kg m].
    first_moment: [f64; 3],
    /// Inertia about the hinge along t, c, n [kg m2].
    pub(super) inertia: [[f64; 3]; 3],
    /// Distance from the hinge [m], sine and cosine of the built-in twist of every station.
    pub(super) stations: Vec<[f64; 3]>,
}

impl RigidBlade {
    /// The sum of `points` about the hinge at `root_station` [m].
    pub(super) fn of(points: &[StructuralPoint], stations: &[AeroStation], root_station: f64) -> Self {
        let (mut mass, mut first_moment, mut inertia) = (0.0, [0.0; 3], [[0.0; 3]; 3]);
        for p in points {
            let length = p.shapes.x - root_station;
            let (s, c) = p.twist.sin_cos();
            // the point's own axes in those of the root
            let axes = [[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]];
            mass += p.mass;
            first_moment[0] += p.mass * length;
            for i in 0..3 {
                first_moment[i] += p.first_moment * axes[1][i];
                for j in 0..3 {
                    for (axis, moment) in axes.iter().zip(p.inertia) {
                        inertia[i][j] += moment * axis[i] * axis[j];
                    }
                    // about the hinge: m l^2 across the span, and the products of span and offset of the centre of gravity
                    inertia[i][j] -=
                        p.first_moment * length * (axes[0][i] * axes[1][j] + axes[1][i] * axes[0][j]);
                }
            }
            inertia[1][1] += p.mass * length * length;
            inertia[2][2] += p.mass * length * length;
        }
        let stations = stations
            .iter()
            .map(|station| {
                let (sine, cosine) = station.twist.sin_cos();
                [station.shapes.x - root_station, sine, cosine]
            })
            .collect();
        Self { mass, first_moment, inertia, stations }
    }

    /// First moment in blade axes.
    #[inline(always)]
    pub(super) fn first<S: Real>(&self, m: &SectionMotion<S>) -> Vec3<S, BladeAxes> {
        let [along, chordwise, normal] = self.first_moment;
        m.t.scaled(along) + m.c.scaled(chordwise) + m.n.scaled(normal)
    }

    /// Inertia about the hinge times `v`, blade axes.
    #[inline(always)]
    pub(super) fn inertia_times<S: Real>(
        &self,
        m: &SectionMotion<S>,
        v: Vec3<S, BladeAxes>,
    ) -> Vec3<S, BladeAxes> {
        let (a, b, c) = (v.dot(m.t), v.dot(m.c), v.dot(m.n));
        let j = &self.inertia;
        m.t * (a * j[0][0] + b * j[0][1] + c * j[0][2])
            + m.c * (a * j[1][0] + b * j[1][1] + c * j[1][2])
            + m.n * (a * j[2][0] + b * j[2][1] + c * j[2][2])
    }
}
