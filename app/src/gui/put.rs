//! Letters that put the material in focus at a slot.

use egui::{Context, Id, Key, Response, Ui};

use super::session::{Blend, MOST_ENDS};

/// Of the slots, from the first.
const LETTERS: [Key; MOST_ENDS] = [Key::A, Key::B, Key::C, Key::D, Key::E, Key::F];

/// Puts a material at the slot whose letter is pressed while it has the focus; a letter beyond the last adds one.
pub fn by_letter(ui: &Ui, part: &Response, blend: &mut Blend, name: &str) {
    if !part.has_focus() {
        return;
    }
    ui.data_mut(|data| data.insert_temp(last(), part.id));
    let is_pressed = |key: &Key| ui.input(|input| input.modifiers.is_none() && input.key_pressed(*key));
    if let Some(slot) = LETTERS.iter().position(is_pressed) {
        blend.choose(slot, name);
    }
}

/// Whether a key is left to a material that has the focus.
pub fn takes(context: &Context, key: Key) -> bool {
    let is_focused = || {
        let material = context.data(|data| data.get_temp::<Id>(last()));
        material.is_some() && context.memory(|memory| memory.focused()) == material
    };
    LETTERS.contains(&key) && is_focused()
}

/// Where the material that had the focus last is remembered.
fn last() -> Id {
    Id::unique("material in focus")
}
