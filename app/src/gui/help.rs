//! All keys, over the window.

use egui::{Align2, Context, Grid, RichText, ScrollArea, Ui, Window, vec2};

use super::action::Action;

/// Keys that belong to a part of the window rather than to the whole.
const LOCAL: &[(&str, &str)] = &[
    ("Left, right", "To the mark before or after on the path"),
    ("Home, End", "To the first or last material"),
    ("A to F", "Put the material in focus at a slot; a letter beyond the last adds one"),
    ("S", "Make the material in focus a favourite, or no longer"),
    ("Left, right on a slot", "To the place before or after; Delete takes it out"),
    ("Arrows on a sphere", "Move the light; the point while one is picked (P)"),
    ("Arrows on the map", "Move the map, or the place that has the focus; in the polygon the place in it"),
    ("Page up, Page down", "Zoom the sphere or the map in focus; Home shows all of it"),
    ("C", "Hold to see the second picture while flickering"),
    ("Alt or Ctrl, click", "Pick a point on a sphere"),
    ("Wheel, pinch", "Zoom pictures about the pointer; a double click shows all again"),
    ("Shift + drag", "Move what pictures show, as other buttons do; a plain drag moves the light"),
    ("Tab", "To the next thing that takes keys"),
    ("Ctrl+V", "Open the code on the clipboard as a material"),
    ("Ctrl + +, −, 0", "Everything larger, smaller, or as at the start"),
    ("Esc", "Close what is in front"),
    ("Alt + drag", "Explore the latent map"),
];

/// Height of a line, and of what is around the list \[points\].
const LINE: f32 = 18.0;
const AROUND: f32 = 90.0;

/// One frame; whether it stays open.
pub fn show(context: &Context) -> bool {
    let mut is_open = true;
    let window = Window::new("Keys").collapsible(false).resizable(false).open(&mut is_open);
    // Title and frame stay in sight, however low the window is.
    let height = (context.content_rect().height() - AROUND).max(LINE);
    window.anchor(Align2::CENTER_CENTER, vec2(0.0, 0.0)).show(context, |ui| {
        ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, |ui| keys(ui, context));
    });
    is_open
}

fn keys(ui: &mut Ui, context: &Context) {
    ui.spacing_mut().interact_size.y = LINE;
    Grid::new("keys").num_columns(2).spacing(vec2(28.0, 4.0)).show(ui, |ui| {
        let actions = Action::ALL.iter().filter(|action| !action.keys().is_empty());
        let own = actions.map(|action| (action.shown_key(context), action.title()));
        for (key, title) in own.chain(LOCAL.iter().map(|(key, title)| ((*key).to_owned(), *title))) {
            ui.label(RichText::new(key).monospace().strong());
            ui.label(title);
            ui.end_row();
        }
    });
}
