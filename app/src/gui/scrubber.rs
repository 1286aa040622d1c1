//! The slider from the first material to the last, with a mark at every sixteenth.

use egui::{
    Align2, EventFilter, FontId, Id, Key, Mesh, Rangef, Rect, Response, Sense, Shape, Stroke, Ui, WidgetInfo,
    accesskit::Action, pos2, vec2,
};

use super::session::{Blend, TICKS};
use super::{Session, look};

const HEIGHT: f32 = 34.0;
/// From the rims to the ends of the rail: a share of the width, within bounds \[points\].
const INSET: (f32, [f32; 2]) = (0.045, [34.0, 64.0]);
/// From the ends of the rail to their badges \[points\].
const BADGE: f32 = 24.0;

/// The slider's own id: keys that are its own even without focus ask for it.
pub fn id() -> Id {
    Id::unique("scrubber")
}

/// The slider.
pub struct Scrubber<'a> {
    pub session: &'a mut Session,
}

impl Scrubber<'_> {
    /// Where the rail lies from left to right: lowest and highest t.
    pub fn show(self, ui: &mut Ui) -> Rangef {
        let Self { session } = self;
        let (_, rect) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
        let mut scrubber = ui.interact(rect, id(), Sense::click_and_drag());
        let inset = (INSET.0 * rect.width()).clamp(INSET.1[0], INSET.1[1]);
        let rail = rect.shrink2(vec2(inset, 0.0));
        if (scrubber.dragged() || scrubber.clicked())
            && let Some(pointer) = scrubber.interact_pointer_pos()
        {
            scrubber.request_focus();
            let [low, high] = session.blend.range();
            let t = low + (high - low) * (pointer.x - rail.left()) / rail.width();
            // A click on a badge goes to its material.
            let near = 9.0 * (high - low) / rail.width();
            let mut keys = (0..session.blend.ends.len()).map(|end| session.blend.key(end));
            let key = keys.find(|key| scrubber.clicked() && (key - t).abs() <= near);
            session.blend.go_to(key.unwrap_or(t));
            scrubber.mark_changed();
        }
        keys(ui, &scrubber, session);
        scrubber.widget_info(|| WidgetInfo::slider(true, f64::from(session.blend.t), "t, from A to B"));
        paint(ui, rect, rail, &scrubber, &session.blend);
        scrubber
            .on_hover_text("t: drag, or left and right arrow keys; Home and End go to the first and the last material");
        rail.x_range()
    }
}

fn keys(ui: &Ui, scrubber: &Response, session: &mut Session) {
    let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(scrubber.id, filter));
    let (up, down) = ui.input(|input| {
        let asked = |action| input.num_accesskit_action_requests(scrubber.id, action);
        (asked(Action::Increment), asked(Action::Decrement))
    });
    (0..up).for_each(|_| session.blend.step(1));
    (0..down).for_each(|_| session.blend.step(-1));
    // With nothing in focus the arrows are the scrubber's too.
    if !scrubber.has_focus() && ui.memory(|memory| memory.focused().is_some()) {
        return;
    }
    let pressed = |key| ui.input(|input| input.num_presses(key));
    (0..pressed(Key::ArrowRight)).for_each(|_| session.blend.step(1));
    (0..pressed(Key::ArrowLeft)).for_each(|_| session.blend.step(-1));
    if pressed(Key::Home) > 0 {
        session.blend.go_to(0.0);
    }
    if pressed(Key::End) > 0 {
        session.blend.go_to(1.0);
    }
}

fn paint(ui: &Ui, rect: Rect, rail: Rect, scrubber: &Response, blend: &Blend) {
    let (painter, visuals) = (ui.painter(), ui.visuals());
    let [low, high] = blend.range();
    let (y, x) = (rect.top() + 13.0, |t: f32| rail.left() + (t - low) / (high - low) * rail.width());
    let last = blend.ends.len() - 1;
    let quiet = visuals.weak_text_color();
    for tick in 0..=TICKS {
        let long = if tick % (TICKS / 4) == 0 { 7.0 } else { 4.0 };
        let at = x(f32::from(tick) / f32::from(TICKS));
        painter.vline(at, y + 9.0..=y + 9.0 + long, Stroke::new(1.0, quiet.gamma_multiply(0.7)));
    }
    if blend.is_beyond {
        beyond(ui, [rail.left(), x(0.0)], y);
        beyond(ui, [x(1.0), rail.right()], y);
    }
    let mut bar = Mesh::default();
    for end in 0..=last {
        let (colour, at) = (look::accent(end, visuals), x(end as f32 / last as f32));
        bar.colored_vertex(pos2(at, y - 2.0), colour);
        bar.colored_vertex(pos2(at, y + 2.0), colour);
        if end > 0 {
            let first = 2 * end as u32 - 2;
            bar.add_triangle(first, first + 1, first + 2);
            bar.add_triangle(first + 1, first + 2, first + 3);
        }
    }
    painter.add(bar);
    for end in 0..=last {
        // At the rims beside the rail; keys in between, and ends that are gone beyond, on it.
        let at = match end {
            0 if !blend.is_beyond => rail.left() - BADGE,
            _ if end == last && !blend.is_beyond => rail.right() + BADGE,
            _ => x(end as f32 / last as f32),
        };
        look::badge(painter, pos2(at, y), end, true, visuals);
    }
    let lit = scrubber.hovered() || scrubber.dragged();
    let colour = if blend.is_outside() { visuals.warn_fg_color } else { visuals.text_color() };
    painter.circle_filled(pos2(x(blend.t), y), if lit { 10.0 } else { 9.0 }, colour);
    if scrubber.has_focus() {
        painter.circle_stroke(pos2(x(blend.t), y), 12.5, Stroke::new(1.5, visuals.selection.stroke.color));
    }
    let text = FontId::proportional(10.5);
    for (t, name) in [(0.0, "0"), (0.25, "¼"), (0.5, "½"), (0.75, "¾"), (1.0, "1")] {
        painter.text(pos2(x(t) + 5.0, rect.bottom() - 5.0), Align2::LEFT_CENTER, name, text.clone(), quiet);
    }
}

/// Dashes: what lies here is more than a mixture.
fn beyond(ui: &Ui, [left, right]: [f32; 2], y: f32) {
    let stroke = Stroke::new(2.0, ui.visuals().warn_fg_color.gamma_multiply(0.7));
    ui.painter().extend(Shape::dashed_line(&[pos2(left, y), pos2(right, y)], stroke, 5.0, 4.0));
}
