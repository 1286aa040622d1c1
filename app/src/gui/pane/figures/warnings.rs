//! What is to be said, in words.

use egui::{RichText, ScrollArea, Ui};

use super::copy::Sheet;
use super::named;
use crate::gui::Session;
use crate::worker::Told;

/// Every warning with the name of whom it is of.
pub fn show(ui: &mut Ui, session: &Session, told: &[Told]) {
    let shown: Vec<&Told> = told.iter().filter(|told| named::is_shown(told.card, session)).collect();
    if shown.is_empty() {
        return super::empty(ui, "Nothing to warn of");
    }
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for Told { card, text, .. } in shown {
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing.x = 6.0;
                let colour = named::colour(*card, ui.visuals());
                ui.label(RichText::new(session.title(*card)).strong().color(colour));
                ui.label(text);
            });
        }
    });
}

/// The same as rows.
pub fn sheet(session: &Session, told: &[Told]) -> Sheet {
    let shown = told.iter().filter(|told| named::is_shown(told.card, session));
    let row = |told: &Told| vec![session.title(told.card), told.kind.to_owned(), told.text.clone()];
    Sheet::of_rows(&["of", "kind", "warning"], shown.map(row).collect())
}
