//! Along the span of a discretised blade: quadrature points of the structure and stations of the air.

use super::aerodynamics::StationGeometry;
use super::kinematics::{BladeAxes, SectionMotion, StationShapes};
use super::strain::Stiffness;
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;

/// Mass and stiffness of a quadrature point, times its weight.
#[derive(Clone, Debug)]
pub struct StructuralPoint {
    /// Shapes at the point.
    pub shapes: StationShapes,
    /// Built-in twist [rad].
    pub twist: f64,
    /// Mass [kg].
    pub mass: f64,
    /// First moment ahead of the elastic axis [kg m].
    pub first_moment: f64,
    /// Moments of inertia about the elastic axis, along tangent, chord, normal [kg m2].
    pub inertia: [f64; 3],
    /// Stiffnesses times weight.
    pub stiffness: Stiffness,
}

impl StructuralPoint {
    /// Inertia about the principal axes of a section in motion `m`, times `v`.
    #[inline(always)]
    pub(super) fn inertia_times<S: Real>(
        &self,
        m: &SectionMotion<S>,
        v: Vec3<S, BladeAxes>,
    ) -> Vec3<S, BladeAxes> {
        let [along, chordwise, normal] = self.inertia;
        m.t * (v.dot(m.t) * along) + m.c * (v.dot(m.c) * chordwise) + m.n * (v.dot(m.n) * normal)
    }
}

/// Station of the air loads.
#[derive(Clone, Debug)]
pub struct AeroStation {
    /// Shapes at the station.
    pub shapes: StationShapes,
    /// Built-in twist [rad].
    pub twist: f64,
    /// Chord, widths, chord points.
    pub geometry: StationGeometry,
}
