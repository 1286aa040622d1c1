//! What can be done with a material of the list, in a row or in the grid.

use egui::{Key, Response, Ui};

use crate::gui::drag::MaterialName;
use crate::gui::session::letter;
use crate::gui::{Gallery, Session, put};

/// Click, keys, drag and menu.
pub fn interact(ui: &Ui, session: &mut Session, gallery: &Gallery, entry: &Response, name: &str) {
    entry.dnd_set_drag_payload(MaterialName(name.to_owned()));
    let (shift, is_starred) =
        ui.input(|input| (input.modifiers.shift, input.modifiers.is_none() && input.key_pressed(Key::S)));
    if entry.clicked() {
        session.blend.choose(usize::from(shift), name);
    }
    put::by_letter(ui, entry, &mut session.blend, name);
    if entry.has_focus() && is_starred {
        session.listing.toggle_favourite(name);
    }
    entry.context_menu(|ui| menu(ui, session, gallery, name));
}

/// In which slots it is, as the second part of its tooltip.
pub fn whereabouts(slots: &[usize]) -> String {
    let letters: Vec<String> = slots.iter().map(|&slot| letter(slot).to_string()).collect();
    if letters.is_empty() { String::new() } else { format!(" is at {}", letters.join(", ")) }
}

fn menu(ui: &mut Ui, session: &mut Session, gallery: &Gallery, name: &str) {
    for end in 0..session.blend.ends.len() {
        if ui.button(format!("Put at {}", letter(end))).clicked() {
            session.blend.choose(end, name);
        }
    }
    let is_favourite = session.listing.favourites.contains(name);
    if ui.button(if is_favourite { "No favourite any more" } else { "Make a favourite" }).clicked() {
        session.listing.toggle_favourite(name);
    }
    if session.pasted.has(name) {
        let button = ui.button("Do not keep its code");
        if button.on_hover_text("It stays in the list until the end of this session").clicked() {
            session.pasted.forget(|code| code.name == name);
        }
    }
    let Some(source) = gallery.sources.get(name).filter(|source| session.files.contains(source)) else { return };
    let button = ui.button("Do not open its file again").on_hover_text(source.display().to_string());
    if button.on_hover_text("It stays in the list until the end of this session").clicked() {
        session.lose_file(source);
    }
}
