//! Sections of a blade that remember: the flow of the instant on what is known of their states besides.

use super::aerodynamics::{Air, SectionAir, SectionFlow, StationGeometry, section_loads};
use super::held_row::HeldRow;
use super::kinematics::{BladeAxes, SectionMotion};
use crate::airfoil::Airfoil;
use crate::airfoil::span::{StationAirfoils, StationSeparations};
use crate::airfoil::unsteady::{Flow, Memory, Model, Past, Section};
use crate::numerics::frames::Vec3;
use crate::numerics::scalar::Real;
use std::f64::consts::PI;

/// The law by which the sections of a blade answer in time.
#[derive(Clone, Debug)]
pub struct SectionLaw {
    /// Model.
    pub model: Model,
    separations: StationSeparations,
}

impl SectionLaw {
    /// Of `model`, none where sections have no states.
    pub fn of(model: Model, airfoils: &StationAirfoils) -> Option<Self> {
        let remembers = !model.state_names().is_empty();
        remembers.then(|| Self { model, separations: StationSeparations::of(airfoils) })
    }

    /// Section `j`.
    #[inline(always)]
    pub fn section<'s>(&'s self, j: usize, airfoil: &'s Airfoil, chord: f64) -> Section<'s> {
        Section { airfoil, separation: self.separations.at(j), chord }
    }
}

/// What is known of the states of a blade's sections, station by station.
#[derive(Clone, Copy, Debug)]
pub enum BladePast<'a> {
    /// A step that began `elapsed` [s] ago.
    Step {
        /// Its start.
        memory: &'a [Memory],
        /// Time since [s].
        elapsed: f64,
    },
    /// A motion that repeats, with the lags of this memory of it.
    Periodic(&'a [Memory]),
}

impl<'a> BladePast<'a> {
    /// Of station `j`.
    #[inline(always)]
    pub fn at(&self, j: usize) -> Past<'a> {
        match *self {
            Self::Step { memory, elapsed } => Past::Step { memory: &memory[j], elapsed },
            Self::Periodic(memory) => Past::Periodic(&memory[j]),
        }
    }
}

/// Sections of one blade at an instant.
#[derive(Clone, Copy, Debug)]
pub struct SectionsInTime<'a> {
    /// Their law.
    pub law: &'a SectionLaw,
    /// What is known of their states.
    pub past: BladePast<'a>,
}

/// Inflow in which sections can remember.
#[derive(Clone, Copy, Debug)]
pub enum PlainInflow<'a, S> {
    /// Constant and first harmonics over the disk.
    Disk([S; 3]),
    /// The same, and one value per station on top of it.
    DiskAnd([S; 3], &'a [f64]),
    /// One value per station, held.
    Stations(HeldRow<'a>),
    /// One value per station, with derivatives.
    Variable(&'a [S]),
}

/// A station in motion through the air: wind relative to the point of the elastic axis and angular velocity, blade axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving<'a, S> {
    pub(super) geometry: &'a StationGeometry,
    pub(super) motion: &'a SectionMotion<S>,
    pub(super) wind: Vec3<S, BladeAxes>,
    pub(super) omega: Vec3<S, BladeAxes>,
}

/// Flow of a section from the wind along the chord, normal to it at the quarter and the three-quarter chord, and the pitch rates:
/// absolute, and in the blade's axes.
pub(super) fn flow_of<S: Real>(
    winds: [S; 3],
    [pitch_rate, turn_rate]: [S; 2],
    speed_of_sound: f64,
) -> Flow<S> {
    let [wind_c, quarter_n, three_quarter_n] = winds;
    Flow {
        alpha: three_quarter_n.atan2(-wind_c),
        alpha_quarter: quarter_n.atan2(-wind_c),
        pitch_rate,
        turn_rate,
        // the small constant keeps the derivative finite where a section stands still in the air
        speed: (wind_c * wind_c + quarter_n * quarter_n + 1e-12).sqrt(),
        speed_of_sound,
    }
}

impl<S: Real> Moving<'_, S> {
    /// Wind along the chord and normal to it at the quarter and the three-quarter chord.
    fn winds(&self) -> [S; 3] {
        let (c, n) = (self.motion.c, self.motion.n);
        let spin_n = self.omega.cross(c).dot(n);
        let (wind_c, wind_n) = (self.wind.dot(c), self.wind.dot(n));
        [wind_c, wind_n - spin_n * self.geometry.quarter, wind_n - spin_n * self.geometry.three_quarter]
    }

    /// Flow as a section in time takes it.
    pub(super) fn flow(&self, speed_of_sound: f64) -> Flow<S> {
        let t = self.motion.t;
        flow_of(self.winds(), [self.omega.dot(t), self.motion.omega.dot(t)], speed_of_sound)
    }
}

impl SectionsInTime<'_> {
    /// Air loads of station `j`.
    // out of line: what does not remember is compiled as if this were not there
    #[inline(never)]
    pub(super) fn air<S: Real>(
        &self,
        j: usize,
        (airfoil, surrounding): (&Airfoil, &Air),
        moving: &Moving<S>,
    ) -> SectionAir<S> {
        let chord = moving.geometry.chord;
        let section = self.law.section(j, airfoil, chord);
        let flow = moving.flow(surrounding.speed_of_sound);
        let found = self.law.model.remembering(&section, self.past.at(j), &flow);
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
        let [wind_c, quarter_n, _] = moving.winds();
        let mut air =
            section_loads(surrounding, geometry, motion, moving.omega, [wind_c, quarter_n], &of_tables);
        // neither the inertia of the air nor its waves are circulation
        air.circulation = found.circulatory * speed * (0.5 * chord);
        air
    }

    /// Bound circulation [m2/s] of station `j` in `flow`.
    pub(super) fn circulation<S: Real>(
        &self,
        j: usize,
        (airfoil, chord): (&Airfoil, f64),
        flow: &Flow<S>,
    ) -> S {
        let section = self.law.section(j, airfoil, chord);
        let found = self.law.model.remembering(&section, self.past.at(j), flow);
        found.circulatory * flow.speed * (0.5 * chord)
    }
}
