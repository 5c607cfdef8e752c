//! Rotor, grid and vortex model of a free wake.

use super::choices::{
    CoreDistance, Evaluation, FarWake, Form, InboardWake, Predictor, Scheme, ShedWake, Summation,
    TipStrength, Trailers,
};
use super::error::WakeError;
use crate::vortex::tree::Method;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Options of a free wake. Rotor data have no default; numerical parameters have.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct WakeOptions {
    /// Number of blades.
    pub n_blades: usize,
    /// Rotor radius [m].
    pub radius: f64,
    /// Inner end of the bound vortex [m].
    pub root_cutout: f64,
    /// Distance of the equivalent hinge from the shaft [m].
    pub hinge_offset: f64,
    /// Reference chord of core radii [m].
    pub chord: f64,
    /// Rotor speed relative to the airframe [rad/s].
    pub omega: f64,
    /// Bound elements per blade.
    #[serde(default = "default::n_stations")]
    pub n_stations: usize,
    /// Length of the free filaments [revolutions]; a whole number of steps.
    #[serde(default = "default::turns")]
    pub turns: f64,
    /// Steps of azimuth, and of age, per revolution; a multiple of `n_blades`.
    #[serde(default = "default::steps_per_revolution")]
    pub steps_per_revolution: usize,
    /// Corrector of the time-marching wake.
    #[serde(default = "default::scheme")]
    pub scheme: Scheme,
    /// Predictor of the time-marching wake.
    #[serde(default = "default::predictor")]
    pub predictor: Predictor,
    /// Fields that a step of the time-marching wake evaluates.
    #[serde(default = "default::evaluation")]
    pub evaluation: Evaluation,
    /// How the vortices are summed at the markers; at the stations, which are few, always directly.
    #[serde(default = "default::summation")]
    pub summation: Summation,
    /// Error allowed of the tree, over the largest induced velocity at the markers.
    #[serde(default = "default::tree_tolerance")]
    pub tree_tolerance: f64,
    /// Unknown of the time-marching stencils.
    #[serde(default = "default::form")]
    pub form: Form,
    /// Weight of the second difference in time that is added to the middle level, 0: none.
    #[serde(default = "default::zero")]
    pub time_filter: f64,
    /// Free filaments of a blade.
    #[serde(default = "default::trailers")]
    pub trailers: Trailers,
    /// Trailers per blade of a full-span wake; 0: one at every edge of the bound elements.
    #[serde(default = "default::none")]
    pub n_trailers: usize,
    /// Core radius of the trailers of a full-span wake at their release (fraction of R).
    #[serde(default = "default::core_radius")]
    pub trailer_core: f64,
    /// Shed vortices of a full-span wake.
    #[serde(default = "default::shed_wake")]
    pub shed_wake: ShedWake,
    /// Rule for the strength of the tip vortex.
    #[serde(default = "default::tip_strength")]
    pub tip_strength: TipStrength,
    /// Inner end of the range of `max` and `mean` (fraction of R).
    #[serde(default = "default::half")]
    pub tip_strength_inner: f64,
    /// Inboard wake beyond the near wake.
    #[serde(default = "default::inboard_wake")]
    pub inboard_wake: InboardWake,
    /// Filaments of the inboard sheet per blade.
    #[serde(default = "default::n_sheet")]
    pub n_sheet: usize,
    /// Speed of the sheet along the shaft over the mean induced velocity.
    #[serde(default = "default::one")]
    pub sheet_factor: f64,
    /// Core radius of the tip vortex, and of the sheet, at their release (fraction of R).
    #[serde(default = "default::core_radius")]
    pub core_radius: f64,
    /// Growth of the square of the core radius, over R^2, per radian of age.
    #[serde(default = "default::core_growth")]
    pub core_growth: f64,
    /// Whether stretching of a segment thins its core.
    #[serde(default = "default::no")]
    pub core_stretching: bool,
    /// Distance in the core factor.
    #[serde(default = "default::core_distance")]
    pub core_distance: CoreDistance,
    /// Whether a marker gets the velocity of the arc that its two chords lack.
    #[serde(default = "default::no")]
    pub curvature_correction: bool,
    /// Whether the rates of the hub act on the free filaments; on blades and near wake they always do.
    #[serde(default = "default::yes")]
    pub rates: bool,
    /// Length of the near wake [rad]; a whole number of steps, 0: none.
    #[serde(default = "default::near_wake_angle")]
    pub near_wake_angle: f64,
    /// Straight segments of a near-wake trailer.
    #[serde(default = "default::near_wake_segments")]
    pub near_wake_segments: usize,
    /// Core radius of the bound vortices (chords).
    #[serde(default = "default::quarter")]
    pub bound_core: f64,
    /// Least core radius in the inflow at the blades (chords); not for the near wake.
    #[serde(default = "default::quarter")]
    pub station_core_floor: f64,
    /// What goes on behind the free filaments.
    #[serde(default = "default::far_wake")]
    pub far_wake: FarWake,
    /// Repeats of the last turn behind the free filaments.
    #[serde(default = "default::none")]
    pub far_wake_turns: usize,
    /// Release of the tip vortex (fraction of R).
    #[serde(default = "default::one")]
    pub release_radius: f64,
    /// Relaxation factor of the sweeps.
    #[serde(default = "default::half")]
    pub relaxation: f64,
}

