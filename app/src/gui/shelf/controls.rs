//! Open, filter, sort, and rows or pictures: in one line, as narrow as the library may be.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Button, PopupCloseBehavior, RichText, ScrollArea, Ui};
use nbrdf_core::Database;
use nbrdf_core::class::Class;

use super::{Errand, Opener};
use crate::gui::action::Action;
use crate::gui::session::{Listing, Sort};

/// The line of buttons.
pub fn show(ui: &mut Ui, listing: &mut Listing, opener: &mut Opener, errands: &mut Vec<Errand>) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        ui.spacing_mut().button_padding.x = 5.0;
        let about = format!(
            "Networks, libraries, codes, measurements and maps ({}); files can be dropped on the window, too",
            Action::Open.shown_key(ui.ctx())
        );
        if ui.button("Open…").on_hover_text(about).clicked() {
            opener.begin();
            errands.push(Errand::Choose);
        }
        let (button, _) = menu("Filter", listing.is_filtered()).ui(ui, |ui| filter(ui, listing));
        button.on_hover_text("Which materials are listed: by kind, database, favourites");
        let (button, _) = menu("Sort", listing.sort != Sort::default()).ui(ui, |ui| sort(ui, listing));
        button.on_hover_text(format!("Sorted by: {}", listing.sort.title()));
        ui.toggle_value(&mut listing.is_grid, "Grid").on_hover_text("Pictures alone, names on hover");
    });
}

/// One that stays open while it is clicked in, and is marked where it changes the list.
fn menu(face: &'static str, is_used: bool) -> MenuButton<'static> {
    let stays = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    MenuButton::from_button(Button::new(face).selected(is_used)).config(stays)
}

fn filter(ui: &mut Ui, listing: &mut Listing) {
    ScrollArea::vertical().max_height(420.0).show(ui, |ui| {
        ui.set_min_width(150.0);
        // So that all of it is seen without scrolling in a small window.
        (ui.spacing_mut().interact_size.y, ui.spacing_mut().item_spacing.y) = (18.0, 2.0);
        ui.checkbox(&mut listing.is_favourites, "Favourites only");
        ui.label(RichText::new("Database").small().weak());
        for (database, name, about) in [
            (None, "All", "From everywhere"),
            (Some(Database::Merl), "MERL", "The 100 of the MERL database"),
            (Some(Database::Rgl), "RGL", "Those of the RGL database"),
            (Some(Database::Other), "Own", "From files that were opened"),
        ] {
            ui.radio_value(&mut listing.database, database, name).on_hover_text(about);
        }
        ui.label(RichText::new("Kind").small().weak());
        ui.radio_value(&mut listing.class, None, "Any kind");
        for class in Class::ALL {
            ui.radio_value(&mut listing.class, Some(class), class.title()).on_hover_text("Told by the name");
        }
        if ui.add_enabled(listing.is_filtered(), Button::new("Clear filter")).clicked() {
            listing.clear_filters();
        }
    });
}

fn sort(ui: &mut Ui, listing: &mut Listing) {
    for sort in Sort::ALL {
        ui.radio_value(&mut listing.sort, sort, sort.title()).on_hover_text(sort.about());
    }
    ui.separator();
    ui.checkbox(&mut listing.is_descending, "Descending").on_hover_text("Largest first, or from Z to A");
}
