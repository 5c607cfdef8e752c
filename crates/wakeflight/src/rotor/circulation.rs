//! Bound circulation and near wake solved together, at every exchange between wake and flight dynamics.
//!
//! Held: the far inflow, the motion of blade and hub. Solved: Gamma_i = Gamma_section_i(lambda_far_i + sum_j N_ij Gamma_j).

use super::hub::Rotor;
use crate::blade::aerodynamics::Air;
use crate::blade::hub_motion::HubMotion;
use crate::blade::kinematics::{ModalMotion, PitchMotion};
use crate::blade::memory_rows::MemoryRows;
use crate::blade::section_wind::SectionWind;
use crate::blade::sections_in_time::BladePast;
use crate::blade::thin_section::SectionLift;
use crate::numerics::scalar::Dual;
use crate::wake::{
    BladeState, CirculationSolution, HubMotion as WakeHub, Route, WakeError, WakeOptions, near_wake_matrix,
    solve_circulation, weissinger_matrix,
};

/// Circulation of several blade instants, each solved with its near wake.
#[derive(Clone, Debug, Default)]
pub struct Circulations {
    /// Bound circulation (n_instants, n_stations) [m2/s].
    pub gamma: Vec<f64>,
    /// Total induced inflow that belongs to it (n_instants, n_stations); thin sections: each row followed by the inflow at
    /// three quarters of the chord (n_instants, 2 n_stations).
    pub inflow: Vec<f64>,
    /// Largest residual [m2/s].
    pub residual: f64,
    /// Instants whose solution Newton did not find from the start given.
    pub followed: usize,
}

/// Inflow that a blade's own near wake (and bound line) adds per unit of circulation, row-major (n_stations, n_stations)
/// [s/m2].
#[derive(Clone, Debug)]
struct NearWake {
    /// On the bound line.
    bound_line: Vec<f64>,
    /// At three quarters of the chord, where thin sections meet the air.
    three_quarter: Option<Vec<f64>>,
}

/// A blade at one instant.
#[derive(Clone, Copy, Debug)]
pub struct BladeInstant {
    /// Azimuth [rad].
    pub psi: f64,
    /// Modal motion; accelerations are not used.
    pub modal: ModalMotion<f64>,
    /// Pitch from the swashplate.
    pub control: PitchMotion<f64>,
}

/// A blade at one instant with all that its circulation takes from its motion, whatever the far inflow.
#[derive(Clone, Debug)]
pub struct PlacedBlade {
    winds: Vec<SectionWind>,
    near: NearWake,
}

/// A blade at one instant, with what is known of the states of its sections where they remember.
#[derive(Clone, Copy, Debug)]
pub struct BladeInTime<'a> {
    /// Its motion.
    pub instant: &'a BladeInstant,
    /// What is known.
    pub past: Option<BladePast<'a>>,
}

impl<'a> From<&'a BladeInstant> for BladeInTime<'a> {
    /// Of sections that do not remember.
    fn from(instant: &'a BladeInstant) -> Self {
        Self { instant, past: None }
    }
}

/// How a rotor moves through the air over a revolution.
#[derive(Clone, Copy, Debug)]
pub struct Course {
    /// Motion of the hub as its blades feel it.
    pub blades: HubMotion<f64>,
    /// The same as their near wakes take it: the air that passes over the azimuth they span.
    pub near: WakeHub,
    /// Time that a step of azimuth takes over that at the nominal speed.
    pub pace: f64,
}

impl Course {
    /// At the nominal speed.
    pub fn steady(hub: &HubMotion<f64>) -> Self {
        let near = WakeHub { velocity: hub.velocity.array(), rates: hub.omega.array() };
        Self { blades: *hub, near, pace: 1.0 }
    }
}

/// Largest difference between the circulation of a section and that of its element, over omega R^2.
const CIRCULATION_TOLERANCE: f64 = 1e-8;

/// Least 1 - M^2 of the chord in compressible flow: beyond M = 0.9 it is held.
const LEAST_SHARE_OF_CHORD: f64 = 1.0 - 0.9 * 0.9;

impl Rotor {
    /// Circulation [m2/s] at every station for inflow `lambda`, and its derivative by the inflow there.
    pub fn section_circulation(
        &self,
        air: Air,
        hub: &HubMotion<f64>,
        blade: BladeInTime,
        lambda: &[f64],
        circulation: &mut [f64],
        slope: &mut [f64],
    ) {
        let winds = self.section_winds(hub, blade.instant);
        self.circulation_of(air, (&winds, blade.past), lambda, circulation, slope);
    }

