//! Free vortex wake: tip vortices or the full span, near wake, relaxation and time marching.
//!
//! Everything that crosses the border is SI, in the hub frame `_h` (x aft, y right, z up, non-rotating, origin at the hub).

pub mod airframe;
pub mod choices;
pub mod circulation;
mod continuation;
pub mod error;
mod far_cylinder;
mod far_wake;
pub mod filament;
pub mod geometry;
pub mod ground;
pub mod inboard_sheet;
pub mod influence;
pub mod initial;
pub mod instant;
pub mod lattice;
pub mod lifting_surface;
mod marker_velocity;
pub mod miss_distance;
pub mod motion;
pub mod near_wake;
pub mod options;
pub mod relaxation;
mod sink;
mod sources;
mod spheroid;
pub mod stencils;
pub mod time_marching;
pub mod tip_strength;
pub mod trailers;
mod vectors;
pub mod velocity_field;

pub use airframe::{AirframeInWake, AtParts};
pub use choices::{
    BladeModel, CoreDistance, Evaluation, FarWake, Form, FuselageUpwash, InboardWake, Precision, Predictor,
    Scheme, ShedWake, Summation, TipStrength, Trailers, Wash,
};
pub use circulation::{CirculationSolution, Route, solve_circulation};
pub use error::WakeError;
pub use ground::Plane;
pub use lifting_surface::weissinger_matrix;
pub use motion::{BladeState, HubMotion};
pub use near_wake::near_wake_matrix;
pub use options::{MarchingOptions, RelaxationOptions, WakeOptions, WakeRotor};
pub use relaxation::{Norms, RelaxationWake, tip_rows};
pub use spheroid::Spheroid;
pub use time_marching::{StepReport, TimeMarchingWake};
pub use velocity_field::{InducedVelocity, Induction, LinearField, Prescribed, VortexSegments};
