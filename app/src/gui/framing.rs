//! Zooming pictures by pointer and keys, and moving them by pointer; all pictures show the same part.

use egui::{CursorIcon, PointerButton, Pos2, Rect, Response, Ui, Vec2};
use nbrdf_core::render::Frame;

use super::travel;

/// Points of the wheel that double the size.
const DOUBLES: f32 = 240.0;

/// What the pointer does to the frame over a picture; whether it is a drag that is not the light's.
pub fn change(ui: &Ui, frame: &mut Frame, picture: &Response) -> bool {
    let rect = picture.rect;
    if let Some(pointer) = picture.hover_pos() {
        let factor = ui.input_mut(|input| {
            // Whatever is scrolled around the picture stays where it is.
            let turned = std::mem::take(&mut input.smooth_scroll_delta).y;
            f64::from((turned / DOUBLES).exp2() * input.zoom_delta())
        });
        if factor != 1.0 && factor.is_finite() {
            *frame = frame.zoomed(factor, place(rect, pointer));
        }
    }
    if let Some(factor) = travel::zoom(ui, picture) {
        *frame = frame.zoomed(factor.into(), [0.0; 2]);
    }
    if travel::is_home(ui, picture) {
        *frame = Frame::WHOLE;
    }
    // Of what picks, the second click is another place.
    if picture.double_clicked() && !ui.input(|input| input.modifiers.alt || input.modifiers.command) {
        *frame = Frame::WHOLE;
    }
    let is_other = picture.dragged_by(PointerButton::Secondary) || picture.dragged_by(PointerButton::Middle);
    let is_moved = is_other || (picture.dragged() && ui.input(|input| input.modifiers.shift));
    if is_moved {
        let Vec2 { x, y } = picture.drag_delta() * 2.0 / rect.width();
        *frame = frame.dragged([f64::from(x), f64::from(-y)]);
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
    }
    is_moved
}

/// \[across, up\] in −1..1.
fn place(rect: Rect, pointer: Pos2) -> [f64; 2] {
    let from_middle = (pointer - rect.center()) * 2.0 / rect.width();
    [f64::from(from_middle.x), f64::from(-from_middle.y)]
}
