//! The options of the free wakes: each stands here once, and nowhere else is its name, range, default or meaning told.
//!
//! Lengths are over the radius or the chord, angles in rad. Where a default depends on the regime of the rotor the three are
//! those of forward flight, of hover and climb, and of axial descent; at low speed it is that of forward flight unless told.

use super::describe::{
    EVERY_MODEL, FLOWN, FREE_WAKES, RELAXATION, TIME_MARCHING, always, by_regime, declare, left_open,
};
use super::rotor::WakeRotor;
use crate::airfoil::unsteady::Model as Unsteady;
use crate::vortex::tree::DEFAULT_TOLERANCE;
use crate::wake::choices::{
    BladeModel, CoreDistance, Evaluation, FarWake, Form, FuselageUpwash, InboardWake, Precision, Predictor,
    Scheme, ShedWake, Summation, TipStrength, Trailers, Wash,
};
use std::f64::consts::TAU;

/// Angle [rad] of `degrees`.
fn deg(degrees: f64) -> f64 {
    degrees.to_radians()
}

declare! {
    /// Options that both free wakes share, and the rotor they belong to.
    pub struct WakeOptions in "wake" of FREE_WAKES, with
        /// The rotor.
        rotor: WakeRotor
    {
        /// Length of the free filaments in turns; a whole number of azimuth steps.
        turns: f64 = by_regime(4.0, 5.0, 4.0), lattice(always(2.0)), unit("turns"), between(1.0, 20.0), source(&["leishman2002"]),
            finer_larger("wake-turns", None);

        /// Step of azimuth, of wake age and of the coupling; divides the angle between blades.
        azimuth_step: f64 = left_open(deg(10.0), "that of the aircraft's or rotor's file, where it gives none 10 deg or the next below that divides 30 deg and the angle between blades"),
            unit("rad"), between(deg(0.1), deg(45.0)), of(EVERY_MODEL), source(&["ribera2004"]),
            finer_smaller("azimuth-step", Some(2.0));

        /// Blade stations, at the middles of elements that narrow towards the tip.
        n_stations: usize = always(20), between(5.0, 200.0), of(EVERY_MODEL),
            finer_larger("stations", Some(2.0));

        /// How the sections of a blade answer in time. The shed wake is in the states of `attached` and `hgm`: not with a wake that
        /// sheds vorticity itself.
        unsteady: Unsteady = always(Unsteady::QuasiSteady), of(FLOWN), source(&["leishman1989", "oye1991", "hansen2004"]);

        /// Whether the drag of a section acts along the whole wind that it meets, its part along the span included; else along the
        /// part normal to the span.
        yawed_drag: bool = always(false), of(FLOWN), source(&["johnson1986"]);

        /// Where the sections of a blade meet the air of its own wake; on a stand `blade_model` of the stand says it.
        blade_model: BladeModel = always(BladeModel::LiftingLine), source(&["johnson1986"]);

        /// What the stencils act on: displacement from the release point, or position.
        form: Form = always(Form::Displacement);

        /// What leaves a blade freely: its tip vortex alone, or trailers all over the span joined by shed vortices.
        trailers: Trailers = by_regime(Trailers::FullSpan, Trailers::FullSpan, Trailers::Tip), source(&["ribera2004"]);

        /// Trailers per blade of a full-span wake; 0 is one at every edge of the bound elements (n_stations + 1).
        n_trailers: usize = always(3), between(0.0, 201.0);

        /// Core radius at release of the trailers inboard of the tip of a full-span wake, over the rotor radius.
        trailer_core: Option<f64> = left_open(None, "a third of the mean distance of the trailers, at least 0.02 R"), unit("R"), between(0.0, 0.2), source(&["vatistas1991"]);

        /// Shed vortices of a full-span wake: none, all, or all with those over a blade's own near wake gathered at its end.
        shed_wake: ShedWake = always(ShedWake::Beyond);

        /// Tip vortex strength: uniform circulation of equal thrust, maximum or mean of the outboard part.
        tip_strength: TipStrength = always(TipStrength::Equivalent), tip_alone();

        /// Inner end of the part that `max` and `mean` look at, over the radius.
        tip_strength_inner: f64 = always(0.5), tip_alone(), unit("R"), between(0.0, 0.95);

        /// Nothing, or a sheet of rigid helical filaments that closes the tip vortex inboard.
        inboard_wake: InboardWake = always(InboardWake::None), tip_alone();

        /// Filaments per blade of the sheet.
        n_sheet: usize = always(4), tip_alone(), between(1.0, 20.0);

        /// Multiple of the momentum inflow that carries the sheet down.
        sheet_factor: f64 = by_regime(1.0, 1.4, 1.0), tip_alone(), between(0.0, 5.0);

        // smaller cores do not settle where the wake stays in the disk
        /// Core radius of tip vortex, which is the outermost trailer, and sheet at release, over the rotor radius.
        core_radius: f64 = always(0.02), unit("R"), between(0.0, 0.2), source(&["vatistas1991", "bhagwat2002"]),
            varied("core-radius");

        /// Growth of the squared core radius over R² for each radian of age.
        core_growth: f64 = always(3e-4), unit("R²/rad"), between(0.0, 0.1), source(&["squire1965", "bhagwat2002"]),
            varied("core-growth");

        /// Whether the core shrinks as a filament stretches, at constant volume.
        core_stretching: bool = always(false), source(&["ananthan2004"]);

        /// Distance the core acts on: to the segment's line, or to the segment.
        core_distance: CoreDistance = always(CoreDistance::Line), source(&["vatistas1991"]);

        /// Whether a marker feels the curvature of its own filament.
        curvature_correction: bool = always(false);

        /// Extent of the near wake behind each blade; a whole number of azimuth steps, 0 for none.
        near_wake_angle: f64 = always(deg(30.0)), unit("rad"), between(0.0, deg(90.0));

        /// Segments along the near wake.
        near_wake_segments: usize = always(6), between(1.0, 60.0),
            finer_larger("near-wake-segments", Some(2.0));

        /// Core of the bound vortices over the chord.
        bound_core: f64 = always(0.25), unit("c"), between(0.0, 2.0), source(&["vatistas1991"]);

        /// Smallest core seen by blade stations, over the chord; not for the near wake.
        station_core_floor: f64 = always(0.25), unit("c"), between(0.0, 2.0);

        /// What goes on behind the free filaments: the last turn carried on, or, for tip vortices alone in hover and climb, a
        /// semi-infinite vortex cylinder (`cylinder`).
        far_wake: FarWake = always(FarWake::Repeat), tip_alone(), source(&["branlard2014"]);

        /// Turns of far wake behind the free filaments: what leaves them, carried on with the mean velocity of the last turn; of a
        /// full-span wake in its mean circulation and in steps of 30 deg. None with a `cylinder`.
        far_wake_turns: usize = by_regime(0, 2, 12), lattice(by_regime(2, 6, 2).at_low_speed(4)), unit("turns"), between(0.0, 50.0),
            finer_larger("far-wake-turns", None);

        /// Where the tip vortex leaves the blade, over the radius.
        release_radius: f64 = always(1.0), tip_alone(), unit("R"), between(0.5, 1.0);

        /// What stabilator, fin, tail rotor and fuselage feel of the rotor: tables on the mean inflow, or the wake. Not on a stand.
        wash: Wash = always(Wash::Tables), source(&["howlett1981"]);

        /// What the blades feel of the fuselage in its flight through the air. Not on a stand.
        fuselage_upwash: FuselageUpwash = always(FuselageUpwash::None), source(&["lamb1932"]);

        /// Whether the body's rates act on the free filaments (on blades and near wake they always do).
        rates: bool = always(true), source(&["ribera2004"]);

        /// Sum of the vortices at the markers: by the tree where it is faster (large wakes), or always direct or tree.
        summation: Summation = always(Summation::Auto);

        /// Numbers that the vortices are summed in at markers and blades: double precision, or single precision.
        precision: Precision = always(Precision::Single);

        /// Error allowed of the tree, over the largest induced velocity at the markers.
        tree_tolerance: f64 = always(DEFAULT_TOLERANCE), between(1e-12, 0.1);
    }
}

