//! How t runs: as the method has it, or evenly for the eye.

use egui::Ui;

use crate::gui::session::Blend;
use crate::worker::Timing;

pub fn show(ui: &mut Ui, blend: &mut Blend) {
    let straight = (Timing::Straight, "Straight", "t runs as the method has it (T)");
    let even =
        (Timing::Even, "Even", "Equal steps of t look equally large, in ΔE_ITP, from each material to the next (T)");
    let is_reversed = ui.layout().prefer_right_to_left();
    ui.spacing_mut().item_spacing.x = 4.0;
    for (timing, name, about) in if is_reversed { [even, straight] } else { [straight, even] } {
        ui.selectable_value(&mut blend.timing, timing, name).on_hover_text(about);
    }
}
