//! Options of the inflow models, each declared once in [`declared`]; rules between them in [`rules`].

mod declared;
pub mod describe;
mod rotor;
mod rules;

pub use declared::{MarchingOptions, RelaxationOptions, WakeOptions};
pub use describe::{Descriptor, EVERY_MODEL, FREE_WAKES, Kind, Model, Plain, Start, Told, Value, Word};
pub use rotor::WakeRotor;
pub use rules::OUTER_END;
