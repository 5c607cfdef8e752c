//! The models of a section by name, over one kind of states.

use super::lag::{Drive, Law, MAX_STATES, States, advanced, equilibrium, rates};
use super::{Coefficients, DAMPING, Flow, Section};
use crate::numerics::scalar::Real;
use serde::{Deserialize, Serialize};

/// How a section answers in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// The table at the angle of attack of the instant.
    #[default]
    QuasiSteady,
    /// Attached unsteady flow, compressible.
    Attached,
    /// Separation point with one lag.
    Oye,
    /// Four states: shed wake, pressure, separation point.
    Hgm,
}

/// Runs `$call` with `$law` being the law of `$model`.
macro_rules! of_law {
    ($model:expr, $law:ident => $call:expr) => {
        match $model {
            $crate::airfoil::unsteady::Model::QuasiSteady => {
                let $law = &$crate::airfoil::unsteady::model::Table;
                $call
            }
            $crate::airfoil::unsteady::Model::Attached => {
                let $law = &$crate::airfoil::unsteady::attached::Attached;
                $call
            }
            $crate::airfoil::unsteady::Model::Oye => {
                let $law = &$crate::airfoil::unsteady::oye::Oye;
                $call
            }
            $crate::airfoil::unsteady::Model::Hgm => {
                let $law = &$crate::airfoil::unsteady::hgm::Hgm;
                $call
            }
        }
    };
}
pub(super) use of_law;

fn names_of<L: Law>(_: &L) -> &'static [&'static str] {
    L::NAMES
}

fn sources_of<L: Law>(_: &L) -> &'static [&'static str] {
    L::SOURCES
}

impl Model {
    /// Every model, by the name that users type.
    pub const ALL: [(&'static str, Self); 4] = [
        (Self::QuasiSteady.name(), Self::QuasiSteady),
        (Self::Attached.name(), Self::Attached),
        (Self::Oye.name(), Self::Oye),
        (Self::Hgm.name(), Self::Hgm),
    ];

    /// Name that users type.
    pub const fn name(self) -> &'static str {
        match self {
            Self::QuasiSteady => "quasi-steady",
            Self::Attached => "attached",
            Self::Oye => "oye",
            Self::Hgm => "hgm",
        }
    }

    /// Whether the wake that a section sheds is in its states.
    pub fn sheds(self) -> bool {
        matches!(self, Self::Attached | Self::Hgm)
    }

    /// Name of each state.
    pub fn state_names(self) -> &'static [&'static str] {
        of_law!(self, law => names_of(law))
    }

    /// Keys of its sources.
    pub fn sources(self) -> &'static [&'static str] {
        of_law!(self, law => sources_of(law))
    }

    /// Whether at least half of a change of lift comes at once. Of such a model the rest can be taken from the iteration before:
    /// however strong the near wake, what it takes off that rest is less than what is there.
    pub fn answers_at_once(self) -> bool {
        !matches!(self, Self::Attached)
    }

    /// Rates of the states.
    pub fn rates<S: Real>(self, section: &Section, flow: &Flow<S>, states: &States<S>) -> States<S> {
        of_law!(self, law => rates(law, section, flow, states))
    }

    /// States of a flow that stays.
    pub fn equilibrium<S: Real>(self, section: &Section, flow: &Flow<S>) -> States<S> {
        of_law!(self, law => equilibrium(law, section, flow))
    }

    /// States after `dt` [s], the flow before and after given.
    pub fn advanced<S: Real>(
        self,
        section: &Section,
        flows: [&Flow<S>; 2],
        dt: f64,
        states: &States<S>,
    ) -> States<S> {
        of_law!(self, law => advanced(law, section, flows, dt, states))
    }

    /// Coefficients of the section.
    pub fn coefficients<S: Real>(
        self,
        section: &Section,
        flow: &Flow<S>,
        states: &States<S>,
    ) -> Coefficients<S> {
        of_law!(self, law => law.coefficients(section, flow, states))
    }
}

/// The table at the angle of attack of three quarters of the chord, with the damping of thin-airfoil theory: a law without states.
#[derive(Clone, Copy, Debug, Default)]
pub struct Table;

impl Law for Table {
    const SOURCES: &'static [&'static str] = &[];
    const NAMES: &'static [&'static str] = &[];
    const STAGE: &'static [usize] = &[];

    fn drives<S: Real>(
        &self,
        _section: &Section,
        _flow: &Flow<S>,
        _states: &States<S>,
    ) -> [Drive<S>; MAX_STATES] {
        [Drive::none(); MAX_STATES]
    }

    fn coefficients<S: Real>(
        &self,
        section: &Section,
        flow: &Flow<S>,
        _states: &States<S>,
    ) -> Coefficients<S> {
        let (cl, cd, cm) = section.airfoil.coefficients(flow.alpha, flow.mach());
        Coefficients {
            cl,
            circulatory: cl,
            cd,
            cm: cm + flow.reduced_rate(section.chord) * DAMPING,
            alpha_effective: flow.alpha,
            separation: section.separation.at(flow.alpha, flow.mach()).point,
        }
    }
}
