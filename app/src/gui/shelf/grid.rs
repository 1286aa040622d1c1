//! Materials as pictures alone.

use egui::{Sense, Ui, Vec2, WidgetInfo, vec2};

use super::{entry, star, value};
use crate::gui::{Gallery, Session, look, picture};

/// Side of a cell, and between two \[points\]: four in a line of the narrowest library.
pub const CELL: f32 = 47.0;
pub const GAP: f32 = 4.0;

/// Cells in a line of this width, one at least.
pub fn columns(width: f32) -> usize {
    (((width + GAP) / (CELL + GAP)).floor() as usize).max(1)
}

/// One line of cells.
pub fn line(ui: &mut Ui, session: &mut Session, gallery: &Gallery, names: &[&str]) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        for name in names {
            ui.push_id(name, |ui| cell(ui, session, gallery, name));
        }
    });
}

fn cell(ui: &mut Ui, session: &mut Session, gallery: &Gallery, name: &str) {
    let (rect, cell) = ui.allocate_exact_size(Vec2::splat(CELL), Sense::click_and_drag());
    let slots = session.blend.slots_of(name);
    cell.widget_info(|| WidgetInfo::selected(egui::Role::ListItem, true, !slots.is_empty(), name));
    let visuals = ui.visuals();
    if !slots.is_empty() || cell.hovered() {
        ui.painter().rect_filled(rect, look::ROUND, visuals.faint_bg_color);
    }
    look::focus(ui.painter(), &cell, visuals);
    picture::ball(ui.painter(), gallery.thumbnail(name), rect.shrink(3.0), visuals);
    for (place, &slot) in slots.iter().rev().enumerate() {
        // From the right, three in a line: all of them stay below the star.
        let [column, line] = [place % 3, place / 3].map(|steps| 16.0 * steps as f32);
        look::badge(ui.painter(), rect.right_bottom() - vec2(9.0 + column, 9.0 + line), slot, true, visuals);
    }
    star::show(ui, &mut session.listing, rect.min, name, cell.contains_pointer() || cell.has_focus());
    let sort = session.listing.sort;
    let value = value(sort, gallery, name).map_or_else(String::new, |value| format!("\n{}", sort.shown(value)));
    let cell = cell.on_hover_text(format!("{name}{}{value}", entry::whereabouts(&slots)));
    entry::interact(ui, session, gallery, &cell, name);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_fill_a_line_and_a_narrow_one_has_one() {
        assert_eq!([20.0, 170.0, 400.0].map(columns), [1, 3, 7]);
    }
}
