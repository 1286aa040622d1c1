//! How t runs: as the method has it, or evenly for the eye.

use egui::Ui;

use super::keep_together;
use crate::gui::session::Blend;
use crate::worker::Timing;

pub fn show(ui: &mut Ui, blend: &mut Blend) {
    let straight = (Timing::Straight, "Straight", "t runs as the method has it (T)");
    let even =
        (Timing::Even, "Even", "Equal steps of t look equally large, in ΔE_ITP, from each material to the next (T)");
    keep_together(ui);
    for (timing, name, about) in [straight, even] {
        ui.selectable_value(&mut blend.timing, timing, name).on_hover_text(about);
    }
}
