//! Sections of a blade that remember: the flow of the instant on the memory of the step's start.

use super::aerodynamics::{Air, SectionAir, SectionFlow, StationGeometry, section_loads};
use super::kinematics::{BladeAxes, SectionMotion};
use crate::airfoil::Airfoil;
use crate::airfoil::span::StationAirfoils;
use crate::airfoil::unsteady::{Flow, Memory, Model, Section, Separation};
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;
use std::f64::consts::PI;

/// Separation of every station, found once from its table.
#[derive(Clone, Debug)]
pub struct StationSeparations(Vec<Separation>);

impl StationSeparations {
    /// Of the tables of `n` stations.
    pub fn of(airfoils: &StationAirfoils, n: usize) -> Self {
        Self((0..n).map(|j| Separation::of(airfoils.at(j))).collect())
    }
}

/// Sections of one blade within a coupling step.
#[derive(Clone, Copy, Debug)]
pub struct SectionsInTime<'a> {
    /// Model.
    pub model: Model,
    /// Separation of every station.
    pub separations: &'a StationSeparations,
    /// Memory of every station at the step's start.
    pub memory: &'a [Memory],
    /// Time since then [s].
    pub elapsed: f64,
}

/// A station in motion through the air: wind relative to the point of the elastic axis and angular velocity, blade axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving<'a, S> {
    pub(super) geometry: &'a StationGeometry,
    pub(super) motion: &'a SectionMotion<S>,
    pub(super) wind: Vec3<S, BladeAxes>,
    pub(super) omega: Vec3<S, BladeAxes>,
}

impl<S: Real> Moving<'_, S> {
    /// Wind along the chord and normal to it at the quarter chord.
    fn at_quarter(&self) -> [S; 2] {
        let (c, n) = (self.motion.c, self.motion.n);
        let spin_n = self.omega.cross(c).dot(n);
        [self.wind.dot(c), self.wind.dot(n) - spin_n * self.geometry.quarter]
    }

    /// Flow as a section in time takes it.
    fn flow(&self, speed_of_sound: f64) -> Flow<S> {
        let [wind_c, quarter_n] = self.at_quarter();
        let (c, n) = (self.motion.c, self.motion.n);
        let three_quarter_n = self.wind.dot(n) - self.omega.cross(c).dot(n) * self.geometry.three_quarter;
        Flow {
            alpha: three_quarter_n.atan2(-wind_c),
            alpha_quarter: quarter_n.atan2(-wind_c),
            pitch_rate: self.omega.dot(self.motion.t),
            speed: (wind_c * wind_c + quarter_n * quarter_n + 1e-12).sqrt(),
            speed_of_sound,
        }
    }
}

impl SectionsInTime<'_> {
    fn section<'s>(&'s self, j: usize, airfoil: &'s Airfoil, chord: f64) -> Section<'s> {
        Section { airfoil, separation: &self.separations.0[j], chord }
    }

    /// Air loads of station `j`.
    pub(super) fn air<S: Real>(
        &self,
        j: usize,
        (airfoil, surrounding): (&Airfoil, &Air),
        moving: &Moving<S>,
    ) -> SectionAir<S> {
        let chord = moving.geometry.chord;
        let section = self.section(j, airfoil, chord);
        let flow = moving.flow(surrounding.speed_of_sound);
        let found = self.model.remembering(&section, &self.memory[j], &flow, self.elapsed);
        // loads add the damping of the quasi-steady flow, which is in the moment already
        let damping = flow.pitch_rate * chord / flow.speed * (-PI / 8.0);
        let (speed, mach) = (flow.speed, flow.mach());
        let of_tables = SectionFlow {
            alpha: flow.alpha,
            speed,
            mach,
            cl: found.cl,
            cd: found.cd,
            cm: found.cm - damping,
        };
        let (motion, geometry) = (moving.motion, moving.geometry);
        let mut air =
            section_loads(surrounding, geometry, motion, moving.omega, moving.at_quarter(), &of_tables);
        // neither the inertia of the air nor its waves are circulation
        air.circulation = found.circulatory * speed * (0.5 * chord);
        air
    }

    /// Memory of station `j` at the end of the step.
    pub(super) fn kept(
        &self,
        j: usize,
        (airfoil, surrounding): (&Airfoil, &Air),
        moving: &Moving<f64>,
    ) -> Memory {
        let section = self.section(j, airfoil, moving.geometry.chord);
        let flow = moving.flow(surrounding.speed_of_sound);
        self.model.kept(&section, &self.memory[j], &flow, self.elapsed)
    }
}
