//! The report for people, on a terminal.

use std::path::Path;

use nbrdf_core::stress::{Group, Verdict};

use super::saved::Saved;
use super::sentences::{cells, sentence};
use crate::report::table::Table;

/// One line for each hazard, then what happens under each.
pub(super) fn text(saved: &Saved, page: &Path) -> String {
    let mut table = Table::new(
        ["hazard", "methods", "hold", "degrade", "refuse", "fail", "fail silently"].map(str::to_owned).to_vec(),
    );
    let mut lines = Vec::new();
    for group in Group::ALL {
        for hazard in saved.hazards().into_iter().filter(|hazard| hazard.group == group) {
            let cells = cells(saved, hazard);
            let count = |verdict| cells.iter().filter(|cell| cell.verdict == verdict).count();
            let silent = cells.iter().filter(|cell| cell.is_silent()).count();
            let verdicts = [Verdict::Holds, Verdict::Degrades, Verdict::Refuses, Verdict::Fails].map(count);
            let figures = std::iter::once(cells.len()).chain(verdicts).chain([silent]).map(|n| n.to_string());
            table.push(std::iter::once(hazard.name.to_owned()).chain(figures).collect());
            lines.push(format!("{}: {}", hazard.title, sentence(saved, hazard)));
        }
    }
    let materials = format!("{} held-out materials, {} reference", saved.counted.materials, saved.reference);
    format!("{materials}\n\n{table}\n{}\n\nworst examples in {}\n", lines.join("\n"), page.display())
}
