//! Two spheres by turns in one place: what differs, blinks.

use std::time::Duration;

use egui::{Key, Ui};

use super::large::{self, Large};
use crate::gui::{Session, card, put};

/// Turns of one sphere: two of them are one of the 2 Hz, below the three flashes a second that may harm.
const TURN: f64 = 0.25;

/// Whether the second sphere is held, by button or by key.
pub fn buttons(ui: &mut Ui, session: &mut Session) -> bool {
    let about = "Shows the second sphere while it is pressed, or while C is";
    let hold = ui.button("Hold to flicker").on_hover_text(about);
    ui.checkbox(&mut session.compare.is_alternating, "2 Hz").on_hover_text("Flickers by itself, twice a second");
    // C is a letter where a text is typed, and a slot where a material has the focus.
    let is_typing = ui.ctx().text_edit_focused() || put::takes(ui.ctx(), Key::C);
    hold.is_pointer_button_down_on()
        || (!is_typing && ui.input(|input| input.key_down(Key::C) && input.modifiers.is_none()))
}

/// One frame; `is_held` shows the second sphere.
pub fn show(ui: &mut Ui, mut large: Large<'_>, is_held: bool) {
    let (rect, picture) = large.allocate(ui);
    let shown = usize::from(is_held || (large.session.compare.is_alternating && is_second(ui)));
    let view = large.gallery.view(large.cards[shown]);
    if card::picture(ui, rect, view) {
        card::mark(large.session, ui, rect, &picture);
    }
    let name = large.name(shown);
    large.describe(ui, picture, &format!("Flicker, {name}: {}", card::told(view)));
    large::caption(ui, rect, if shown == 0 { [&name, ""] } else { ["", &name] });
}

/// Whether it is the second one's turn; wakes at the next.
fn is_second(ui: &Ui) -> bool {
    let turns = ui.input(|input| input.time) / TURN;
    ui.ctx().request_repaint_after(Duration::from_secs_f64(TURN * (1.0 - turns.fract()).clamp(0.0, 1.0)));
    turns.rem_euclid(2.0) >= 1.0
}
