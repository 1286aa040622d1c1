//! Curves over t.

use std::sync::Arc;

use super::copy::{Curve, Sheet};
use super::named;
use crate::gui::Session;
use crate::worker::{Along, Card};

/// The chosen quantity of every method that is shown.
pub fn sheet(session: &Session, walks: &[Arc<Along>]) -> Sheet {
    let quantity = session.figures.quantity;
    let curves = walks.iter().filter_map(|walk| {
        let card = Card::Method(walk.method);
        let points = walk.places.iter().filter_map(|place| quantity.at(place));
        let points = points.filter(|[_, value]| value.is_finite()).collect();
        named::is_shown(card, session).then(|| Curve { card, title: session.title(card), points })
    });
    let (name, unit) = quantity.named();
    Sheet::of_curves("t", &format!("{name} [{unit}]"), curves.collect())
}
