//! The polygon with a material at each corner, and the place in it.

use egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Response, Sense, Stroke, Ui, Vec2, WidgetInfo, vec2};

use crate::gui::session::{Blend, corners};
use crate::gui::{Gallery, look, picture, travel};

/// Room around the polygon for thumbnails and numbers \[points\].
const RIM: f32 = 34.0;
const THUMBNAIL: f32 = 30.0;
/// How far a key press goes; the corners are at distance 1 from the middle.
const STEP: f32 = 0.05;

pub fn show(ui: &mut Ui, blend: &mut Blend, gallery: &Gallery, side: f32) {
    let (rect, area) = ui.allocate_exact_size(Vec2::splat(side), Sense::click_and_drag());
    let (middle, radius) = (rect.center(), 0.5 * side - RIM);
    let to_screen = |[x, y]: [f32; 2]| middle + radius * vec2(x, -y);
    if (area.dragged() || area.clicked())
        && let Some(pointer) = area.interact_pointer_pos()
    {
        area.request_focus();
        let place = (pointer - middle) / radius;
        blend.move_to([place.x, -place.y]);
    }
    keys(ui, &area, blend);
    let about = shares(blend);
    area.widget_info(|| WidgetInfo {
        current_text_value: Some(about.clone()),
        ..WidgetInfo::labeled(egui::Role::Slider, true, "Place in the polygon")
    });
    let places: Vec<Pos2> = corners(blend.ends.len()).into_iter().map(to_screen).collect();
    plane(ui, &places, middle);
    ends(ui, blend, gallery, &places, middle);
    point(ui, &area, to_screen(blend.place));
    area.on_hover_text(format!("{about}. Drag, or arrow keys"));
}

fn keys(ui: &Ui, area: &Response, blend: &mut Blend) {
    if let Some([x, y]) = travel::steps(ui, area) {
        blend.move_to([blend.place[0] + STEP * x, blend.place[1] + STEP * y]);
    }
    if travel::is_home(ui, area) {
        blend.move_to([0.0; 2]);
    }
}

/// All weights in words.
fn shares(blend: &Blend) -> String {
    let weights = blend.weights();
    let share = |(name, weight): (&String, &f32)| format!("{name} {:.0} %", 100.0 * weight);
    blend.ends.iter().zip(weights.as_slice()).map(share).collect::<Vec<_>>().join(", ")
}

/// The colours of the corners, running into each other.
fn plane(ui: &Ui, places: &[Pos2], middle: Pos2) {
    let visuals = ui.visuals();
    let mut mesh = Mesh::default();
    mesh.colored_vertex(middle, visuals.weak_text_color().gamma_multiply(0.15));
    for (end, &place) in places.iter().enumerate() {
        mesh.colored_vertex(place, look::accent(end, visuals).gamma_multiply(0.45));
        mesh.add_triangle(0, 1 + end as u32, 1 + ((end + 1) % places.len()) as u32);
    }
    ui.painter().add(mesh);
    ui.painter().add(egui::Shape::closed_line(places.to_vec(), look::card_stroke(visuals)));
}

fn ends(ui: &Ui, blend: &Blend, gallery: &Gallery, places: &[Pos2], middle: Pos2) {
    let (painter, visuals) = (ui.painter(), ui.visuals());
    let weights = blend.weights();
    for ((end, &corner), weight) in places.iter().enumerate().zip(weights.as_slice()) {
        let outwards = (corner - middle).normalized();
        let ball = corner + 0.5 * THUMBNAIL * outwards;
        let rect = Rect::from_center_size(ball, Vec2::splat(THUMBNAIL));
        picture::ball(painter, gallery.thumbnail(&blend.ends[end]), rect, visuals);
        let side = if outwards.x < -0.1 { -1.0 } else { 1.0 };
        look::badge(painter, ball + vec2(side * 11.0, 10.0), end, true, visuals);
        let at = corner - 14.0 * outwards;
        let text = format!("{:.0}", 100.0 * weight);
        painter.text(at, Align2::CENTER_CENTER, text, FontId::proportional(11.0), visuals.text_color());
    }
}

fn point(ui: &Ui, area: &Response, at: Pos2) {
    let (painter, visuals) = (ui.painter(), ui.visuals());
    let radius = if area.hovered() || area.dragged() { 8.5 } else { 7.5 };
    painter.circle(at, radius, visuals.text_color(), Stroke::new(1.5, Color32::from_black_alpha(120)));
    if area.has_focus() {
        painter.circle_stroke(at, 11.5, Stroke::new(1.5, visuals.selection.stroke.color));
    }
}
