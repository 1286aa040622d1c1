//! How much of each material there is at a place in the polygon, to read and to type.

use egui::{DragValue, Sense, Ui, WidgetInfo, vec2};

use crate::gui::look;
use crate::gui::session::{Blend, letter};

pub fn show(ui: &mut Ui, blend: &mut Blend) {
    let weights = blend.weights();
    let mut typed = None;
    ui.horizontal_wrapped(|ui| {
        for (end, weight) in weights.as_slice().iter().enumerate() {
            let (rect, _) = ui.allocate_exact_size(vec2(20.0, 20.0), Sense::hover());
            look::badge(ui.painter(), rect.center(), end, true, ui.visuals());
            let mut percent = 100.0 * weight;
            let field = DragValue::new(&mut percent).range(0.0..=100.0).speed(0.5).fixed_decimals(1).suffix(" %");
            let field = ui.add(field);
            let name = format!("Weight of {}", letter(end));
            field.widget_info(|| WidgetInfo::labeled(egui::Role::SpinButton, true, &name));
            if field.changed() {
                typed = Some((end, percent / 100.0));
            }
            let name = blend.ends.get(end).map_or("", String::as_str);
            field.on_hover_text(format!("Share of {name} in percent; the others share the rest"));
        }
    });
    if let Some((end, share)) = typed {
        blend.weigh(end, share);
    }
}
