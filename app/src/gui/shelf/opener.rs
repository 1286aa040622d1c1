//! Where paths are typed or pasted: it works where no dialog does.

use std::path::PathBuf;

use egui::{Key, KeyboardShortcut, Modifiers, RichText, TextEdit, Ui};

/// The field.
#[derive(Default)]
pub struct Opener {
    is_shown: bool,
    is_new: bool,
    text: String,
}

impl Opener {
    /// Shows the field and puts the cursor there.
    pub fn begin(&mut self) {
        (self.is_shown, self.is_new) = (true, true);
    }

    /// The files to open; `failure` says why there is no dialog.
    pub fn show(&mut self, ui: &mut Ui, failure: Option<&str>) -> Vec<PathBuf> {
        if !self.is_shown {
            return Vec::new();
        }
        let hint = match failure {
            Some(why) => format!("{why}: type or paste paths here"),
            None => "Or type or paste paths, one a line".to_owned(),
        };
        let id = ui.scope_id().with("paths");
        let is_entered = ui.memory(|memory| memory.has_focus(id))
            && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Enter));
        let field = TextEdit::multiline(&mut self.text)
            .id(id)
            .hint_text(hint)
            .desired_rows(2)
            .desired_width(f32::INFINITY)
            .return_key(KeyboardShortcut::new(Modifiers::SHIFT, Key::Enter));
        let field = ui.add(field).on_hover_text("Enter opens them, Shift+Enter begins a new line");
        if std::mem::take(&mut self.is_new) {
            field.request_focus();
        }
        let mut is_asked = is_entered;
        ui.horizontal(|ui| {
            let is_any = !paths(&self.text).is_empty();
            is_asked |= ui.add_enabled(is_any, egui::Button::new(RichText::new("Open").small())).clicked();
            self.is_shown &= !ui.small_button("Close").clicked();
        });
        let paths = if is_asked { paths(&self.text) } else { Vec::new() };
        if !paths.is_empty() {
            self.text.clear();
            self.is_shown = false;
        }
        paths
    }
}

/// One path a line, with or without quotes.
fn paths(text: &str) -> Vec<PathBuf> {
    let lines = text.lines().map(|line| line.trim().trim_matches(['"', '\'']));
    lines.filter(|line| !line.is_empty()).map(PathBuf::from).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_line_is_a_path_and_quotes_and_empty_lines_are_none() {
        assert_eq!(paths(" /a/b c.npz \n\n\"/d.csv\"\r\n"), [PathBuf::from("/a/b c.npz"), PathBuf::from("/d.csv")]);
        assert!(paths(" \n ").is_empty());
    }
}