    fn section_winds(&self, hub: &HubMotion<f64>, blade: &BladeInstant) -> Vec<SectionWind> {
        let mut winds = Vec::with_capacity(self.blade.stations.len());
        self.blade.section_winds(self.omega, hub, blade.psi, &blade.modal, &blade.control, &mut winds);
        winds
    }

    fn circulation_of(
        &self,
        air: Air,
        (winds, past): (&[SectionWind], Option<BladePast>),
        lambda: &[f64],
        circulation: &mut [f64],
        slope: &mut [f64],
    ) {
        let sections = self.sections_in_time(past);
        for (j, wind) in winds.iter().enumerate() {
            // a station's circulation depends on its own inflow alone
            let (airfoil, lambda) = (self.airfoils.at(j), Dual::<1>::variable(lambda[j], 0));
            let gamma = match (self.thin, &sections) {
                (Some(law), _) => wind.thin_circulation(law, airfoil, &air, lambda),
                (None, None) => wind.circulation(airfoil, &air, lambda),
                (None, Some(sections)) => wind.circulation_in_time((j, airfoil), &air, sections, lambda),
            };
            (circulation[j], slope[j]) = (gamma.re, gamma.eps[0]);
        }
    }

    /// Refuses the options of another rotor's wake; the reference chord is not the blade's to know.
    fn check_wake(&self, options: &WakeOptions) -> Result<(), WakeError> {
        let (wake, first) = (&options.rotor, &self.blade.stations[0]);
        let root_cutout = first.shapes.x - 0.5 * first.geometry.width;
        let numbers = [
            ("n_blades", wake.n_blades as f64, self.n_blades as f64),
            ("radius", wake.radius, self.blade.radius),
            ("root_cutout", wake.root_cutout, root_cutout),
            ("hinge_offset", wake.hinge_offset, self.hinge()),
            ("omega", wake.omega, self.omega),
            ("n_stations", options.n_stations as f64, self.blade.stations.len() as f64),
        ];
        match numbers.into_iter().find(|(_, given, own)| (given - own).abs() > 1e-9 * own.abs().max(1.0)) {
            None => Ok(()),
            Some((field, given, own)) => Err(WakeError::InvalidOption {
                field,
                value: given.to_string(),
                allowed: format!("must be {own}, that of the rotor"),
            }),
        }
    }

    /// Chords [m] that set the distance of the control points from the bound line.
    ///
    /// The tables hold the compressible flow of a section, so that its own bound line is felt as in compressible flow too: Goethert,
    /// lengths along the stream over sqrt(1 - M^2), M of the speed across the span that turning and flight give the station.
    /// Tangency keeps the chord.
    fn chords(&self, speed_of_sound: f64, hub: &WakeHub, psi: f64) -> Vec<f64> {
        let compressible = self.thin.is_some_and(|law| law.lift == SectionLift::Tables);
        let (sine, cosine) = psi.sin_cos();
        let [forward, side, _] = hub.velocity;
        let flight = side * cosine - forward * sine;
        let stations = self.blade.stations.iter();
        stations
            .map(|station| {
                let mach = (self.omega * station.shapes.x + flight) / speed_of_sound;
                let share = (1.0 - mach * mach).max(LEAST_SHARE_OF_CHORD);
                station.geometry.chord / if compressible { share.sqrt() } else { 1.0 }
            })
            .collect()
    }

    /// A blade at one instant, of a hub that moves as `blades` feel it and as their `near` wakes take it; `state`: its azimuth
    /// and angles.
    pub fn placed(
        &self,
        air: Air,
        options: &WakeOptions,
        (blades, near): (&HubMotion<f64>, &WakeHub),
        instant: &BladeInstant,
        state: &BladeState,
    ) -> Result<PlacedBlade, WakeError> {
        let near = self.near_wake(air, options, near, state)?;
        Ok(PlacedBlade { winds: self.section_winds(blades, instant), near })
    }

    /// Induction of a blade's own near wake, at the azimuth and the angles of `state`.
    fn near_wake(
        &self,
        air: Air,
        options: &WakeOptions,
        hub: &WakeHub,
        state: &BladeState,
    ) -> Result<NearWake, WakeError> {
        self.check_wake(options)?;
        let bound_line = near_wake_matrix(options, hub, state)?;
        let three_quarter = match self.thin {
            Some(_) => {
                let chords = self.chords(air.speed_of_sound, hub, state.psi);
                Some(weissinger_matrix(options, hub, state, &chords)?)
            }
            None => None,
        };
        Ok(NearWake { bound_line, three_quarter })
    }

