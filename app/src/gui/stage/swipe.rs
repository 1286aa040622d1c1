//! One picture of two spheres: the first left of a divider, the second right of it.

use egui::accesskit::Action;
use egui::{Color32, CursorIcon, EventFilter, Key, Rect, Sense, Stroke, Ui, UiBuilder, WidgetInfo, pos2};

use super::large::{self, Large};
use crate::gui::card;
use crate::gui::session::Compare;

/// How far from the divider it can be grabbed \[points\].
const GRIP: f32 = 8.0;
/// A step of the arrow keys, in widths of the picture.
const STEP: f32 = 0.02;

/// One frame.
pub fn show(ui: &mut Ui, mut large: Large<'_>) {
    let (rect, picture) = large.allocate(ui);
    let is_focused = divide(ui, rect, &mut large.session.compare);
    let x = rect.left() + large.session.compare.divider * rect.width();
    let mut is_shown = true;
    for (place, part) in [rect.with_max_x(x), rect.with_min_x(x)].into_iter().enumerate() {
        let ui = &mut ui.new_child(UiBuilder::new().id_salt(("part", place)).max_rect(rect));
        ui.shrink_clip_rect(part);
        is_shown &= card::picture(ui, rect, large.gallery.view(large.cards[place]));
    }
    if is_shown {
        card::mark(large.session, ui, rect, &picture);
    }
    line(ui, rect, x, is_focused);
    let [first, second] = [0, 1].map(|place| large.name(place));
    let told = large.cards.map(|card| card::told(large.gallery.view(card)));
    large.describe(ui, picture, &format!("Swipe, {first}: {}, {second}: {}", told[0], told[1]));
    large::caption(ui, rect, [&first, &second]);
}

/// The divider as something that is dragged, or moved by keys; whether it has the focus.
fn divide(ui: &Ui, rect: Rect, compare: &mut Compare) -> bool {
    let x = rect.left() + compare.divider * rect.width();
    let grip = Rect::from_x_y_ranges(x - GRIP..=x + GRIP, rect.y_range());
    let mut divider = ui.interact(grip, ui.scope_id().with("divider"), Sense::drag());
    if divider.drag_started() {
        divider.request_focus();
    }
    if divider.dragged()
        && let Some(pointer) = divider.interact_pointer_pos()
    {
        compare.move_to((pointer.x - rect.left()) / rect.width());
        divider.mark_changed();
    }
    let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(divider.id, filter));
    let is_focused = divider.has_focus();
    let (right, left) = ui.input(|input| {
        let asked = |action| input.num_accesskit_action_requests(divider.id, action);
        let pressed = |key| if is_focused { input.num_presses(key) } else { 0 };
        (asked(Action::Increment) + pressed(Key::ArrowRight), asked(Action::Decrement) + pressed(Key::ArrowLeft))
    });
    compare.move_by(STEP * (right as f32 - left as f32));
    divider.widget_info(|| WidgetInfo::slider(true, f64::from(compare.divider), "Divider"));
    divider.on_hover_cursor(CursorIcon::ResizeHorizontal).on_hover_text("Drag, or left and right arrow keys");
    is_focused
}

fn line(ui: &Ui, rect: Rect, x: f32, is_focused: bool) {
    let painter = ui.painter();
    painter.vline(x, rect.y_range(), Stroke::new(3.0, Color32::from_black_alpha(120)));
    painter.vline(x, rect.y_range(), Stroke::new(1.0, Color32::WHITE));
    let knob = pos2(x, rect.bottom() - 14.0);
    painter.circle(knob, 7.0, Color32::WHITE, Stroke::new(1.0, Color32::from_black_alpha(160)));
    if is_focused {
        painter.circle_stroke(knob, 10.0, Stroke::new(1.5, ui.visuals().selection.stroke.color));
    }
}
