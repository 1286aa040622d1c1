//! Image slices side by side.

use egui::{Align2, Color32, FontId, Label, Pos2, Rect, RichText, ScrollArea, Sense, Ui, Vec2, WidgetInfo, pos2, vec2};

use super::named;
use crate::gui::{Gallery, Session, look, picture};
use crate::worker::{Card, Picture};

/// Room for the labels of the axes \[points\].
const MARGIN: f32 = 20.0;
/// Name, angles and the axis' name \[points\].
const LINES: f32 = 46.0;

/// A slice of everything that is shown.
pub fn show(ui: &mut Ui, session: &Session, gallery: &Gallery, slices: &[(Card, Picture)]) {
    let side = (ui.available_height() - LINES - 14.0).clamp(84.0, 260.0);
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            for (card, _) in slices.iter().filter(|(card, _)| named::is_shown(*card, session)) {
                slice(ui, session, gallery, *card, side);
            }
        });
    });
}

fn slice(ui: &mut Ui, session: &Session, gallery: &Gallery, card: Card, side: f32) {
    let title = session.title(card);
    ui.allocate_ui(vec2(side + MARGIN + 6.0, side + LINES), |ui| {
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            let name = RichText::new(&title).small().strong().color(named::colour(card, ui.visuals()));
            ui.add_sized(vec2(side + MARGIN, 14.0), Label::new(name).truncate());
            let (whole, response) = ui.allocate_exact_size(vec2(side + MARGIN, side + MARGIN + 6.0), Sense::hover());
            let rect = Rect::from_min_size(pos2(whole.left() + MARGIN, whole.top()), Vec2::splat(side));
            ui.painter().rect_filled(rect, 2.0, look::card_fill(ui.visuals()));
            if let Some(texture) = gallery.curves.slice(card) {
                picture::whole(ui.painter(), texture, rect, Color32::WHITE);
            }
            axes(ui, rect);
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, format!("Slice of {title}")));
            response.on_hover_ui_at_pointer(|ui| tell(ui, rect));
        });
    });
}

fn axes(ui: &Ui, rect: Rect) {
    let (painter, colour) = (ui.painter(), ui.visuals().weak_text_color());
    let text = |at: Pos2, align: Align2, text: &str| {
        painter.text(at, align, text, FontId::proportional(10.0), colour);
    };
    for (share, angle) in [(0.0, "0°"), (1.0, "90°")] {
        let x = rect.left() + share * rect.width();
        text(pos2(x, rect.bottom() + 2.0), if share > 0.0 { Align2::RIGHT_TOP } else { Align2::LEFT_TOP }, angle);
        let y = rect.bottom() - share * rect.height();
        text(pos2(rect.left() - 2.0, y), if share > 0.0 { Align2::RIGHT_TOP } else { Align2::RIGHT_BOTTOM }, angle);
    }
    text(rect.center_bottom() + vec2(0.0, 2.0), Align2::CENTER_TOP, "θ_half");
    text(rect.left_center() - vec2(2.0, 0.0), Align2::RIGHT_CENTER, "θ_d");
}

/// Which angles are under the pointer.
fn tell(ui: &mut Ui, rect: Rect) {
    let Some(pointer) = ui.input(|input| input.pointer.hover_pos()) else { return };
    let degrees = |share: f32| (90.0 * share).clamp(0.0, 90.0);
    let half = degrees((pointer.x - rect.left()) / rect.width());
    let diff = degrees((rect.bottom() - pointer.y) / rect.height());
    ui.label(format!(
        "θ_half {half:.0}°, θ_diff {diff:.0}°, φ_diff 90°\nπ f_r, white where a white diffuse surface is"
    ));
}
