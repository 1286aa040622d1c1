//! Materials that are dragged from the list to where they are to be.

use egui::{Context, DragAndDrop, Id, LayerId, Order, Rect, Response, Stroke, StrokeKind, Ui, Vec2, vec2};

use super::{Gallery, look, picture};

/// Side of the picture under the pointer \[points\].
const SIDE: f32 = 56.0;

/// What is dragged: the name of a material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaterialName(
    /// In the library.
    pub String,
);

/// Lets a material be dropped on a part of the window, which lights up under it; the one that was dropped.
pub fn accept(ui: &Ui, target: &Response) -> Option<String> {
    if target.dnd_hover_payload::<MaterialName>().is_some() {
        let stroke = Stroke::new(2.0, ui.visuals().selection.stroke.color);
        ui.painter().rect_stroke(target.rect, look::ROUND, stroke, StrokeKind::Inside);
    }
    target.dnd_release_payload::<MaterialName>().map(|dropped| dropped.0.clone())
}

/// The picture of what is dragged, under the pointer.
pub fn show(context: &Context, gallery: &Gallery) {
    let Some(dragged) = DragAndDrop::payload::<MaterialName>(context) else { return };
    let Some(pointer) = context.pointer_interact_pos() else { return };
    let mut painter = context.layer_painter(LayerId::new(Order::Tooltip, Id::unique("dragged material")));
    let rect = Rect::from_center_size(pointer + vec2(0.0, 4.0), Vec2::splat(SIDE));
    painter.set_opacity(0.88);
    picture::ball(&painter, gallery.thumbnail(&dragged.0), rect, &context.global_style().visuals);
}
