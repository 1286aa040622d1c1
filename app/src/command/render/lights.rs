//! The standard lights by their names.

use std::ffi::OsStr;
use std::fmt;

use clap::builder::{EnumValueParser, PossibleValue, TypedValueParser};
use clap::error::{ContextKind, ContextValue};
use clap::{Arg, Command, Error, ValueEnum};
use nbrdf_core::render::{Environment, Light};

/// The standard lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LightName {
    /// One lamp at 45°.
    Point,
    /// Eleven lamps: three keys and a ring of fills.
    Studio,
}

impl LightName {
    /// The light itself.
    pub fn light(self) -> Light {
        match self {
            Self::Point => Light::point(),
            Self::Studio => Light::studio(),
        }
    }
}

impl fmt::Display for LightName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.light().name)
    }
}

/// Reads a light's name; that of an environment brings the switch for those.
#[derive(Clone, Copy, Debug)]
pub struct Lights;

impl TypedValueParser for Lights {
    type Value = LightName;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<LightName, Error> {
        EnumValueParser::new().parse_ref(command, arg, value).map_err(|mut error| {
            if let Some(name) = value.to_str().filter(|name| Environment::NAMES.contains(name)) {
                let tip = format!("'{name}' is light from all around: nbrdf render --environment {name}");
                error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
            }
            error
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(LightName::value_variants().iter().filter_map(ValueEnum::to_possible_value)))
    }
}
