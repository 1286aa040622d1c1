//! Curves over an angle.

use super::copy::{Curve, Sheet};
use super::named;
use crate::gui::Session;
use crate::gui::session::{Channel, Figure};
use crate::worker::Profile;

/// The chosen channel of everything that is shown.
pub fn sheet(session: &Session, profiles: &[Profile]) -> Sheet {
    let choice = &session.figures;
    let shown = profiles.iter().filter(|profile| named::is_shown(profile.card, session));
    let curves = shown.map(|Profile { card, points }| {
        let points = points.iter().map(|(angle, value)| [f64::from(*angle), choice.channel.of(*value)]);
        let points = points.filter(|[_, value]| value.is_finite()).collect();
        Curve { card: *card, title: session.title(*card), points }
    });
    let of = match choice.channel {
        Channel::Luminance => "luminance",
        Channel::Red => "red",
        Channel::Green => "green",
        Channel::Blue => "blue",
    };
    let (x, y) = match choice.figure {
        Figure::Half => ("θ_half [°]", format!("f_r, {of} [1/sr]")),
        Figure::Albedo => ("θ_o [°]", format!("directional albedo, {of}")),
        _ => ("θ_o [°]", format!("f_r, {of} [1/sr]")),
    };
    Sheet::of_curves(x, &y, curves.collect())
}
