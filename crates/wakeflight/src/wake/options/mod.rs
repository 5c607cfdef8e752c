//! Options of the inflow models, each declared once in [`declared`]; rules between them in [`rules`].

mod declared;
pub mod describe;
mod rotor;
mod rules;

pub use declared::{MarchingOptions, RelaxationOptions, WakeOptions};
pub use describe::{
    Descriptor, EVERY_MODEL, FLOWN, FREE_WAKES, Kind, Model, Plain, Start, Told, Value, Word,
};
pub use rotor::WakeRotor;
pub use rules::OUTER_END;

/// Options with their rotor, for state that is kept: typed options come without it.
pub(crate) mod whole {
    use super::{WakeOptions, WakeRotor};
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(crate) fn serialize<S: Serializer>(options: &WakeOptions, to: S) -> Result<S::Ok, S::Error> {
        (options, options.rotor).serialize(to)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<WakeOptions, D::Error> {
        let (options, rotor) = <(WakeOptions, WakeRotor)>::deserialize(from)?;
        Ok(WakeOptions { rotor, ..options })
    }
}
