//! Verdicts of all cells at a glance.

use nbrdf_core::stress::{Group, Hazard, Verdict};

use super::saved::Saved;
use crate::measure::stress::Cell;
use crate::report::figure;
use crate::report::svg::grid::{Block, Grid, Spot};

/// Representations above, walks below.
pub(super) fn draw(saved: &Saved) -> Grid {
    let blocks = [("representations", false), ("ways between materials", true)];
    let blocks = blocks.into_iter().filter_map(|(title, is_walk)| block(saved, title, is_walk)).collect();
    let all = saved.cells.len();
    let [holds, refuses, degrades, fails] = Verdict::ALL.map(|verdict| saved.count(verdict));
    let silent = saved.cells.iter().filter(|cell| cell.is_silent()).count();
    Grid {
        title: format!("Where methods fail: {fails} of {all} cells, {silent} of them without a warning"),
        subtitle: format!(
            "{holds} hold, {degrades} degrade, {refuses} refuse with an error; {} held-out materials, {} reference",
            saved.counted.materials, saved.reference
        ),
        kinds: Verdict::ALL.map(|verdict| verdict.name().to_owned()).to_vec(),
        marked: "fails, and says so".to_owned(),
        blocks,
    }
}

fn block(saved: &Saved, title: &str, is_walk: bool) -> Option<Block> {
    let hazards: Vec<&Hazard> =
        saved.hazards().into_iter().filter(|hazard| (hazard.group == Group::Paths) == is_walk).collect();
    let rows: Vec<(String, Vec<Option<Spot>>)> = saved
        .methods(is_walk)
        .into_iter()
        .map(|title| {
            let spots = hazards.iter().map(|hazard| Some(spot(saved.cell(hazard, &title)?, hazard))).collect();
            (title, spots)
        })
        .collect();
    let columns = hazards.iter().map(|hazard| (hazard.name.to_owned(), hazard.group.name().to_owned())).collect();
    (!rows.is_empty()).then(|| Block { title: title.to_owned(), columns, rows })
}

fn spot(cell: &Cell, hazard: &Hazard) -> Spot {
    let value = cell.value.map_or("not a number".to_owned(), figure);
    let worst = cell.worst.first().map_or(String::new(), |worst| format!(", worst {worst}"));
    let told = if cell.warnings.is_empty() { String::new() } else { format!("; says {}", cell.warnings.join(", ")) };
    let what = match cell.verdict {
        Verdict::Refuses => cell.note.clone().unwrap_or_default(),
        _ => format!("{value}{worst}{told}"),
    };
    Spot {
        kind: cell.verdict as usize,
        is_marked: cell.verdict == Verdict::Fails && !cell.warnings.is_empty(),
        about: format!("{}, {}: {} ({what})", cell.title(), hazard.title, cell.verdict.name()),
        link: format!("#{}", hazard.name),
    }
}
