//! The instruction set of the vectorised computations: the widest of this machine, or the one that is asked for.

use std::sync::OnceLock;

/// Environment variable that asks for an instruction set; read once, at first use.
pub const SIMD_VARIABLE: &str = "WAKEFLIGHT_SIMD";

/// Lanes that vectorised computations run in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InstructionSet {
    /// One number at a time.
    Scalar,
    /// AVX2 with FMA; NEON on ARM, SIMD128 on WebAssembly.
    Vector,
    /// AVX-512.
    Avx512,
}

/// An instruction set that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{SIMD_VARIABLE} = {value}: {}, allowed are {}", if *known { "not on this machine" } else { "no such instruction set" }, names())]
pub struct InstructionSetError {
    /// What was asked for.
    pub value: String,
    /// Whether it exists elsewhere.
    pub known: bool,
}

/// Name of the vectors of middle width, where this architecture has them.
const VECTOR: &str = if cfg!(target_arch = "aarch64") {
    "neon"
} else if cfg!(target_arch = "wasm32") {
    "simd128"
} else {
    "avx2"
};

/// What this machine has, by name.
fn names() -> String {
    let available = InstructionSet::ALL.iter().filter(|set| set.available());
    available.map(|set| set.name()).collect::<Vec<_>>().join(", ")
}

impl InstructionSet {
    /// Every instruction set, narrow ones first.
    pub const ALL: [Self; 3] = [Self::Scalar, Self::Vector, Self::Avx512];

    /// Name, as the environment variable takes it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            Self::Vector => VECTOR,
            Self::Avx512 => "avx512",
        }
    }

    /// Whether this machine has it.
    #[must_use]
    pub fn available(self) -> bool {
        match self {
            Self::Scalar => true,
            Self::Vector => machine::vector(),
            Self::Avx512 => machine::avx512(),
        }
    }

    /// The widest of this machine.
    #[must_use]
    pub fn widest() -> Self {
        Self::ALL.into_iter().rev().find(|set| set.available()).unwrap_or(Self::Scalar)
    }

    /// The one that `WAKEFLIGHT_SIMD` asks for, else the widest.
    ///
    /// # Errors
    /// Where the variable names none of this machine.
    pub fn chosen() -> Result<Self, InstructionSetError> {
        static CHOSEN: OnceLock<Result<InstructionSet, InstructionSetError>> = OnceLock::new();
        let asked = || match std::env::var_os(SIMD_VARIABLE) {
            Some(value) => Self::named(&value.to_string_lossy()),
            None => Ok(Self::widest()),
        };
        CHOSEN.get_or_init(asked).clone()
    }

    /// The chosen one; the widest where the choice is in error, which whoever started the program has been told.
    pub(crate) fn in_use() -> Self {
        static IN_USE: OnceLock<InstructionSet> = OnceLock::new();
        *IN_USE.get_or_init(|| Self::chosen().unwrap_or_else(|_| Self::widest()))
    }

    /// The instruction set of that name, if this machine has it.
    fn named(value: &str) -> Result<Self, InstructionSetError> {
        let known = Self::ALL.into_iter().find(|set| set.name() == value.trim());
        match known {
            Some(set) if set.available() => Ok(set),
            _ => Err(InstructionSetError { value: value.to_owned(), known: known.is_some() }),
        }
    }
}

#[cfg(target_arch = "x86_64")]
mod machine {
    use pulp::x86::{V3, V4};

    pub fn vector() -> bool {
        V3::is_available()
    }

    pub fn avx512() -> bool {
        V4::is_available()
    }
}

#[cfg(not(target_arch = "x86_64"))]
mod machine {
    pub fn vector() -> bool {
        cfg!(any(target_arch = "aarch64", target_arch = "wasm32"))
    }

    pub fn avx512() -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::InstructionSet;

    #[test]
    fn a_name_finds_its_instruction_set_or_says_what_there_is() {
        for set in InstructionSet::ALL {
            assert_eq!(InstructionSet::named(set.name()).is_ok(), set.available());
        }
        assert_eq!(InstructionSet::named(" scalar "), Ok(InstructionSet::Scalar));
        let text = InstructionSet::named("mmx").map_err(|e| e.to_string());
        let expected = "WAKEFLIGHT_SIMD = mmx: no such instruction set, allowed are scalar";
        assert!(text.is_err_and(|text| text.starts_with(expected)));
        assert!(InstructionSet::widest().available());
    }
}
