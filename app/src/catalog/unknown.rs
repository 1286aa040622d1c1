//! Names that are none of those known.

use nbrdf_core::near::near;

use crate::failure::Failure;

/// The failure of a name that is none of those known: the one that comes nearest, and all there are.
pub fn unknown(what: &str, name: &str, known: impl Iterator<Item = &'static str>) -> anyhow::Error {
    let mut names: Vec<&str> = known.collect();
    names.dedup();
    let meant = match near(name, names.iter().copied()).first() {
        Some(nearest) => format!(": did you mean '{nearest}'?"),
        None => ".".to_owned(),
    };
    Failure::Usage(format!("no {what} '{name}'{meant} There are {}", names.join(", "))).into()
}
