//! What follows from the options of a free wake, and which of them go together.

use super::declared::{MarchingOptions, RelaxationOptions, WakeOptions};
use super::describe::short;
use super::rotor::WakeRotor;
use crate::airfoil::unsteady::Model as Unsteady;
use crate::vortex::sources::Packing;
use crate::vortex::tree::{Method, Numbers};
use crate::wake::choices::{
    BladeModel, FarWake, Form, InboardWake, Precision, ShedWake, Summation, Trailers,
};
use crate::wake::error::WakeError;
use std::f64::consts::TAU;

/// Outer end of the spans that the inboard sheet gathers (fraction of R).
pub const OUTER_END: f64 = 0.8;

/// Least core radius that the trailers inboard of the tip are given where none is asked for, over R.
const LEAST_TRAILER_CORE: f64 = 0.02;

/// Nearest whole number if `value` is one to rounding.
fn whole(value: f64) -> Option<usize> {
    let nearest = value.round();
    ((value - nearest).abs() < 1e-6 && nearest >= 0.0).then_some(nearest as usize)
}

/// An angle as users type it.
fn degrees(angle: f64) -> String {
    format!("{} deg", short(angle.to_degrees()))
}

/// The error of `field` unless `ok`.
fn demand(
    ok: bool,
    field: &'static str,
    value: impl FnOnce() -> String,
    allowed: impl FnOnce() -> String,
) -> Result<(), WakeError> {
    if ok { Ok(()) } else { Err(WakeError::InvalidOption { field, value: value(), allowed: allowed() }) }
}

/// Whether `step` [rad] divides the angle between `n_blades` blades.
pub fn check_azimuth_step(step: f64, n_blades: usize) -> Result<(), WakeError> {
    let between = TAU / n_blades as f64;
    let count = between / step;
    let divides = (count - count.round()).abs() <= 1e-9 * count && count.round() >= 1.0;
    demand(
        divides,
        "azimuth_step",
        || degrees(step),
        || {
            let blades = if n_blades > 1 { format!(" ({n_blades} blades)") } else { String::new() };
            format!("must be positive and divide {}{blades}", degrees(between))
        },
    )
}

impl WakeOptions {
    /// Options of a rotor with a lone tip vortex (made full-span, with trailers at every edge) summed in double precision, every
    /// other numerical parameter at its default in forward flight; lengths in m, `omega` in rad/s.
    pub fn new(
        n_blades: usize,
        radius: f64,
        root_cutout: f64,
        hinge_offset: f64,
        chord: f64,
        omega: f64,
    ) -> Self {
        let rotor = WakeRotor { n_blades, radius, root_cutout, hinge_offset, chord, omega };
        WakeOptions {
            rotor,
            trailers: Trailers::Tip,
            n_trailers: 0,
            far_wake_turns: 0,
            precision: Precision::Double,
            ..WakeOptions::default()
        }
    }

    /// How the vortices are summed at the markers.
    pub(crate) fn method(&self) -> Method {
        let tolerance = self.tree_tolerance;
        let numbers = match self.precision {
            Precision::Double => Numbers::Double,
            Precision::Single => Numbers::Single,
        };
        match self.summation {
            Summation::Auto => Method::Auto { tolerance, numbers },
            Summation::Direct => Method::Direct,
            Summation::Tree => Method::Tree { tolerance, numbers },
        }
    }

    /// What the vortices are packed for; the tree, where it sums at the markers, is made of those in double precision.
    pub(crate) fn packing(&self, by_tree: bool) -> Packing {
        match self.precision {
            Precision::Double => Packing::Double,
            Precision::Single if by_tree => Packing::Both(self.rotor.radius),
            Precision::Single => Packing::Single(self.rotor.radius),
        }
    }

    /// Steps of azimuth, and of age, per revolution.
    pub fn steps_per_revolution(&self) -> usize {
        (TAU / self.azimuth_step).round() as usize
    }