/// Default values of the numerical parameters.
mod default {
    use super::*;
    pub fn n_stations() -> usize {
        20
    }
    pub fn turns() -> f64 {
        4.0
    }
    pub fn steps_per_revolution() -> usize {
        36
    }
    pub fn scheme() -> Scheme {
        Scheme::Bdf2
    }
    pub fn predictor() -> Predictor {
        Predictor::Same
    }
    pub fn evaluation() -> Evaluation {
        Evaluation::Pece
    }
    pub fn summation() -> Summation {
        Summation::Auto
    }
    pub fn tree_tolerance() -> f64 {
        crate::vortex::tree::DEFAULT_TOLERANCE
    }
    pub fn form() -> Form {
        Form::Displacement
    }
    pub fn trailers() -> Trailers {
        Trailers::Tip
    }
    pub fn shed_wake() -> ShedWake {
        ShedWake::Beyond
    }
    pub fn far_wake() -> FarWake {
        FarWake::Repeat
    }
    pub fn tip_strength() -> TipStrength {
        TipStrength::Equivalent
    }
    pub fn inboard_wake() -> InboardWake {
        InboardWake::None
    }
    pub fn n_sheet() -> usize {
        4
    }
    // regularisation of rotors whose wake stays in the disk: smaller cores do not settle
    pub fn core_radius() -> f64 {
        0.02
    }
    pub fn core_growth() -> f64 {
        3e-4
    }
    pub fn core_distance() -> CoreDistance {
        CoreDistance::Line
    }
    pub fn near_wake_angle() -> f64 {
        PI / 6.0
    }
    pub fn near_wake_segments() -> usize {
        6
    }
    pub fn none() -> usize {
        0
    }
    pub fn no() -> bool {
        false
    }
    pub fn yes() -> bool {
        true
    }
    pub fn zero() -> f64 {
        0.0
    }
    pub fn quarter() -> f64 {
        0.25
    }
    pub fn half() -> f64 {
        0.5
    }
    pub fn one() -> f64 {
        1.0
    }
}

/// Nearest whole number if `value` is one to rounding.
fn whole(value: f64) -> Option<usize> {
    let nearest = value.round();
    ((value - nearest).abs() < 1e-6 && nearest >= 0.0).then_some(nearest as usize)
}

impl WakeOptions {
    /// Options of a rotor with every numerical parameter at its default; lengths in m, `omega` in rad/s.
    pub fn new(
        n_blades: usize,
        radius: f64,
        root_cutout: f64,
        hinge_offset: f64,
        chord: f64,
        omega: f64,
    ) -> Self {
        WakeOptions {
            n_blades,
            radius,
            root_cutout,
            hinge_offset,
            chord,
            omega,
            n_stations: default::n_stations(),
            turns: default::turns(),
            steps_per_revolution: default::steps_per_revolution(),
            scheme: default::scheme(),
            predictor: default::predictor(),
            evaluation: default::evaluation(),
            summation: default::summation(),
            tree_tolerance: default::tree_tolerance(),
            form: default::form(),
            time_filter: default::zero(),
            trailers: default::trailers(),
            n_trailers: default::none(),
            trailer_core: default::core_radius(),
            shed_wake: default::shed_wake(),
            tip_strength: default::tip_strength(),
            tip_strength_inner: default::half(),
            inboard_wake: default::inboard_wake(),
            n_sheet: default::n_sheet(),
            sheet_factor: default::one(),
            core_radius: default::core_radius(),
            core_growth: default::core_growth(),
            core_stretching: default::no(),
            core_distance: default::core_distance(),
            curvature_correction: default::no(),
            rates: default::yes(),
            near_wake_angle: default::near_wake_angle(),
            near_wake_segments: default::near_wake_segments(),
            bound_core: default::quarter(),
            station_core_floor: default::quarter(),
            far_wake: default::far_wake(),
            far_wake_turns: default::none(),
            release_radius: default::one(),
            relaxation: default::half(),
        }
    }

    /// How the vortices are summed at the markers.
    pub(crate) fn method(&self) -> Method {
        let tolerance = self.tree_tolerance;
        match self.summation {
            Summation::Auto => Method::Auto { tolerance },
            Summation::Direct => Method::Direct,
            Summation::Tree => Method::Tree { tolerance },
        }
    }

