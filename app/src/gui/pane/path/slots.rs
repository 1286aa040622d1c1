//! The materials that are blended, as chips: to change, to take out, to add, to bring into another order.

use egui::text::{LayoutJob, TextWrapping};
use egui::{Button, FontId, Id, Key, Rect, Response, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};

use super::materials;
use crate::gui::drag::MaterialName;
use crate::gui::session::{MOST_ENDS, letter, shown};
use crate::gui::{Gallery, Session, look, picture, travel};

const WIDE: f32 = 148.0;
const TALL: f32 = 38.0;
const REMOVE: f32 = 20.0;

/// A chip that is dragged: which end it is.
#[derive(Clone, Copy, Debug)]
struct Slot(usize);

/// What is to be done to the ends.
enum Change {
    Choose(usize, String),
    Remove(usize),
    Reorder(usize, usize),
}

pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery) {
    let mut change = None;
    for end in 0..session.blend.ends.len() {
        change = chip(ui, session, gallery, end).or(change);
    }
    if session.blend.ends.len() < MOST_ENDS {
        let add = ui.add(Button::new("+").min_size(vec2(30.0, TALL)));
        add.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, "Add a material"));
        let add = add.on_hover_text("Blend one material more, six at most");
        let last = session.blend.ends.len();
        change =
            taken(ui, &add, last).or_else(|| Some(Change::Choose(last, materials::choose(&add, gallery)?))).or(change);
    }
    match change {
        Some(Change::Choose(end, name)) => session.blend.choose(end, &name),
        Some(Change::Remove(end)) => session.blend.remove(end),
        Some(Change::Reorder(from, to)) => session.blend.reorder(from, to),
        None => {}
    }
}

fn chip(ui: &mut Ui, session: &Session, gallery: &Gallery, end: usize) -> Option<Change> {
    let (name, has_remove) = (&session.blend.ends[end], session.blend.ends.len() > 2);
    let (rect, chip) = ui.allocate_exact_size(vec2(WIDE.min(ui.max_rect().width()), TALL), Sense::click_and_drag());
    chip.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, format!("Slot {}: {name}", letter(end))));
    chip.dnd_set_drag_payload(Slot(end));
    let is_target = chip.dnd_hover_payload::<Slot>().is_some() || chip.dnd_hover_payload::<MaterialName>().is_some();
    paint(ui, rect, &chip, is_target);
    let ball = Rect::from_center_size(rect.left_center() + vec2(21.0, 0.0), vec2(30.0, 30.0));
    picture::ball(ui.painter(), gallery.thumbnail(name), ball, ui.visuals());
    look::badge(ui.painter(), ball.right_bottom() - vec2(3.0, 5.0), end, true, ui.visuals());
    let right = rect.right() - if has_remove { REMOVE + 6.0 } else { 6.0 };
    let left = ball.right() + 10.0;
    let mut job =
        LayoutJob::simple_singleline(shown(name).to_owned(), FontId::proportional(12.5), ui.visuals().text_color());
    job.wrap = TextWrapping::truncate_at_width((right - left).max(0.0));
    let text = ui.painter().layout_job(job);
    let at = pos2(left, rect.center().y - 0.5 * text.size().y);
    ui.painter().galley(at, text, ui.visuals().text_color());
    let is_removed = has_remove && (remove(ui, rect, end) || is_deleted(ui, &chip));
    if let Some(to) = moved(ui, &chip, end, session.blend.ends.len()) {
        return Some(Change::Reorder(end, to));
    }
    let chip = chip.on_hover_text(format!("{name}: click to change, drag onto another or press arrow keys to reorder"));
    if is_removed {
        return Some(Change::Remove(end));
    }
    taken(ui, &chip, end).or_else(|| Some(Change::Choose(end, materials::choose(&chip, gallery)?)))
}

/// Where arrow keys move a chip in focus to, which keeps the focus there.
fn moved(ui: &Ui, chip: &Response, end: usize, count: usize) -> Option<usize> {
    let (moved, pass) = (Id::unique("slot that was moved"), ui.ctx().cumulative_pass_nr());
    // Not in the same pass: the key that moved one chip would move the next as well.
    if ui.data(|data| data.get_temp::<(usize, u64)>(moved)).is_some_and(|(to, at)| to == end && at < pass) {
        ui.data_mut(|data| data.remove::<(usize, u64)>(moved));
        chip.request_focus();
    }
    let [across, _] = travel::steps(ui, chip)?;
    let to = if across > 0.0 { end + 1 } else { end.checked_sub(1)? };
    (to < count).then(|| ui.data_mut(|data| data.insert_temp(moved, (to, pass))))?;
    // The focus follows in the next frame, and keeps arrow keys from the one after.
    ui.ctx().request_repaint();
    Some(to)
}

fn is_deleted(ui: &Ui, chip: &Response) -> bool {
    chip.has_focus() && ui.input(|input| input.key_pressed(Key::Delete))
}

/// What is dropped here.
fn taken(ui: &Ui, onto: &Response, end: usize) -> Option<Change> {
    // Whoever asks for one kind takes away the other.
    if onto.dnd_hover_payload::<MaterialName>().is_some() {
        return Some(Change::Choose(end, onto.dnd_release_payload::<MaterialName>()?.0.clone()));
    }
    onto.dnd_hover_payload::<Slot>()?;
    let from = onto.dnd_release_payload::<Slot>()?.0;
    ui.ctx().request_repaint();
    Some(Change::Reorder(from, end))
}

fn paint(ui: &Ui, rect: Rect, chip: &Response, is_target: bool) {
    let (painter, visuals) = (ui.painter(), ui.visuals());
    let fill = if chip.hovered() || chip.dragged() { visuals.faint_bg_color } else { look::card_fill(visuals) };
    let stroke = if is_target || chip.has_focus() {
        Stroke::new(1.5, visuals.selection.stroke.color)
    } else {
        look::card_stroke(visuals)
    };
    painter.rect(rect, look::ROUND, fill, stroke, StrokeKind::Inside);
}

/// Whether the cross was clicked.
fn remove(ui: &Ui, chip: Rect, end: usize) -> bool {
    let rect = Rect::from_center_size(chip.right_center() - vec2(0.5 * REMOVE + 4.0, 0.0), vec2(REMOVE, REMOVE));
    let cross = ui.interact(rect, ui.scope_id().with(("remove", end)), Sense::click());
    let label = format!("Remove {}", letter(end));
    cross.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &label));
    let is_lit = cross.hovered() || cross.has_focus();
    let colour = if is_lit { ui.visuals().text_color() } else { ui.visuals().weak_text_color() };
    let (centre, stroke) = (rect.center(), Stroke::new(1.5, colour));
    ui.painter().line_segment([centre - vec2(4.0, 4.0), centre + vec2(4.0, 4.0)], stroke);
    ui.painter().line_segment([centre + vec2(-4.0, 4.0), centre + vec2(4.0, -4.0)], stroke);
    cross.on_hover_text(label).clicked()
}