    /// Step of azimuth and of age [rad], a revolution over its number of steps.
    pub fn delta_psi(&self) -> f64 {
        TAU / self.steps_per_revolution() as f64
    }

    /// Segments of a free filament.
    pub fn n_segments(&self) -> usize {
        whole(self.turns * self.steps_per_revolution() as f64).unwrap_or(0)
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

    /// Core radius of free trailer `t` of a blade, root to tip, at its release (fraction of R).
    pub fn release_core(&self, t: usize) -> f64 {
        let panels = self.trailers_per_blade() - 1;
        if t == panels {
            return self.core_radius;
        }
        // what a trailer stands for is spread over the panels beside it
        self.trailer_core.unwrap_or_else(|| {
            let span = 1.0 - self.rotor.root_cutout / self.rotor.radius;
            (span / (3.0 * panels as f64)).max(LEAST_TRAILER_CORE)
        })
    }

    /// Tip speed [m/s].
    pub fn tip_speed(&self) -> f64 {
        self.rotor.omega * self.rotor.radius
    }

    /// Filaments of the inboard sheet per blade that are in use.
    pub fn sheet_filaments(&self) -> usize {
        match self.inboard_wake {
            InboardWake::None => 0,
            InboardWake::Sheet => self.n_sheet,
        }
    }

    /// Checks what can be told without the rotor: every range, and what goes together.
    pub fn check_alone(&self) -> Result<(), WakeError> {
        self.check()?;
        check_azimuth_step(self.azimuth_step, 1)?;
        let full_span = self.trailers == Trailers::FullSpan;
        let most = self.n_stations + 1;
        demand(
            self.n_trailers == 0 || (2..=most).contains(&self.n_trailers),
            "n_trailers",
            || self.n_trailers.to_string(),
            || format!("must be 0, or from 2 to n_stations + 1 = {most}"),
        )?;
        demand(
            !full_span || self.inboard_wake == InboardWake::None,
            "inboard_wake",
            || "'sheet'".to_owned(),
            || "must be none with trailers = full-span, which are the inboard wake".to_owned(),
        )?;
        demand(
            !full_span || self.release_radius == 1.0,
            "release_radius",
            || short(self.release_radius),
            || {
                "must be 1 with trailers = full-span, which leave from the edges of the bound elements"
                    .to_owned()
            },
        )?;
        let tips_alone = !full_span && self.inboard_wake == InboardWake::None && self.far_wake_turns == 0;
        demand(
            self.far_wake == FarWake::Repeat || tips_alone && self.turns >= 2.0,
            "far_wake",
            || "'cylinder'".to_owned(),
            || "for tip vortices of at least 2 turns, without inboard wake and far_wake_turns".to_owned(),
        )?;
        demand(
            self.far_wake_turns == 0 || self.turns >= 2.0,
            "far_wake_turns",
            || self.far_wake_turns.to_string(),
            || "must be 0 unless turns is at least 2".to_owned(),
        )
    }

    /// Checks that no shed wake is counted twice: in the states of the sections and among the vortices.
    pub fn check_shed_wake(&self) -> Result<(), WakeError> {
        let sheds = self.trailers == Trailers::FullSpan && self.shed_wake != ShedWake::None;
        demand(
            !(sheds && self.unsteady.sheds()),
            "unsteady",
            || format!("'{}'", self.unsteady.name()),
            || {
                "the shed wake is in its states, it must not be among the vortices too: choose trailers = tip, or shed_wake = \
                 none, or unsteady = quasi-steady or oye"
                    .to_owned()
            },
        )
    }

    /// Checks that sections behind their bound line have a near wake, and no states.
    pub fn check_blade_model(&self) -> Result<(), WakeError> {
        let second_order = self.blade_model == BladeModel::SecondOrder;
        demand(
            !second_order || self.unsteady == Unsteady::QuasiSteady,
            "unsteady",
            || format!("'{}'", self.unsteady.name()),
            || "must be quasi-steady with blade_model = second-order".to_owned(),
        )?;
        demand(
            !second_order || self.near_wake_angle > 0.0,
            "near_wake_angle",
            || degrees(self.near_wake_angle),
            || "must be above 0 with blade_model = second-order".to_owned(),
        )
    }

    /// Checks every value, with the rotor they belong to.
    pub fn validate(&self) -> Result<(), WakeError> {
        self.rotor.validate()?;
        self.check_alone()?;
        self.check_shed_wake()?;
        self.check_blade_model()?;
        let WakeRotor { n_blades, radius, root_cutout, hinge_offset, .. } = self.rotor;
        check_azimuth_step(self.azimuth_step, n_blades)?;
        let steps = || format!("must be a whole number of azimuth steps of {}", degrees(self.azimuth_step));
        let length = self.turns * self.steps_per_revolution() as f64;
        demand(whole(length).is_some(), "turns", || short(self.turns), steps)?;
        demand(
            whole(self.near_wake_angle / self.delta_psi()).is_some(),
            "near_wake_angle",
            || degrees(self.near_wake_angle),
            || {
                // not beyond the range of the option, 90 deg
                let most = (0.25 * TAU / self.delta_psi() + 1e-9).floor();
                let near = (self.near_wake_angle / self.delta_psi()).round().min(most).max(1.0)
                    * self.azimuth_step.to_degrees();
                let digits = format!("{near:.9}");
                format!("{}, such as {} deg", steps(), digits.trim_end_matches('0').trim_end_matches('.'))
            },
        )?;
        demand(
            self.inboard_wake == InboardWake::None || root_cutout < OUTER_END * radius,
            "root_cutout",
            || root_cutout.to_string(),
            || "inside 0.8 of the radius with an inboard sheet".to_owned(),
        )?;
        demand(
            self.release_radius * radius > root_cutout.max(hinge_offset),
            "release_radius",
            || short(self.release_radius),
            || "outboard of the hinge and of the root cutout, up to 1".to_owned(),
        )
    }
}

impl RelaxationOptions {
    /// Checks every value.
    pub fn validate(&self) -> Result<(), WakeError> {
        self.check()
    }
}

impl MarchingOptions {
    /// Checks every value, and that they go with those of the wake.
    pub fn validate(&self, wake: &WakeOptions) -> Result<(), WakeError> {
        self.check()?;
        demand(
            self.time_filter == 0.0 || wake.form == Form::Displacement,
            "time_filter",
            || short(self.time_filter),
            || "must be 0 unless form is displacement".to_owned(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wake::options::describe::{Descriptor, FREE_WAKES, Kind, Told};

    fn options() -> WakeOptions {
        WakeOptions::new(4, 8.0, 1.0, 0.4, 0.5, 27.0)
    }

    #[test]
    fn numerical_parameters_have_defaults_and_rotor_data_have_none() {
        let given: WakeOptions = serde_json::from_str("{}").unwrap();
        assert!(given.validate().is_err(), "a wake without a rotor");
        assert!(options().validate().is_ok());
        assert_eq!((options().n_segments(), options().near_wake_markers()), (144, 3));
        let rotor =
            r#"{"n_blades": 4, "radius": 8.0, "root_cutout": 1.0, "hinge_offset": 0.4, "omega": 27.0}"#;
        let message = serde_json::from_str::<WakeRotor>(rotor).unwrap_err().to_string();
        assert!(message.contains("chord"), "{message}");
        assert!(serde_json::from_str::<WakeOptions>(r#"{"core": 0.02}"#).is_err());
    }

    #[test]
    fn a_refused_option_names_field_and_value() {
        let refused = |change: &dyn Fn(&mut WakeOptions)| {
            let mut options = options();
            change(&mut options);
            options.validate().unwrap_err().to_string()
        };
        let message = refused(&|o| o.azimuth_step = TAU / 30.0);
        assert!(
            message.contains("azimuth_step = 12 deg") && message.contains("90 deg (4 blades)"),
            "{message}"
        );
        assert!(refused(&|o| o.turns = 2.01).contains("turns = 2.01"));
        assert!(refused(&|o| o.turns = f64::NAN).contains("turns = NaN"));
        assert!(refused(&|o| o.near_wake_angle = 0.5).contains("near_wake_angle = 28.6479 deg"));
        assert!(refused(&|o| o.near_wake_angle = 0.5).contains("steps of 10 deg, such as 30 deg"));
        let seven = |o: &mut WakeOptions| {
            (o.rotor.n_blades, o.azimuth_step, o.near_wake_angle) = (7, TAU / 42.0, 1.57);
        };
        assert!(refused(&seven).contains("such as 85.714285714 deg"), "{}", refused(&seven));
        assert!(refused(&|o| o.near_wake_angle = 3.0).contains("from 0 deg to 90 deg"));
        assert!(refused(&|o| o.rotor.radius = f64::NAN).contains("radius = NaN"));
        let full_span = |o: &mut WakeOptions| o.trailers = Trailers::FullSpan;
        assert!(refused(&|o| (full_span(o), o.inboard_wake = InboardWake::Sheet).0).contains("inboard_wake"));
        assert!(refused(&|o| (full_span(o), o.n_trailers = 22).0).contains("n_stations + 1 = 21"));
        assert!(refused(&|o| (full_span(o), o.release_radius = 0.98).0).contains("release_radius = 0.98"));
        let twice = refused(&|o| (full_span(o), o.unsteady = Unsteady::Hgm).0);
        assert!(twice.contains("unsteady = 'hgm'") && twice.contains("trailers = tip"), "{twice}");
        let allowed = |change: &dyn Fn(&mut WakeOptions)| {
            let mut options = WakeOptions { trailers: Trailers::FullSpan, ..options() };
            change(&mut options);
            options.validate().is_ok()
        };
        assert!(allowed(&|o| o.unsteady = Unsteady::Oye));
        assert!(allowed(&|o| (o.unsteady, o.shed_wake) = (Unsteady::Attached, ShedWake::None)));
        let nothing = RelaxationOptions { relaxation: 0.0, ..RelaxationOptions::default() };
        assert!(nothing.validate().unwrap_err().to_string().contains("relaxation = 0"));
        let filtered = MarchingOptions { time_filter: 0.05, ..MarchingOptions::default() };
        assert!(filtered.validate(&options()).is_ok());
        let of_positions = WakeOptions { form: Form::Position, ..options() };
        assert!(filtered.validate(&of_positions).unwrap_err().to_string().contains("time_filter = 0.05"));
    }

    #[test]
    fn every_option_is_told_whole_and_its_defaults_are_allowed() {
        let groups =
            [WakeOptions::descriptors(), RelaxationOptions::descriptors(), MarchingOptions::descriptors()];
        for told in groups.into_iter().flatten() {
            let Descriptor { name, meaning, range, words, kind, .. } = told;
            assert!(meaning.ends_with('.') || meaning.ends_with(')'), "{name}: {meaning}");
            let number = matches!(kind, Kind::Number | Kind::Whole);
            assert_eq!(range.is_some(), number, "{name}: a range");
            assert_eq!(!words.is_empty(), *kind == Kind::Word, "{name}: words");
            match told.default {
                Told::Always(value) => told.check(value).unwrap(),
                Told::ByRegime { forward, slow, hover, descent } => {
                    [forward, slow, hover, descent].into_iter().for_each(|v| told.check(v).unwrap());
                }
                Told::LeftOpen(words) => assert!(!words.is_empty()),
            }
        }
        let shared = WakeOptions::descriptors().iter().filter(|told| told.models == FREE_WAKES).count();
        assert_eq!(shared, WakeOptions::descriptors().len() - 4);
    }
}
