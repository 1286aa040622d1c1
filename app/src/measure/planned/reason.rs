//! Why an object takes its model.

use nbrdf_core::plan::{By, Choice, Options, Planner, TIE, Tried};

use super::Opened;
use crate::report::figure;

/// Why, in a sentence or two for people.
pub fn reason(opened: &Opened, planner: &Planner, options: Options, object: usize, choice: &Choice) -> String {
    let (ladder, tolerance) = (&opened.ladder, figure(options.tolerance));
    if let Some((rung, error)) = choice.unmet {
        let (closest, error) = (&ladder[rung].name, figure(error));
        return format!(
            "Nothing but the material itself is within {tolerance}; of the others, {closest} comes closest: {error}."
        );
    }
    let least = match options.by {
        By::Time => "Least time",
        By::Bytes => "Fewest bytes",
    };
    let is_cheaper = |rung: usize| cheaper(opened, options.by, rung, choice);
    let missed = planner.tried(object).into_iter().filter(|tried| tried.error > options.tolerance);
    let nearest = missed.filter(|tried| is_cheaper(tried.rung)).min_by(|a, b| a.error.total_cmp(&b.error));
    let rest = match nearest {
        Some(tried) => miss(opened, options, tried),
        None if (0..ladder.len()).any(is_cheaper) => String::new(),
        None => " There is nothing cheaper.".to_owned(),
    };
    format!("{least} of what is within {tolerance}.{rest}")
}

/// Whether a kind of model is expected to be cheaper than what was chosen: in what is to be least, or within a tie in the
/// other.
fn cheaper(opened: &Opened, by: By, rung: usize, choice: &Choice) -> bool {
    let (other, own) = (&opened.ladder[rung], &opened.ladder[choice.rung]);
    // What the material itself costs is known of the object only.
    let (ns, bytes) = if own.is_itself { (choice.ns, choice.bytes) } else { (own.ns, own.bytes) };
    let (ns, bytes) = (other.ns / ns, other.bytes as f64 / bytes.max(1) as f64);
    let (first, second) = if by == By::Time { (ns, bytes) } else { (bytes, ns) };
    !other.is_itself && (first * TIE < 1.0 || (first < TIE && second < 1.0))
}

/// The nearest miss.
fn miss(opened: &Opened, options: Options, tried: Tried) -> String {
    let name = &opened.ladder[tried.rung].name;
    let about = if tried.is_estimate { "about " } else { "" };
    let times = tried.error / options.tolerance;
    format!(
        " Of what is cheaper, {name} comes closest: {about}{}, {times:.2} times the tolerance.",
        figure(tried.error)
    )
}
