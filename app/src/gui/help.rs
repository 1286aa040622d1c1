//! All keys, over the window.

use egui::{Align2, Context, Grid, RichText, Window, vec2};

use super::action::Action;

/// Keys that belong to a part of the window rather than to the whole.
const LOCAL: &[(&str, &str)] = &[
    ("Left, right", "To the mark before or after on the path"),
    ("Home, End", "To the first or last material"),
    ("A, B", "Put the material in focus at A or B"),
    ("C", "Hold to see the second picture while flickering"),
    ("Alt or Ctrl, click", "Pick a point on a sphere"),
    ("Wheel, pinch", "Zoom pictures about the pointer; a double click shows all again"),
    ("Shift + drag", "Move what pictures show, as other buttons do; a plain drag moves the light"),
    ("Tab", "To the next thing that takes keys"),
    ("Ctrl+V", "Open the code on the clipboard as a material"),
    ("Esc", "Close what is in front"),
    ("Alt + drag", "Explore the latent map"),
];

/// One frame; whether it stays open.
pub fn show(context: &Context) -> bool {
    let mut is_open = true;
    let window = Window::new("Keys").collapsible(false).resizable(false).open(&mut is_open);
    window.anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0)).show(context, |ui| {
        Grid::new("keys").num_columns(2).spacing(vec2(28.0, 6.0)).show(ui, |ui| {
            let actions = Action::ALL.iter().filter(|action| !action.keys().is_empty());
            let own = actions.map(|action| (action.shown_key(context), action.title()));
            for (key, title) in own.chain(LOCAL.iter().map(|(key, title)| ((*key).to_owned(), *title))) {
                ui.label(RichText::new(key).monospace().strong());
                ui.label(title);
                ui.end_row();
            }
        });
    });
    is_open
}
