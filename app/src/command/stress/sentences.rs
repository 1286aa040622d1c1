//! The failures of a hazard in one sentence.

use nbrdf_core::stress::{Hazard, Verdict};

use super::saved::Saved;
use crate::measure::stress::Cell;
use crate::report::figure;

/// Methods that are named.
const NAMED: usize = 6;

/// Cells of a hazard, the worst first.
pub(super) fn cells<'a>(saved: &'a Saved, hazard: &Hazard) -> Vec<&'a Cell> {
    let mut cells: Vec<&Cell> = saved.cells.iter().filter(|cell| cell.hazard == hazard.name).collect();
    let badness = |cell: &Cell| cell.value.unwrap_or(f64::INFINITY);
    cells.sort_by(|a, b| b.verdict.cmp(&a.verdict).then(badness(b).total_cmp(&badness(a))));
    cells
}

/// Who fails, by how much and where; or who comes nearest to it.
pub(super) fn sentence(saved: &Saved, hazard: &Hazard) -> String {
    let cells = cells(saved, hazard);
    let failing: Vec<&&Cell> = cells.iter().filter(|cell| cell.verdict == Verdict::Fails).collect();
    let named = |cell: &&&Cell| match cell.value {
        Some(value) => format!("{} ({})", cell.title(), figure(value)),
        None => format!("{} (not a number)", cell.title()),
    };
    let (count, all) = (failing.len(), cells.len());
    if let Some(worst) = failing.first() {
        let names: Vec<String> = failing.iter().take(NAMED).map(named).collect();
        let more = if count > NAMED { format!(" and {} more", count - NAMED) } else { String::new() };
        let example = worst.worst.first().map_or(String::new(), |name| format!("; worst at {name}"));
        return format!("{count} of {all} fail: {}{more}{example}.", names.join(", "));
    }
    match cells.iter().find(|cell| cell.verdict == Verdict::Degrades) {
        Some(cell) => format!("None of {all} fails; {} is worst.", named(&cell)),
        None => format!("All {all} hold or refuse."),
    }
}
