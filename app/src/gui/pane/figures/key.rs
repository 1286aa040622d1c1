//! Whose curves a plot shows: beside it, so that no curve lies behind their names.

use egui::{Label, RichText, ScrollArea, Sense, Shape, Stroke, Ui, Visuals, pos2, vec2};
use egui_plot::LineStyle;

use super::copy::{Curve, Sheet};
use super::named;

/// Width of the key, and of a line in it \[points\].
const WIDE: f32 = 132.0;
const SAMPLE: f32 = 24.0;
/// A narrower pane has the key above the plot \[points\].
const NARROW: f32 = 380.0;

/// A plot and its key; `title` is what the plot has no room to say.
pub fn beside(ui: &mut Ui, sheet: &Sheet, title: Option<&str>, plot: impl FnOnce(&mut Ui)) {
    if ui.available_width() < NARROW {
        ui.horizontal_wrapped(|ui| entries(ui, sheet, title));
        return plot(ui);
    }
    let size = ui.available_size();
    ui.horizontal_top(|ui| {
        ui.allocate_ui(vec2(size.x - WIDE - ui.spacing().item_spacing.x, size.y), plot);
        ui.allocate_ui(vec2(WIDE, size.y), |ui| {
            ScrollArea::vertical().id_salt("key").auto_shrink(false).show(ui, |ui| {
                ui.vertical(|ui| entries(ui, sheet, title));
            });
        });
    });
}

fn entries(ui: &mut Ui, sheet: &Sheet, title: Option<&str>) {
    (ui.spacing_mut().interact_size.y, ui.spacing_mut().item_spacing.y) = (0.0, 2.0);
    if let Some(title) = title {
        ui.add(Label::new(RichText::new(title).small().weak()).wrap());
    }
    for curve in &sheet.curves {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 6.0;
            let (rect, _) = ui.allocate_exact_size(vec2(SAMPLE, 14.0), Sense::hover());
            let y = rect.center().y;
            ui.painter().extend(sample([rect.left(), rect.right()], y, curve, ui.visuals()));
            ui.add(Label::new(RichText::new(&curve.title).small()).truncate());
        });
    }
}

/// The line as the plot draws it, with two dashes at least.
fn sample([left, right]: [f32; 2], y: f32, curve: &Curve, visuals: &Visuals) -> Vec<Shape> {
    let (ends, stroke) = ([pos2(left, y), pos2(right, y)], Stroke::new(2.0, named::colour(curve.card, visuals)));
    match named::style(curve.card) {
        LineStyle::Solid => vec![Shape::line_segment(ends, stroke)],
        LineStyle::Dashed { length } => Shape::dashed_line(&ends, stroke, length, 0.4 * length),
        LineStyle::Dotted { spacing } => Shape::dotted_line(&ends, stroke.color, spacing, stroke.width),
    }
}
