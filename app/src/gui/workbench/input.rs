//! Keys, files that are dropped, and codes that are pasted.

use std::path::PathBuf;

use egui::{Context, Key, Popup, Ui};

use super::Workbench;
use crate::gui::action::Action;

impl Workbench {
    /// What was asked for since the last frame.
    pub(super) fn inputs(&mut self, ui: &Ui) {
        let (seconds, dropped) = ui.input(|input| {
            let dropped: Vec<PathBuf> = input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect();
            (input.stable_dt.min(0.1), dropped)
        });
        self.session.blend.advance(seconds);
        if self.session.blend.playing.is_some() {
            ui.ctx().request_repaint();
        }
        dropped.into_iter().for_each(|path| self.worker.open(path));
        let is_typing = ui.ctx().text_edit_focused() || self.passing.palette.is_some();
        if !is_typing && let Some(text) = pasted(ui) {
            self.worker.open_code(text);
        }
        // An open palette has the keyboard for itself.
        if self.passing.palette.is_none() {
            Action::pressed(ui.ctx()).into_iter().for_each(|action| self.act(action, ui.ctx()));
            self.escape(ui.ctx());
        }
    }

    /// Esc closes what is in front: popups and texts by themselves, then the help, then what is explored.
    fn escape(&mut self, context: &Context) {
        let is_others = self.passing.was_typing || self.passing.exports.is_some() || Popup::is_any_open(context);
        if is_others || !context.input(|input| input.key_pressed(Key::Escape)) {
            return;
        }
        if self.passing.is_helping {
            self.passing.is_helping = false;
        } else {
            self.act(Action::Leave, context);
        }
    }
}

/// Text that was pasted in this frame.
fn pasted(ui: &Ui) -> Option<String> {
    let text = |event: &egui::Event| if let egui::Event::Paste(text) = event { Some(text.clone()) } else { None };
    ui.input(|input| input.events.iter().find_map(text))
}
