//! How a card is called and drawn in figures.

use egui::{Color32, Visuals};
use egui_plot::LineStyle;

use crate::gui::{Session, look};
use crate::worker::Card;

/// Its colour, the same everywhere.
pub fn colour(card: Card, visuals: &Visuals) -> Color32 {
    match card {
        Card::End(end) => look::accent(end, visuals),
        Card::Method(name) => look::method_colour(name, visuals),
        Card::Explored => visuals.strong_text_color(),
    }
}

/// Its line: ends are dotted.
pub fn style(card: Card) -> LineStyle {
    match card {
        Card::End(_) => LineStyle::dotted_dense(),
        Card::Method(name) if look::is_dashed(name) => LineStyle::dashed_loose(),
        Card::Method(_) | Card::Explored => LineStyle::Solid,
    }
}

/// Whether a card is still shown: answers may be of a moment ago.
pub fn is_shown(card: Card, session: &Session) -> bool {
    match card {
        Card::End(end) => end < session.blend.ends.len(),
        Card::Method(name) => session.methods.0.contains(&name),
        Card::Explored => session.explored.is_some(),
    }
}
