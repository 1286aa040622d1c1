//! The bottom line: what the worker is doing.

use egui::{RichText, Spinner, Ui};

use super::Gallery;

/// The bottom line.
pub struct Status<'a> {
    pub gallery: &'a Gallery,
    pub is_settled: bool,
    /// Whether light comes from all around, which is too grainy for figures.
    pub is_around: bool,
}

impl Status<'_> {
    pub fn show(self, ui: &mut Ui) {
        let Self { gallery, is_settled, is_around } = self;
        let text = match gallery.preparing {
            Some(title) => format!("{title}: preparing the path, learning its basis where it has one"),
            None if !is_settled && is_around => "Rendering, sample after sample".to_owned(),
            None if !is_settled => "Rendering".to_owned(),
            None => "Ready".to_owned(),
        };
        ui.horizontal_centered(|ui| {
            if is_settled {
                ui.add_space(1.0);
            } else {
                ui.add(Spinner::new().size(12.0));
            }
            ui.label(RichText::new(text).small().weak());
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let about = match is_around {
                    true => "Figures need the light Studio or Point",
                    false => "Figures: against the exact linear mix of the ends",
                };
                ui.label(RichText::new(about).small().weak());
            });
        });
    }
}
