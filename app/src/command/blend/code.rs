//! The code of a place on the path, for those who go on with it.

use std::path::Path;

use anyhow::{Context, Result};
use nbrdf_core::{Code, Material, atomic};

use super::samples::Sample;
use super::walk::Walked;
use crate::catalog::InterpolationEntry;
use crate::failure::Failure;
use crate::output;

/// Refuses a code of several places or several methods, and one that cannot be written or would replace an end.
pub(super) fn check(path: &Path, ends: &[String], methods: &[&InterpolationEntry], samples: &[Sample]) -> Result<()> {
    output::check(path, &["json"])?;
    output::check_no_input(path, ends)?;
    match (methods.len(), samples.len()) {
        (1, 1) => Ok(()),
        (methods, places) => {
            let found = format!(
                "--code: expected one method and one place, as in --method latent --at 0.5, found {methods} and {places}"
            );
            Err(Failure::Usage(found).into())
        }
    }
}

/// Writes the code of the first place of a walk.
pub(super) fn write(
    path: &Path,
    entry: &InterpolationEntry,
    walked: &Walked,
    ends: &[Material],
    samples: &[Sample],
) -> Result<()> {
    let (Some(Some(code)), Some(sample)) = (walked.codes.first(), samples.first()) else {
        let said = format!("--code: {} walks through no codes: expected a method such as latent", entry.name);
        return Err(Failure::Usage(said).into());
    };
    let names: Vec<&str> = ends.iter().map(|end| end.name.as_str()).collect();
    let material = Some(format!("{} at {}", names.join(" to "), sample.label));
    let distance = walked.distances.as_ref().and_then(|distances| distances.first().copied());
    let json = serde_json::to_string(&Code { material, distance, ..code.clone() })? + "\n";
    atomic::write(path, json.as_bytes()).with_context(|| format!("{}: cannot be written", path.display()))
}
