//! What is told of an option, once: name, kind, unit, range or words, default, meaning, source, models.
//!
//! `declare!` makes from it the struct that the core computes with, its defaults and its checks, and the descriptors from
//! which everything above the core is made.

use crate::wake::error::WakeError;
use serde::Serialize;

/// Models of the inflow, by the names that users type.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// Free wake marched in time.
    TimeMarching,
    /// Free wake made periodic by relaxation.
    Relaxation,
    /// Three states of the inflow.
    Dynamic,
    /// Momentum ring by ring.
    Annular,
}

/// The models with a free wake.
pub const FREE_WAKES: &[Model] = &[Model::TimeMarching, Model::Relaxation];

/// The wake made periodic by relaxation alone.
pub const RELAXATION: &[Model] = &[Model::Relaxation];

/// The wake marched in time alone.
pub const TIME_MARCHING: &[Model] = &[Model::TimeMarching];

/// Annular momentum alone.
pub const ANNULAR: &[Model] = &[Model::Annular];

/// All of them.
pub const EVERY_MODEL: &[Model] = &[Model::TimeMarching, Model::Relaxation, Model::Dynamic, Model::Annular];

/// Those that a helicopter can fly with.
pub const FLOWN: &[Model] = &[Model::TimeMarching, Model::Relaxation, Model::Dynamic];

/// Kind of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A number; with the unit `rad` an angle.
    Number,
    /// A whole number, not negative.
    Whole,
    /// Yes or no.
    Switch,
    /// One of several words.
    Word,
}

/// A word that can be chosen, and what it means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Word {
    /// The word.
    pub word: &'static str,
    /// What is chosen with it.
    pub meaning: &'static str,
}

/// A value of any kind.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Plain {
    /// Number.
    Number(f64),
    /// Whole number.
    Whole(usize),
    /// Yes or no.
    Switch(bool),
    /// Word.
    Word(&'static str),
    /// Not given.
    Open,
}

/// A type that an option can have.
pub trait Value: Copy {
    /// Its kind.
    const KIND: Kind;
    /// Words to choose from.
    const WORDS: &'static [Word] = &[];
    /// The value without its type.
    fn plain(self) -> Plain;
}

impl Value for f64 {
    const KIND: Kind = Kind::Number;
    fn plain(self) -> Plain {
        Plain::Number(self)
    }
}

impl Value for usize {
    const KIND: Kind = Kind::Whole;
    fn plain(self) -> Plain {
        Plain::Whole(self)
    }
}

impl Value for bool {
    const KIND: Kind = Kind::Switch;
    fn plain(self) -> Plain {
        Plain::Switch(self)
    }
}

impl<T: Value> Value for Option<T> {
    const KIND: Kind = T::KIND;
    const WORDS: &'static [Word] = T::WORDS;
    fn plain(self) -> Plain {
        self.map_or(Plain::Open, T::plain)
    }
}

/// The default as it is told.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Told {
    /// The same always.
    Always(Plain),
    /// By the regime of the rotor.
    ByRegime {
        /// Forward flight.
        forward: Plain,
        /// Low speed.
        slow: Plain,
        /// Hover and climb.
        hover: Plain,
        /// Axial descent.
        descent: Plain,
    },
    /// None: what holds then, in words.
    LeftOpen(&'static str),
}

/// Default of an option: the value the core starts from, and how it is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start<T> {
    /// Value.
    pub value: T,
    /// As it is told.
    pub told: Told,
}

/// The same default always.
pub(crate) fn always<T: Value>(value: T) -> Start<T> {
    Start { value, told: Told::Always(value.plain()) }
}

/// A default for each regime, that of low speed being that of forward flight; the core starts from that of forward flight.
pub(crate) fn by_regime<T: Value>(forward: T, hover: T, descent: T) -> Start<T> {
    let (forward_told, hover, descent) = (forward.plain(), hover.plain(), descent.plain());
    let told = Told::ByRegime { forward: forward_told, slow: forward_told, hover, descent };
    Start { value: forward, told }
}

impl<T: Value> Start<T> {
    /// Another default at low speed, where else that of forward flight holds.
    pub(crate) fn at_low_speed(self, value: T) -> Self {
        let told = match self.told {
            Told::ByRegime { forward, hover, descent, .. } => {
                Told::ByRegime { forward, slow: value.plain(), hover, descent }
            }
            told => told,
        };
        Self { told, ..self }
    }
}

