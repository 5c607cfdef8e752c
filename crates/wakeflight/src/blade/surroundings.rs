//! What surrounds a blade: section tables, air, rotor speed, inflow.

use super::aerodynamics::Air;
use super::held_row::HeldRow;
use super::sections_in_time::{PlainInflow, SectionsInTime};
use super::thin_section::ThinSection;
use crate::airfoil::span::StationAirfoils;

/// What surrounds a blade and turns it.
#[derive(Clone, Copy, Debug)]
pub struct BladeEnvironment<'a> {
    /// Section table of every station.
    pub airfoils: &'a StationAirfoils,
    /// Air.
    pub air: Air,
    /// Rotor speed [rad/s].
    pub rotor_speed: f64,
    /// Whether drag acts along the whole wind of a section, its part along the span included.
    pub yawed_drag: bool,
}

/// Induced inflow of a blade, positive down (v_i / tip speed).
#[derive(Clone, Copy, Debug)]
pub enum BladeInflow<'a, S> {
    /// lambda_0 + (lambda_c x_h + lambda_s y_h)/R at the section's place: lambda_0, lambda_s, lambda_c.
    Disk([S; 3]),
    /// The same, and one value per station on top of it: what the air does of its own.
    DiskAnd([S; 3], &'a [f64]),
    /// The same of four blades at once, each with its own.
    DiskAndEach([S; 3], &'a [S]),
    /// One value per station, held.
    Stations(HeldRow<'a>),
    /// One value per station, with derivatives.
    Variable(&'a [S]),
    /// Thin sections, held: inflow at the quarter chord turns the lift, that at three quarters makes it.
    TwoLines {
        /// Law of the sections.
        law: ThinSection,
        /// Inflow at the quarter chord.
        quarter: HeldRow<'a>,
        /// Inflow at three quarters, less that of the section's own bound vortex in two dimensions.
        three_quarter: HeldRow<'a>,
    },
    /// Sections that remember.
    InTime {
        /// Inflow.
        inflow: PlainInflow<'a, S>,
        /// The sections.
        sections: SectionsInTime<'a>,
    },
    /// No air at all.
    Vacuum,
}

impl<'a, S> BladeInflow<'a, S> {
    /// The same inflow with sections that remember; without air there is nothing to remember, thin sections have no law in time.
    #[inline(always)]
    pub fn remembering(self, sections: Option<SectionsInTime<'a>>) -> Self {
        let Some(sections) = sections else { return self };
        match self {
            Self::Disk(states) => Self::InTime { inflow: PlainInflow::Disk(states), sections },
            Self::DiskAnd(states, more) => {
                Self::InTime { inflow: PlainInflow::DiskAnd(states, more), sections }
            }
            Self::Stations(values) => Self::InTime { inflow: PlainInflow::Stations(values), sections },
            Self::Variable(values) => Self::InTime { inflow: PlainInflow::Variable(values), sections },
            other => other,
        }
    }
}
