//! The paths on the map, the place on them, and the place that is explored.

use egui::{Align2, CursorIcon, FontId, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2, WidgetInfo, vec2};

use super::frame::Frame;
use crate::catalog::Catalog;
use crate::gui::session::Session;
use crate::gui::{look, travel};
use crate::worker::{Course, Track};

/// How near to a curve it is meant \[points\].
const REACH: f32 = 7.0;
/// Side of a place that can be dragged.
const HANDLE: f32 = 20.0;
/// How far a key press moves it \[points\].
const STEP: f32 = 6.0;

/// All curves.
pub fn curves(ui: &Ui, frame: &Frame, track: &Track) {
    let named = track.courses.len() > 1;
    for (place, course) in track.courses.iter().enumerate() {
        let colour = colour(ui, place);
        let points: Vec<Pos2> = course.curve.iter().map(|(_, at)| frame.point(*at)).collect();
        if let Some(middle) = points.get(points.len() / 2).filter(|_| named) {
            let title = Catalog::interpolation_entry(course.method).map_or(course.method, |entry| entry.title);
            ui.painter().text(
                *middle + vec2(5.0, -5.0),
                Align2::LEFT_BOTTOM,
                title,
                FontId::proportional(10.5),
                colour,
            );
        }
        ui.painter().add(Shape::line(points, Stroke::new(if place == 0 { 2.5 } else { 1.5 }, colour)));
        if place > 0 {
            ui.painter().circle_filled(frame.point(course.here), 4.0, colour);
        }
    }
}

fn colour(ui: &Ui, place: usize) -> egui::Color32 {
    if place == 0 { ui.visuals().text_color() } else { look::accent(2 + place, ui.visuals()) }
}

/// The present place on the latent path, and the explored one; both can be dragged.
pub fn places(ui: &Ui, frame: &Frame, session: &mut Session, track: Option<&Track>) {
    if let Some(Course { here, .. }) = track.and_then(|track| track.courses.first()) {
        let at = frame.point(*here);
        ui.painter().circle(at, 6.0, ui.visuals().text_color(), Stroke::new(2.0, look::card_fill(ui.visuals())));
        let about = "Where the latent path is now; drag it to explore the map";
        handle(ui, frame, session, at, "Present place on the map", about);
    }
    if let Some(explored) = session.explored.filter(|explored| explored.projection == session.map.projection) {
        let at = frame.point(explored.place);
        let corners = [vec2(0.0, -8.0), vec2(8.0, 0.0), vec2(0.0, 8.0), vec2(-8.0, 0.0)].map(|corner| at + corner);
        let rim = Stroke::new(2.0, look::card_fill(ui.visuals()));
        ui.painter().add(Shape::convex_polygon(corners.to_vec(), ui.visuals().warn_fg_color, rim));
        handle(ui, frame, session, at, "Explored place on the map", "The explored place; drag it, or end it with Esc");
    }
}

fn handle(ui: &Ui, frame: &Frame, session: &mut Session, at: Pos2, name: &str, about: &str) {
    let rect = Rect::from_center_size(at, Vec2::splat(HANDLE));
    let handle = ui.interact(rect, ui.scope_id().with(name), Sense::drag());
    handle.widget_info(|| WidgetInfo::labeled(egui::Role::Slider, true, name));
    if handle.dragged()
        && let Some(pointer) = handle.interact_pointer_pos()
    {
        super::explore(session, frame, pointer);
    }
    if let Some([x, y]) = travel::steps(ui, &handle) {
        let explored = session.explored.filter(|explored| explored.projection == session.map.projection);
        let from = explored.map_or(at, |explored| frame.point(explored.place));
        super::explore(session, frame, from + STEP * vec2(x, -y));
    }
    look::focus(ui.painter(), &handle, ui.visuals());
    handle.on_hover_cursor(CursorIcon::Grab).on_hover_text(about);
}

/// t of the curve that is meant by a point of the window.
pub fn nearest(frame: &Frame, track: &Track, pointer: Pos2) -> Option<f32> {
    let found = track.courses.iter().filter_map(|course| {
        let curve: Vec<(f32, Pos2)> = course.curve.iter().map(|(t, at)| (*t, frame.point(*at))).collect();
        nearest_on(&curve, pointer)
    });
    found.filter(|(_, away)| *away <= REACH).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(t, _)| t)
}

/// t of the nearest point of a curve, and the distance to it.
fn nearest_on(curve: &[(f32, Pos2)], point: Pos2) -> Option<(f32, f32)> {
    let on = |pair: &[(f32, Pos2)]| {
        let [(t, from), (next, to)] = [pair[0], pair[1]];
        let along = to - from;
        let share = ((point - from).dot(along) / along.length_sq().max(1e-12)).clamp(0.0, 1.0);
        (t + share * (next - t), point.distance(from + share * along))
    };
    curve.windows(2).map(on).min_by(|a, b| a.1.total_cmp(&b.1))
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn a_point_beside_a_curve_means_the_nearest_t() {
        let curve = [(0.0, pos2(0.0, 0.0)), (0.5, pos2(10.0, 0.0)), (1.0, pos2(10.0, 20.0))];
        let (t, away) = nearest_on(&curve, pos2(5.0, -3.0)).unwrap();
        assert!((t - 0.25).abs() < 1e-6 && (away - 3.0).abs() < 1e-6);
        assert!((nearest_on(&curve, pos2(12.0, 10.0)).unwrap().0 - 0.75).abs() < 1e-6);
        assert!(nearest_on(&curve[..1], pos2(0.0, 0.0)).is_none());
    }
}
