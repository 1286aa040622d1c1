//! The top bar: what is compared, and what can be done about it.

use egui::{Button, Label, RichText, Ui};

use super::Session;
use super::action::Action;
use crate::catalog::INTERPOLATIONS;

/// The top bar.
pub struct Header<'a> {
    pub session: &'a mut Session,
    /// Whether there is something to undo, and to redo.
    pub ways: [bool; 2],
}

impl Header<'_> {
    /// What was asked for.
    pub fn show(self, ui: &mut Ui) -> Vec<Action> {
        let Self { session, ways } = self;
        let mut asked = Vec::new();
        ui.horizontal_centered(|ui| {
            ui.label(RichText::new("nbrdf").heading().strong());
            ui.add_space(4.0);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let mut button = |ui: &mut Ui, face: &str, action: Action, is_on: bool| {
                    let about = format!("{}  {}", action.title(), action.shown_key(ui.ctx()));
                    if ui.add_enabled(is_on, Button::new(face)).on_hover_text(about.trim_end()).clicked() {
                        asked.push(action);
                    }
                };
                button(ui, "Help", Action::Help, true);
                button(ui, if ui.visuals().dark_mode { "Light" } else { "Dark" }, Action::Theme, true);
                methods(ui, session);
                button(ui, "Swap", Action::Swap, true);
                button(ui, "Redo", Action::Redo, ways[1]);
                button(ui, "Undo", Action::Undo, ways[0]);
                button(ui, "Export", Action::Export, true);
                button(ui, "Commands", Action::Palette, true);
                ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                    let ends = session.blend.ends.join("  to  ");
                    ui.add(Label::new(RichText::new(ends).weak()).truncate());
                });
            });
        });
        asked
    }
}

fn methods(ui: &mut Ui, session: &mut Session) {
    ui.menu_button("Methods", |ui| {
        ui.set_min_width(190.0);
        for entry in INTERPOLATIONS {
            let mut is_on = session.methods.0.contains(&entry.name);
            if ui.checkbox(&mut is_on, entry.title).on_hover_text(entry.about).changed() {
                session.methods.toggle(entry.name);
            }
        }
    })
    .response
    .on_hover_text("Which ways between the materials are shown");
}
