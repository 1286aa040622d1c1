//! The slider from A to B, with a mark at every sixteenth.

use egui::{
    Align2, EventFilter, FontId, Key, Mesh, Rect, Response, Sense, Stroke, Ui, WidgetInfo, accesskit::Action, pos2,
    vec2,
};

use super::session::TICKS;
use super::{End, Session, look};

const HEIGHT: f32 = 34.0;

/// The slider.
pub struct Scrubber<'a> {
    pub session: &'a mut Session,
}

impl Scrubber<'_> {
    pub fn show(self, ui: &mut Ui) -> Response {
        let Self { session } = self;
        let (rect, mut scrubber) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::click_and_drag());
        let rail = Rect::from_min_max(pos2(rect.left() + 34.0, rect.top()), pos2(rect.right() - 34.0, rect.bottom()));
        if (scrubber.dragged() || scrubber.clicked())
            && let Some(pointer) = scrubber.interact_pointer_pos()
        {
            scrubber.request_focus();
            session.go_to((pointer.x - rail.left()) / rail.width());
            scrubber.mark_changed();
        }
        keys(ui, &scrubber, session);
        scrubber.widget_info(|| WidgetInfo::slider(true, f64::from(session.t), "t, from A to B"));
        paint(ui, rect, rail, &scrubber, session.t);
        scrubber.on_hover_text("t: drag, or left and right arrow keys; Home and End go to A and B")
    }
}

fn keys(ui: &Ui, scrubber: &Response, session: &mut Session) {
    let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(scrubber.id, filter));
    let (up, down) = ui.input(|input| {
        let asked = |action| input.num_accesskit_action_requests(scrubber.id, action);
        (asked(Action::Increment), asked(Action::Decrement))
    });
    (0..up).for_each(|_| session.step(1));
    (0..down).for_each(|_| session.step(-1));
    // With nothing in focus the arrows are the scrubber's too.
    if !scrubber.has_focus() && ui.memory(|memory| memory.focused().is_some()) {
        return;
    }
    let pressed = |key| ui.input(|input| input.num_presses(key));
    (0..pressed(Key::ArrowRight)).for_each(|_| session.step(1));
    (0..pressed(Key::ArrowLeft)).for_each(|_| session.step(-1));
    if pressed(Key::Home) > 0 {
        session.go_to(0.0);
    }
    if pressed(Key::End) > 0 {
        session.go_to(1.0);
    }
}

fn paint(ui: &Ui, rect: Rect, rail: Rect, scrubber: &Response, t: f32) {
    let (painter, visuals) = (ui.painter(), ui.visuals());
    let (y, x) = (rect.top() + 13.0, |t: f32| rail.left() + t * rail.width());
    look::badge(painter, pos2(rect.left() + 10.0, y), End::A, true, visuals);
    look::badge(painter, pos2(rect.right() - 10.0, y), End::B, true, visuals);
    let quiet = visuals.weak_text_color();
    for tick in 0..=TICKS {
        let long = if tick % (TICKS / 4) == 0 { 7.0 } else { 4.0 };
        let at = x(f32::from(tick) / f32::from(TICKS));
        painter.vline(at, y + 9.0..=y + 9.0 + long, Stroke::new(1.0, quiet.gamma_multiply(0.7)));
    }
    let mut bar = Mesh::default();
    for (index, (end, at)) in [(End::A, rail.left()), (End::B, rail.right())].into_iter().enumerate() {
        let colour = look::accent(end, visuals);
        bar.colored_vertex(pos2(at, y - 2.0), colour);
        bar.colored_vertex(pos2(at, y + 2.0), colour);
        if index == 1 {
            bar.add_triangle(0, 1, 2);
            bar.add_triangle(1, 2, 3);
        }
    }
    painter.add(bar);
    let lit = scrubber.hovered() || scrubber.dragged();
    painter.circle_filled(pos2(x(t), y), if lit { 10.0 } else { 9.0 }, visuals.text_color());
    if scrubber.has_focus() {
        painter.circle_stroke(pos2(x(t), y), 12.5, Stroke::new(1.5, visuals.selection.stroke.color));
    }
    let text = FontId::proportional(10.5);
    for (t, name) in [(0.0, "0"), (0.25, "¼"), (0.5, "½"), (0.75, "¾"), (1.0, "1")] {
        painter.text(pos2(x(t) + 5.0, rect.bottom() - 5.0), Align2::LEFT_CENTER, name, text.clone(), quiet);
    }
}