declare! {
    /// Options of the wake made periodic by relaxation [bagai1995].
    pub struct RelaxationOptions in "relaxation" of RELAXATION {
        /// Share of a new geometry taken in each sweep.
        relaxation: f64 = by_regime(0.5, 0.3, 0.3), between(0.01, 1.0), source(&["bagai1995"]);

        /// Sweeps in each iteration of inflow and circulation.
        sweeps: usize = always(2), between(1.0, 100.0);

        /// Share of a new far inflow taken in each iteration of inflow and circulation.
        inflow_relaxation: f64 = by_regime(0.7, 0.35, 0.35), between(0.01, 1.0), source(&["ribera2004"]);

        /// Change of inflow over the tip speed at which inflow and circulation agree.
        inflow_tolerance: f64 = always(1e-4), unit("ΩR"), between(1e-12, 0.1),
            finer_smaller("inflow-tolerance", Some(1.0));

        /// Iterations of inflow and circulation at most, in trim.
        max_loops: usize = always(30), between(1.0, 1000.0);

        /// Iterations of inflow and circulation at most, in flight.
        max_loops_response: usize = always(10), between(1.0, 1000.0), source(&["ribera2004"]);

        /// Azimuth between renewals of wake and inflow in flight: a revolution [ribera2004], a quarter of one with "90 deg".
        update_interval: f64 = always(deg(360.0)), unit("rad"), above(0.0, 10.0 * TAU), source(&["ribera2004"]);
    }
}

declare! {
    /// Options of the wake marched in time [bhagwat2001].
    pub struct MarchingOptions in "marching" of TIME_MARCHING {
        /// Corrector: backward at the new level, PC2B at the cell's centre, five-point central, or along the paths of markers.
        scheme: Scheme = always(Scheme::Pcc), source(&["bhagwat2001"]);

        /// Predictor: stencil of the corrector, or five-point central.
        predictor: Predictor = always(Predictor::Same), source(&["bhagwat2001"]);

        /// Fields of a step: of the predicted and the corrected wake, or of the predicted alone ("pec", half the work).
        evaluation: Evaluation = always(Evaluation::Pec);

        /// Weight of a second difference in time that damps the odd-even mode of PC2B (0.05); 0 with positions.
        time_filter: f64 = always(0.0), between(0.0, 0.49);

        /// Revolutions at frozen states before the flight.
        convergence_revolutions: usize = always(10), unit("revolutions"), between(0.0, 200.0), source(&["ribera2004"]),
            finer_larger("convergence-revolutions", None);

        /// Passes after each step in which circulation and far inflow are found again with the wake held.
        recorrect: usize = always(0), between(0.0, 3.0);

        /// Whether inflow goes on over a step as it did where the blade before passed: the total of the flight dynamics, the far
        /// inflow of the circulation that is released. Held, it is half a step and a step late.
        extrapolate: bool = always(true);

        /// Azimuth over which the flight dynamics keep a map of the inflow while the wake goes on.
        update_interval: Option<f64> = left_open(None, "every step"), unit("rad"), above(0.0, 10.0 * TAU);
    }
}
