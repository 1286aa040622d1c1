//! What went wrong, until it is dismissed.

use egui::{Align, Frame, Layout, Margin, RichText, Stroke, Ui, vec2};

use super::{Gallery, look};

/// The notices.
pub struct Notices<'a> {
    pub gallery: &'a mut Gallery,
}

impl Notices<'_> {
    pub fn show(self, ui: &mut Ui) {
        let colour = ui.visuals().warn_fg_color;
        let frame = Frame::new()
            .inner_margin(Margin::symmetric(12, 6))
            .corner_radius(look::ROUND)
            .fill(colour.gamma_multiply(0.12))
            .stroke(Stroke::new(1.0, colour.gamma_multiply(0.5)));
        // The newest only: notices must not push the spheres off the window.
        let Some(newest) = self.gallery.notices.last() else { return };
        let mut is_dismissed = false;
        frame.show(ui, |ui| {
            // One line at least; a long notice makes it grow, and a short one must not take the whole panel.
            let line = vec2(ui.available_width(), ui.spacing().interact_size.y);
            ui.allocate_ui_with_layout(line, Layout::right_to_left(Align::Center), |ui| {
                is_dismissed = ui.button("Dismiss").clicked();
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                    ui.add(egui::Label::new(RichText::new(newest)).wrap());
                });
            });
        });
        ui.add_space(6.0);
        if is_dismissed {
            self.gallery.notices.pop();
        }
    }
}
