//! The top bar: what is compared, and how the window looks.

use egui::{RichText, ThemePreference, Ui};

use super::Session;
use crate::catalog::INTERPOLATIONS;

/// The top bar.
pub struct Header<'a> {
    pub session: &'a mut Session,
}

impl Header<'_> {
    pub fn show(self, ui: &mut Ui) {
        let Self { session } = self;
        ui.horizontal_centered(|ui| {
            ui.label(RichText::new("nbrdf").heading().strong());
            ui.add_space(4.0);
            ui.label(RichText::new(format!("{}  to  {}", session.ends[0], session.ends[1])).weak());
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                theme(ui, session);
                methods(ui, session);
                let swap = ui.button("Swap").on_hover_text("Exchange A and B; the picture in between stays (X)");
                if swap.clicked() {
                    session.swap();
                }
            });
        });
    }
}

fn theme(ui: &mut Ui, session: &mut Session) {
    let (face, name, other) = if ui.visuals().dark_mode {
        ("Light", "Light theme", ThemePreference::Light)
    } else {
        ("Dark", "Dark theme", ThemePreference::Dark)
    };
    let button = ui.button(face).on_hover_text(name);
    button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
    if button.clicked() {
        session.theme = other;
    }
}

fn methods(ui: &mut Ui, session: &mut Session) {
    ui.menu_button("Methods", |ui| {
        ui.set_min_width(190.0);
        for entry in INTERPOLATIONS {
            let mut is_on = session.methods.contains(&entry.name);
            if ui.checkbox(&mut is_on, entry.title).on_hover_text(entry.about).changed() {
                session.toggle_method(entry.name);
            }
        }
        ui.separator();
        ui.checkbox(&mut session.strips, "Film strips").on_hover_text("Whole paths below the spheres");
    })
    .response
    .on_hover_text("Which ways between the materials are shown");
}
