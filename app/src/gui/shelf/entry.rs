//! What can be done with a material of the list, in a row or in the grid.

use egui::{Color32, Key, Rect, Response, Ui, pos2};

use crate::gui::drag::MaterialName;
use crate::gui::session::letter;
use crate::gui::{Gallery, Session};

/// Click, keys, drag and menu.
pub fn interact(ui: &Ui, session: &mut Session, gallery: &Gallery, entry: &Response, name: &str) {
    entry.dnd_set_drag_payload(MaterialName(name.to_owned()));
    let (shift, a, b) = ui.input(|input| (input.modifiers.shift, input.key_pressed(Key::A), input.key_pressed(Key::B)));
    if entry.clicked() {
        session.blend.choose(usize::from(shift), name);
    } else if entry.has_focus() && (a || b) {
        session.blend.choose(usize::from(b), name);
    }
    entry.context_menu(|ui| menu(ui, session, gallery, name));
}

/// Its picture, or a place for it.
pub fn picture(ui: &Ui, gallery: &Gallery, name: &str, rect: Rect) {
    match gallery.thumbnail(name) {
        Some(texture) => {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            ui.painter().image(texture.id(), rect, whole, Color32::WHITE);
        }
        None => {
            ui.painter().circle_filled(rect.center(), rect.width() / 2.0, ui.visuals().faint_bg_color);
        }
    }
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
    let Some(source) = gallery.sources.get(name).filter(|source| session.files.contains(source)) else { return };
    let button = ui.button("Do not open its file again").on_hover_text(source.display().to_string());
    if button.on_hover_text("It stays in the list until the end of this session").clicked() {
        session.files.retain(|file| file != source);
    }
}