/// No default: what holds then in `words`; the core starts from `value`.
pub(crate) fn left_open<T: Value>(value: T, words: &'static str) -> Start<T> {
    Start { value, told: Told::LeftOpen(words) }
}

/// Range of a number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Range {
    /// Least value.
    pub low: f64,
    /// Largest value.
    pub high: f64,
    /// Whether the least value itself is refused.
    pub above: bool,
}

/// How a discretisation is refined, for studies of convergence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Refinement {
    /// Name in a study.
    pub name: &'static str,
    /// Whether a larger value is finer.
    pub larger: bool,
    /// Order expected in the size; none where none is.
    pub order: Option<f64>,
    /// Whether the number belongs to the physical model, whose ends are different models.
    pub physical: bool,
}

/// Everything that is told of an option.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Descriptor {
    /// Name.
    pub name: &'static str,
    /// Group that the core reads it in.
    pub group: &'static str,
    /// Models that have it.
    pub models: &'static [Model],
    /// Kind of its value.
    pub kind: Kind,
    /// Unit; empty for none.
    pub unit: &'static str,
    /// Range of a number.
    pub range: Option<Range>,
    /// Words to choose from.
    pub words: &'static [Word],
    /// Default.
    pub default: Told,
    /// Default where trailers leave all over the span; none where it is the same.
    pub lattice: Option<Told>,
    /// Whether it acts on a lone tip vortex only: where it is set, trailers that are left open are that.
    pub tip_alone: bool,
    /// Meaning, in a sentence.
    pub meaning: String,
    /// Keys of the bibliography.
    pub sources: &'static [&'static str],
    /// How it is refined, where it is a discretisation.
    pub refinement: Option<Refinement>,
}

impl Descriptor {
    /// An option of type `T`; `lines` are those of its documentation.
    pub(crate) fn new<T: Value>(
        name: &'static str,
        group: &'static str,
        models: &'static [Model],
        lines: &[&str],
        default: Start<T>,
    ) -> Self {
        let meaning = lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ");
        Descriptor {
            name,
            group,
            models,
            kind: T::KIND,
            unit: "",
            range: None,
            words: T::WORDS,
            default: default.told,
            lattice: None,
            tip_alone: false,
            meaning,
            sources: &[],
            refinement: None,
        }
    }

    /// Its unit: `rad`, or what it is a fraction of.
    pub(crate) fn unit(self, unit: &'static str) -> Self {
        Self { unit, ..self }
    }

    /// Another default where trailers leave all over the span.
    pub(crate) fn lattice<T: Value>(self, default: Start<T>) -> Self {
        Self { lattice: Some(default.told), ..self }
    }

    /// Acts where a lone tip vortex leaves the blade.
    pub(crate) fn tip_alone(self) -> Self {
        Self { tip_alone: true, ..self }
    }

    /// Values from `low` to `high`, both allowed.
    pub(crate) fn between(self, low: f64, high: f64) -> Self {
        Self { range: Some(Range { low, high, above: false }), ..self }
    }

    /// Values above `low`, up to `high`.
    pub(crate) fn above(self, low: f64, high: f64) -> Self {
        Self { range: Some(Range { low, high, above: true }), ..self }
    }

    /// Where it comes from: keys of the bibliography.
    pub(crate) fn source(self, sources: &'static [&'static str]) -> Self {
        Self { sources, ..self }
    }

    /// Belongs to `models`, not to those of its group alone.
    pub(crate) fn of(self, models: &'static [Model]) -> Self {
        Self { models, ..self }
    }

    /// A discretisation: larger is finer, with the order expected.
    pub(crate) fn finer_larger(self, name: &'static str, order: Option<f64>) -> Self {
        self.refined(Refinement { name, larger: true, order, physical: false })
    }

    /// A discretisation: smaller is finer, with the order expected.
    pub(crate) fn finer_smaller(self, name: &'static str, order: Option<f64>) -> Self {
        self.refined(Refinement { name, larger: false, order, physical: false })
    }

    /// A number of the physical model that a study varies towards smaller values.
    pub(crate) fn varied(self, name: &'static str) -> Self {
        self.refined(Refinement { name, larger: false, order: None, physical: true })
    }

    fn refined(self, refinement: Refinement) -> Self {
        Self { refinement: Some(refinement), ..self }
    }

    /// Whether `value` lies in the range; words and switches are right by their type.
    pub fn check(&self, value: Plain) -> Result<(), WakeError> {
        let number = match value {
            Plain::Number(number) => number,
            Plain::Whole(number) => number as f64,
            Plain::Switch(_) | Plain::Word(_) | Plain::Open => return Ok(()),
        };
        let Range { low, high, above } =
            self.range.unwrap_or(Range { low: f64::MIN, high: f64::MAX, above: false });
        // an angle that was given in degrees may be off by its rounding
        let high = if self.unit == "rad" { high * (1.0 + 1e-12) } else { high };
        if (low..=high).contains(&number) && !(above && number == low) {
            return Ok(());
        }
        let (scale, unit) = if self.unit == "rad" { (1f64.to_degrees(), " deg") } else { (1.0, "") };
        let told = |v: f64| format!("{}{unit}", short(v * scale));
        let kind = if self.kind == Kind::Whole { "a whole number" } else { "a number" };
        let from = if above { "above" } else { "from" };
        Err(WakeError::InvalidOption {
            field: self.name,
            value: told(number),
            allowed: format!("must be {kind} {from} {} to {}", told(low), told(high)),
        })
    }
}

