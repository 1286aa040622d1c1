//! What is to be said of the ends, and of the points between them.

use autoencoder::Autoencoder;
use nbrdf_core::Warning;
use nbrdf_core::stress::directions::undecided;

use super::Subject;
use crate::measure::guard;
use crate::worker::Card;

/// A warning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Told {
    /// Of whom.
    pub card: Card,
    /// Its kind, as in reports.
    pub kind: &'static str,
    /// What it says.
    pub text: String,
}

/// All warnings; none at all if something newer came.
pub(super) fn of(subjects: &[Subject], known: &Autoencoder, has_news: &dyn Fn() -> bool) -> Option<Vec<Told>> {
    let mut all = Vec::new();
    for subject in subjects {
        if has_news() {
            return None;
        }
        let card = subject.card;
        let told = warnings(subject, known).into_iter();
        all.extend(told.map(|warning| Told { card, kind: warning.kind(), text: warning.to_string() }));
    }
    Some(all)
}

fn warnings(Subject { brdf, code, on, .. }: &Subject, known: &Autoencoder) -> Vec<Warning> {
    let brdf = brdf.as_ref();
    let of_it = guard::of_reflectance(brdf).into_iter().chain(undecided(brdf));
    let Some((path, weights)) = on else { return guard::of_source(brdf).chain(of_it).collect() };
    // Where the walk has none, the card says so.
    let of_place = path.warnings(weights).unwrap_or_default();
    let of_code = code.as_ref().and_then(|code| guard::of_distance(code, known).ok().flatten());
    of_place.into_iter().chain(of_code).chain(of_it).collect()
}