    /// Step of azimuth and of age [rad].
    pub fn delta_psi(&self) -> f64 {
        TAU / self.steps_per_revolution as f64
    }

    /// Segments of a free filament.
    pub fn n_segments(&self) -> usize {
        whole(self.turns * self.steps_per_revolution as f64).unwrap_or(0)
    }

    /// First marker beyond the near wake.
    pub fn near_wake_markers(&self) -> usize {
        whole(self.near_wake_angle / self.delta_psi()).unwrap_or(0)
    }

    /// Free filaments of a blade.
    pub fn trailers_per_blade(&self) -> usize {
        match self.trailers {
            Trailers::Tip => 1,
            Trailers::FullSpan if self.n_trailers == 0 => self.n_stations + 1,
            Trailers::FullSpan => self.n_trailers,
        }
    }

    /// Core radius of the free filaments at their release (fraction of R).
    pub fn release_core(&self) -> f64 {
        match self.trailers {
            Trailers::Tip => self.core_radius,
            Trailers::FullSpan => self.trailer_core,
        }
    }

    /// Tip speed [m/s].
    pub fn tip_speed(&self) -> f64 {
        self.omega * self.radius
    }

    /// Filaments of the inboard sheet per blade that are in use.
    pub fn sheet_filaments(&self) -> usize {
        match self.inboard_wake {
            InboardWake::None => 0,
            InboardWake::Sheet => self.n_sheet,
        }
    }

