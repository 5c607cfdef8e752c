//! One blade: properties, beam finite elements, modes, kinematics, loads.
pub mod aerodynamics;
pub mod assembly;
pub mod beam;
pub mod error;
pub mod held_row;
pub mod hermite;
pub mod hinge;
pub mod hub_loads;
pub mod hub_motion;
pub mod inertia;
pub mod jet;
pub mod kinematics;
pub mod loads;
pub mod mass_matrix;
pub mod memory_rows;
pub mod model;
pub mod modes;
pub mod quadrature;
pub mod rigid;
pub mod rigid_body;
pub mod section;
pub mod section_wind;
pub mod sections_in_time;
pub mod stations;
pub mod strain;
pub mod surroundings;
pub mod thin_section;

/// Most modes a blade may keep.
pub const MAX_MODES: usize = 12;