/// `value` with six significant digits.
pub(crate) fn short(value: f64) -> String {
    format!("{value:.5e}").parse::<f64>().map_or_else(|_| value.to_string(), |rounded| rounded.to_string())
}

/// Words to choose from: an enumeration with the word of each of its members, told with its documentation.
macro_rules! choices {
    ($(#[doc = $about:literal])+ pub enum $name:ident { $(#[doc = $meaning:literal] $member:ident = $word:literal),+ $(,)? }) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, serde::Serialize)]
        pub enum $name {
            $(#[doc = $meaning] #[serde(rename = $word)] $member),+
        }

        impl $name {
            /// All that can be chosen.
            pub const ALL: &'static [Self] = &[$(Self::$member),+];
        }

        impl $crate::wake::options::describe::Value for $name {
            const KIND: $crate::wake::options::describe::Kind = $crate::wake::options::describe::Kind::Word;
            const WORDS: &'static [$crate::wake::options::describe::Word] =
                &[$($crate::wake::options::describe::Word { word: $word, meaning: $meaning.trim_ascii() }),+];
            fn plain(self) -> $crate::wake::options::describe::Plain {
                $crate::wake::options::describe::Plain::Word(match self { $(Self::$member => $word),+ })
            }
        }
    };
}

/// A group of options: a struct with a field for each, its defaults, its descriptors, and the check of its ranges.
///
/// An option is its documentation, its name, type and default, and calls of [`Descriptor`] that tell the rest.
macro_rules! declare {
    (
        $(#[doc = $about:literal])+
        pub struct $name:ident in $group:literal of $models:path
            $(, with $(#[doc = $inner_about:literal])+ $inner:ident: $inner_type:ty)? {
            $(
                $(#[doc = $doc:literal])+
                $field:ident: $type:ty = $default:expr $(, $told:ident($($value:expr),*))*;
            )+
        }
    ) => {
        $(#[doc = $about])+
        #[derive(Clone, Copy, Debug, PartialEq, serde::Deserialize, serde::Serialize)]
        #[serde(deny_unknown_fields, default)]
        pub struct $name {
            $($(#[doc = $inner_about])+ #[serde(skip)] pub $inner: $inner_type,)?
            $($(#[doc = $doc])+ pub $field: $type,)+
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($inner: <$inner_type>::default(),)? $($field: $default.value),+ }
            }
        }

        impl $name {
            /// What is told of its options, in the order of their declaration.
            pub fn descriptors() -> &'static [$crate::wake::options::describe::Descriptor] {
                static TOLD: std::sync::LazyLock<Vec<$crate::wake::options::describe::Descriptor>> =
                    std::sync::LazyLock::new(|| {
                        vec![$(
                            $crate::wake::options::describe::Descriptor::new::<$type>(
                                stringify!($field), $group, $models, &[$($doc),+], $default,
                            )$(.$told($($value),*))*
                        ),+]
                    });
                &TOLD
            }

            /// Checks every value against its range.
            pub fn check(&self) -> Result<(), $crate::wake::error::WakeError> {
                use $crate::wake::options::describe::Value;
                let values = [$(self.$field.plain()),+];
                Self::descriptors().iter().zip(values).try_for_each(|(told, value)| told.check(value))
            }
        }
    };
}

pub(crate) use {choices, declare};
