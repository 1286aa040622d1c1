//! Keys of a part of the window that has the focus and a place in it to move.

use egui::{EventFilter, Key, Response, Ui};

/// Steps to the right and upwards that were asked for by arrow keys. While the part has the focus, they do not move that.
pub fn steps(ui: &Ui, part: &Response) -> Option<[f32; 2]> {
    let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(part.id, filter));
    let along = |more, less| pressed(ui, part, more) - pressed(ui, part, less);
    let steps = [along(Key::ArrowRight, Key::ArrowLeft), along(Key::ArrowUp, Key::ArrowDown)];
    (steps != [0.0; 2]).then_some(steps)
}

/// How many times as large: Page up enlarges, Page down makes smaller.
pub fn zoom(ui: &Ui, part: &Response) -> Option<f32> {
    let steps = pressed(ui, part, Key::PageUp) - pressed(ui, part, Key::PageDown);
    (steps != 0.0).then(|| (0.5 * steps).exp2())
}

/// Whether all is to be seen again, or the place is to be as at the start.
pub fn is_home(ui: &Ui, part: &Response) -> bool {
    pressed(ui, part, Key::Home) > 0.0
}

fn pressed(ui: &Ui, part: &Response, key: Key) -> f32 {
    let count = if part.has_focus() { ui.input(|input| input.num_presses(key)) } else { 0 };
    count as f32
}
