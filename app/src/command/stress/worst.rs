//! The worst example of every hazard under which a method fails, each in a file of the hazard's name.

use std::path::Path;

use anyhow::{Context, Result};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use nbrdf_core::atomic;
use nbrdf_core::stress::Verdict;

use super::saved::Saved;
use super::sentences::cells;

/// Writes the pictures.
pub(super) fn draw(folder: &Path, saved: &Saved) -> Result<()> {
    for hazard in saved.hazards() {
        let worst = cells(saved, hazard).into_iter().find(|cell| cell.verdict == Verdict::Fails);
        let Some(picture) = worst.and_then(|cell| cell.picture.as_ref()) else { continue };
        let path = folder.join(format!("{}.png", hazard.name));
        let bytes = STANDARD.decode(picture).context("the picture of a cell")?;
        atomic::write(&path, &bytes).with_context(|| format!("{}: cannot be written", path.display()))?;
    }
    Ok(())
}
