//! Qualities that people have words for, moved along codes of likely materials.

use egui::{Label, RichText, Slider, Ui};
use nbrdf_core::axis::Axis;

use crate::catalog::Catalog;
use crate::editor::MOST;
use crate::gui::{Gallery, Session};
use crate::worker::{Card, Measured};

/// A slider for each quality.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery) {
    let measured = session.methods.0.iter().find_map(|&method| Some((method, gallery.measured(Card::Method(method))?)));
    match measured {
        Some((method, _)) => {
            let title = Catalog::interpolation_entry(method).map_or(method, |entry| entry.title);
            let about = "Measured on the sphere of this method. Moved are all methods that walk through codes of ZNBRDF; \
                         film strips, too; figures along t and what is exported along the path are of the path as it is";
            ui.label(RichText::new(format!("of {title}")).small().weak()).on_hover_text(about);
        }
        None => {
            let text = "Show a latent method (menu Methods) to see and move these.";
            ui.add(Label::new(RichText::new(text).small().weak()).wrap());
        }
    }
    let measured = measured.map(|(_, measured)| measured);
    for (axis, amount) in Axis::ALL.into_iter().zip(&mut session.blend.edits) {
        quality(ui, axis, amount, measured);
    }
    for shortfall in measured.iter().flat_map(|measured| &measured.shortfalls) {
        ui.add(Label::new(RichText::new(shortfall).small().color(ui.visuals().warn_fg_color)).wrap());
    }
    let is_edited = session.blend.walk().is_edit();
    let reset = ui.add_enabled(is_edited, egui::Button::new("Reset qualities"));
    if reset.on_hover_text("As the path has them").clicked() {
        session.blend.edits = [0.0; Axis::ALL.len()];
    }
}

fn quality(ui: &mut Ui, axis: Axis, amount: &mut f32, measured: Option<&Measured>) {
    let mut name = axis.name().to_owned();
    name[..1].make_ascii_uppercase();
    let label = ui
        .horizontal(|ui| {
            let label = ui.label(RichText::new(name).weak()).on_hover_text(about(axis));
            let text = measured.map_or("–".to_owned(), |measured| {
                let [before, after] = [&measured.before, &measured.after].map(|qualities| axis.value(qualities));
                if (before - after).abs() < 5e-4 {
                    format!("{before:.3}").replace('-', "−")
                } else {
                    format!("{before:.3} to {after:.3}").replace('-', "−")
                }
            });
            let left_over = egui::Layout::right_to_left(egui::Align::Center);
            ui.with_layout(left_over, |ui| ui.add(Label::new(RichText::new(text).size(12.0)).truncate()));
            label
        })
        .inner;
    ui.horizontal(|ui| {
        ui.spacing_mut().slider_width = (ui.available_width() - 92.0).max(40.0);
        let slider = Slider::new(amount, -MOST..=MOST).step_by(0.01).fixed_decimals(2);
        ui.add(slider).labelled_by(label.id).on_hover_text("How far this quality is moved; 0 leaves it");
        let reset = ui.add_enabled(*amount != 0.0, egui::Button::new("0").small());
        if reset.on_hover_text(format!("Leave {} as it is", axis.name())).clicked() {
            *amount = 0.0;
        }
    });
}

/// What a quality is, and its unit.
const fn about(axis: Axis) -> &'static str {
    match axis {
        Axis::Lightness => "How light from the front: L* / 100, highlight included",
        Axis::Hue => "Angle of the colour in u'v', in turns; grey has none",
        Axis::Chroma => "Distance of the colour from grey, in tenths of u'v'",
        Axis::Gloss => "Strength of the highlight: cube root of its share of the light",
        Axis::Roughness => "Width of the highlight: square root of its half angle, √rad; 0 is a mirror",
        Axis::Metalness => "Share of the highlight in all that is reflected, 0 to 1",
        Axis::Sheen => "Brightening towards grazing angles: ln of the ratio; 0 is matte",
    }
}