    /// Inflow values that a blade holds: one per station, two with thin sections.
    pub fn inflow_width(&self) -> usize {
        self.blade.stations.len() * if self.thin.is_some() { 2 } else { 1 }
    }

    /// `solution` of blade or instant `i`, at azimuth `psi` [rad], where it is one; otherwise the error that says where not.
    pub(super) fn solved(
        &self,
        solution: CirculationSolution,
        i: usize,
        psi: f64,
    ) -> Result<CirculationSolution, WakeError> {
        if solution.converged() {
            return Ok(solution);
        }
        let (radius, station) = (self.blade.radius, solution.worst_station);
        Err(WakeError::Circulation {
            blade: i,
            azimuth: psi.to_degrees().rem_euclid(360.0),
            station,
            radius: self.blade.stations[station].shapes.x / radius,
            residual: solution.residual,
            tolerance: CIRCULATION_TOLERANCE * self.omega * radius * radius,
            circulation: solution.gamma[station],
            inflow: solution.inflow[station],
        })
    }

    /// Circulation of one blade and the inflow it holds ([`inflow_width`](Self::inflow_width)) for the held far inflow
    /// (n_stations), its near wake and what its sections remember.
    pub fn blade_circulation(
        &self,
        air: Air,
        (blade, past): (&PlacedBlade, Option<BladePast>),
        lambda_far: &[f64],
        start: &[f64],
    ) -> Result<CirculationSolution, WakeError> {
        let radius = self.blade.radius;
        // slopes are kept between -3 c and 0 (per tip speed): beyond stall the sign would turn Newton away
        let steepest = if self.thin.is_some() { -8.0 } else { -3.0 };
        let floor: Vec<f64> =
            self.blade.stations.iter().map(|s| steepest * s.geometry.chord * self.tip_speed()).collect();
        let tolerance = CIRCULATION_TOLERANCE * self.omega * radius * radius;
        let section = |lambda: &[f64], circulation: &mut [f64], slope: &mut [f64]| {
            self.circulation_of(air, (&blade.winds, past), lambda, circulation, slope);
        };
        let near_wake = &blade.near;
        let matrix = near_wake.three_quarter.as_ref().unwrap_or(&near_wake.bound_line);
        let mut solution = solve_circulation(lambda_far, matrix, section, start, &floor, tolerance)?;
        if near_wake.three_quarter.is_some() {
            // lift is perpendicular to the air at the bound line, where the own bound vortex induces nothing
            let rows = near_wake.bound_line.chunks_exact(lambda_far.len()).zip(lambda_far);
            let mut held: Vec<f64> = rows
                .map(|(row, far)| far + row.iter().zip(&solution.gamma).map(|(n, g)| n * g).sum::<f64>())
                .collect();
            held.append(&mut solution.inflow);
            solution.inflow = held;
        }
        Ok(solution)
    }

    /// Circulation and near wake of a blade at every azimuth for held far inflow, of a rotor in motion as `course` says;
    /// `lambda_far` and `start` row by row, as the memory of sections that remember.
    pub fn circulations(
        &self,
        air: Air,
        options: &WakeOptions,
        course: &Course,
        (instants, memory): (&[BladeInstant], &MemoryRows),
        lambda_far: &[f64],
        start: &[f64],
    ) -> Result<Circulations, WakeError> {
        let n = self.blade.stations.len();
        let by_steps = self.sections.as_ref().is_some_and(|law| law.model.answers_at_once());
        let n_azimuths = instants.len();
        let step = self.nominal_step(n_azimuths) * course.pace;
        let mut all = Circulations::default();
        for (i, blade) in instants.iter().enumerate() {
            let (flap, lead) = self.equivalent_angles(&blade.modal);
            let state = BladeState { psi: blade.psi, flap, lead };
            let placed = self.placed(air, options, (&course.blades, &course.near), blade, &state)?;
            let row = i * n..(i + 1) * n;
            let past = if by_steps {
                // where separation is steep its lag, held, would lead the circulation astray
                memory.step((i + n_azimuths - 1) % n_azimuths, step)
            } else {
                memory.periodic(i)
            };
            let solution =
                self.blade_circulation(air, (&placed, past), &lambda_far[row.clone()], &start[row])?;
            let solution = self.solved(solution, i, blade.psi)?;
            all.residual = all.residual.max(solution.residual);
            all.followed += usize::from(solution.found_by != Some(Route::Newton));
            all.gamma.extend(solution.gamma);
            all.inflow.extend(solution.inflow);
        }
        Ok(all)
    }
}