    /// Checks every value.
    pub fn validate(&self) -> Result<(), WakeError> {
        fn demand(
            ok: bool,
            field: &'static str,
            value: impl ToString,
            allowed: &str,
        ) -> Result<(), WakeError> {
            if ok {
                Ok(())
            } else {
                Err(WakeError::InvalidOption {
                    field,
                    value: value.to_string(),
                    allowed: allowed.to_string(),
                })
            }
        }
        let positive = |v: f64| v.is_finite() && v > 0.0;
        let not_negative = |v: f64| v.is_finite() && v >= 0.0;
        demand(self.n_blades >= 1, "n_blades", self.n_blades, "at least 1")?;
        demand(positive(self.radius), "radius", self.radius, "positive")?;
        demand(
            not_negative(self.root_cutout) && self.root_cutout < self.radius,
            "root_cutout",
            self.root_cutout,
            "from 0 to less than the radius",
        )?;
        demand(
            not_negative(self.hinge_offset) && self.hinge_offset < self.radius,
            "hinge_offset",
            self.hinge_offset,
            "from 0 to less than the radius",
        )?;
        demand(positive(self.chord), "chord", self.chord, "positive")?;
        demand(positive(self.omega), "omega", self.omega, "positive")?;
        demand(self.n_stations >= 1, "n_stations", self.n_stations, "at least 1")?;
        demand(
            self.steps_per_revolution >= 4 && self.steps_per_revolution.is_multiple_of(self.n_blades),
            "steps_per_revolution",
            self.steps_per_revolution,
            &format!("at least 4 and a multiple of n_blades = {}", self.n_blades),
        )?;
        let markers = whole(self.turns * self.steps_per_revolution as f64);
        demand(
            self.turns.is_finite() && markers.is_some_and(|n| n >= self.steps_per_revolution),
            "turns",
            self.turns,
            "at least 1 and a whole number of steps",
        )?;
        demand(
            (0.0..0.5).contains(&self.time_filter)
                && (self.time_filter == 0.0 || self.form == Form::Displacement),
            "time_filter",
            self.time_filter,
            "from 0 to less than 0.5, and 0 unless form is displacement",
        )?;
        demand(
            (1e-12..=0.1).contains(&self.tree_tolerance),
            "tree_tolerance",
            self.tree_tolerance,
            "from 1e-12 to 0.1",
        )?;
        let full_span = self.trailers == Trailers::FullSpan;
        demand(
            self.n_trailers == 0 || (2..=self.n_stations + 1).contains(&self.n_trailers),
            "n_trailers",
            self.n_trailers,
            &format!("0 or from 2 to n_stations + 1 = {}", self.n_stations + 1),
        )?;
        demand(not_negative(self.trailer_core), "trailer_core", self.trailer_core, "not negative")?;
        demand(
            !full_span || self.inboard_wake == InboardWake::None,
            "inboard_wake",
            "sheet",
            "none with full-span trailers, which are the inboard wake",
        )?;
        demand(
            !full_span || self.release_radius == 1.0,
            "release_radius",
            self.release_radius,
            "1 with full-span trailers, which leave from the edges of the bound elements",
        )?;
        demand(
            self.tip_strength_inner >= 0.0 && self.tip_strength_inner < 1.0,
            "tip_strength_inner",
            self.tip_strength_inner,
            "from 0 to less than 1",
        )?;
        demand(self.n_sheet >= 1, "n_sheet", self.n_sheet, "at least 1")?;
        demand(
            self.inboard_wake == InboardWake::None
                || self.root_cutout < super::inboard_sheet::OUTER_END * self.radius,
            "root_cutout",
            self.root_cutout,
            "inside 0.8 of the radius with an inboard sheet",
        )?;
        demand(not_negative(self.sheet_factor), "sheet_factor", self.sheet_factor, "not negative")?;
        demand(not_negative(self.core_radius), "core_radius", self.core_radius, "not negative")?;
        demand(not_negative(self.core_growth), "core_growth", self.core_growth, "not negative")?;
        let near = whole(self.near_wake_angle / self.delta_psi());
        demand(
            self.near_wake_angle.is_finite() && near.is_some_and(|n| n < self.steps_per_revolution),
            "near_wake_angle",
            self.near_wake_angle,
            "from 0 to less than a revolution, a whole number of steps",
        )?;
        demand(
            self.near_wake_segments >= 1 || near == Some(0),
            "near_wake_segments",
            self.near_wake_segments,
            "at least 1 with a near wake",
        )?;
        demand(not_negative(self.bound_core), "bound_core", self.bound_core, "not negative")?;
        demand(
            not_negative(self.station_core_floor),
            "station_core_floor",
            self.station_core_floor,
            "not negative",
        )?;
        demand(
            self.far_wake == FarWake::Repeat
                || markers.is_some_and(|n| n >= 2 * self.steps_per_revolution)
                    && self.trailers == Trailers::Tip
                    && self.inboard_wake == InboardWake::None
                    && self.far_wake_turns == 0,
            "far_wake",
            "cylinder",
            "for tip vortices of at least 2 turns, without inboard wake and far_wake_turns",
        )?;
        demand(
            self.far_wake_turns == 0 || markers.is_some_and(|n| n >= 2 * self.steps_per_revolution),
            "far_wake_turns",
            self.far_wake_turns,
            "0 unless turns is at least 2",
        )?;
        demand(
            self.release_radius.is_finite()
                && self.release_radius <= 1.0
                && self.release_radius * self.radius > self.root_cutout.max(self.hinge_offset),
            "release_radius",
            self.release_radius,
            "outboard of the hinge and of the root cutout, up to 1",
        )?;
        demand(
            self.relaxation > 0.0 && self.relaxation <= 1.0,
            "relaxation",
            self.relaxation,
            "more than 0, up to 1",
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROTOR: &str = r#""n_blades": 4, "radius": 8.0, "root_cutout": 1.0, "hinge_offset": 0.4, "chord": 0.5, "omega": 27.0"#;

    #[test]
    fn numerical_parameters_have_defaults_and_rotor_data_have_none() {
        let given: WakeOptions = serde_json::from_str(&format!("{{{ROTOR}}}")).unwrap();
        assert_eq!(given, WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0));
        assert!(given.validate().is_ok());
        assert_eq!((given.n_segments(), given.near_wake_markers()), (144, 3));
        let missing = ROTOR.replace(r#", "chord": 0.5"#, "");
        let message = serde_json::from_str::<WakeOptions>(&format!("{{{missing}}}")).unwrap_err().to_string();
        assert!(message.contains("chord"), "{message}");
        assert!(serde_json::from_str::<WakeOptions>(&format!(r#"{{{ROTOR}, "core": 0.02}}"#)).is_err());
    }

    #[test]
    fn a_refused_option_names_field_and_value() {
        let refused = |change: &dyn Fn(&mut WakeOptions)| {
            let mut options = WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0);
            change(&mut options);
            options.validate().unwrap_err().to_string()
        };
        let message = refused(&|o| o.steps_per_revolution = 30);
        assert!(
            message.contains("steps_per_revolution = 30") && message.contains("n_blades = 4"),
            "{message}"
        );
        assert!(refused(&|o| o.turns = 2.01).contains("turns = 2.01"));
        assert!(refused(&|o| o.near_wake_angle = 0.5).contains("near_wake_angle = 0.5"));
        assert!(refused(&|o| o.radius = f64::NAN).contains("radius = NaN"));
        let full_span = |o: &mut WakeOptions| o.trailers = Trailers::FullSpan;
        assert!(refused(&|o| (full_span(o), o.inboard_wake = InboardWake::Sheet).0).contains("inboard_wake"));
        assert!(refused(&|o| (full_span(o), o.n_trailers = 22).0).contains("n_stations + 1 = 21"));
        assert!(refused(&|o| (full_span(o), o.release_radius = 0.98).0).contains("release_radius = 0.98"));
        assert!(refused(&|o| o.relaxation = 0.0).contains("relaxation = 0"));
    }
}
