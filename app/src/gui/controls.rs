//! The bottom panel: where on the path, how bright, from where.

use egui::{
    Button, ComboBox, DragValue, Key, Label, Pos2, Rect, RichText, Shape, Slider, Stroke, Ui, WidgetInfo, vec2,
};
use nbrdf_core::Vec3;

use super::Session;
use super::scrubber::Scrubber;
use super::session::MAX_EXPOSURE;
use crate::worker::Lighting;

/// The bottom panel.
pub struct Controls<'a> {
    pub session: &'a mut Session,
    /// Names of the environment maps.
    pub maps: &'a [String],
}

impl Controls<'_> {
    pub fn show(self, ui: &mut Ui) {
        let Self { session, maps } = self;
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            play(ui, session);
            let value = format!("t = {:.3}", session.t);
            ui.add_sized(vec2(68.0, 26.0), Label::new(RichText::new(value).size(14.0)));
            Scrubber { session }.show(ui);
        });
        ui.horizontal(|ui| {
            exposure(ui, session);
            ui.add_space(12.0);
            light(ui, session, maps);
            ui.add_space(12.0);
            if ui.button("Reset").on_hover_text("t, exposure and light as at the start").clicked() {
                session.reset();
            }
            ui.add_space(12.0);
            direction(ui, session);
        });
        ui.add_space(4.0);
    }
}

fn play(ui: &mut Ui, session: &mut Session) {
    let is_playing = session.playing.is_some();
    let name = if is_playing { "Pause" } else { "Play" };
    let button = ui.add(Button::new("").min_size(vec2(34.0, 28.0)));
    icon(ui, button.rect.center(), is_playing);
    button.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, name));
    let nothing_focused = ui.memory(|memory| memory.focused().is_none());
    let key = nothing_focused && ui.input(|input| input.key_pressed(Key::Space));
    if button.on_hover_text(format!("{name} (space)")).clicked() || key {
        session.toggle_play();
    }
    if session.playing.is_some() {
        ui.ctx().request_repaint();
    }
}

/// A triangle, or two bars: the small built-in fonts have neither.
fn icon(ui: &Ui, centre: Pos2, is_playing: bool) {
    let (painter, colour) = (ui.painter(), ui.visuals().text_color());
    if is_playing {
        for x in [-3.5, 3.5] {
            painter.rect_filled(Rect::from_center_size(centre + vec2(x, 0.0), vec2(3.5, 12.0)), 1.0, colour);
        }
    } else {
        let corners = [vec2(-4.0, -6.5), vec2(7.0, 0.0), vec2(-4.0, 6.5)].map(|corner| centre + corner);
        painter.add(Shape::convex_polygon(corners.to_vec(), colour, Stroke::NONE));
    }
}

fn exposure(ui: &mut Ui, session: &mut Session) {
    let label = ui.label(RichText::new("Exposure").weak());
    let slider = Slider::new(&mut session.exposure, -MAX_EXPOSURE..=MAX_EXPOSURE).step_by(0.25).suffix(" stops");
    ui.add(slider.fixed_decimals(2)).labelled_by(label.id).on_hover_text("Each stop doubles the light that is shown");
}

fn light(ui: &mut Ui, session: &mut Session, maps: &[String]) {
    let label = ui.label(RichText::new("Light").weak());
    let name = match session.lighting {
        Lighting::Studio => "Studio",
        Lighting::Point(_) => "Point",
        Lighting::Around { map, .. } => maps.get(map).map_or("Map", String::as_str),
    };
    let lamp = Lighting::Point(Vec3::new(1.0, 0.0, 1.0).normalize());
    let mut choices = vec![
        ("Studio", "Eleven lamps, as in reports", Lighting::Studio),
        ("Point", "One lamp; drag on a sphere", lamp),
    ];
    let about = "All around, sample after sample; drag on a sphere to turn it. Drop .hdr and .exr maps on the window";
    choices
        .extend(maps.iter().enumerate().map(|(map, name)| (name.as_str(), about, Lighting::Around { map, turn: 0.0 })));
    let combo = ComboBox::from_id_salt("light").selected_text(name).width(96.0).show_ui(ui, |ui| {
        for (own, about, lighting) in choices {
            // By what it is: two maps may have one name.
            let is_chosen = match (lighting, session.lighting) {
                (Lighting::Around { map, .. }, Lighting::Around { map: chosen, .. }) => map == chosen,
                (one, other) => std::mem::discriminant(&one) == std::mem::discriminant(&other),
            };
            if ui.selectable_label(is_chosen, own).on_hover_text(about).clicked() && !is_chosen {
                session.lighting = lighting;
            }
        }
    });
    combo.response.labelled_by(label.id);
}

fn direction(ui: &mut Ui, session: &mut Session) {
    if let Lighting::Around { turn, .. } = &mut session.lighting {
        let mut degrees = turn.to_degrees().round();
        let field = ui.add(DragValue::new(&mut degrees).range(-180..=180).prefix("turned ").suffix("°"));
        if field.on_hover_text("Turn of the map about the vertical axis").changed() {
            *turn = degrees.to_radians();
        }
        return;
    }
    let Lighting::Point(direction) = session.lighting else {
        ui.add(Label::new(RichText::new("drag a sphere to light it").weak()).truncate());
        return;
    };
    // + 0: nobody wants to read −0.
    let degrees = |radians: f32| radians.to_degrees().round() + 0.0;
    let (azimuth, elevation) = (degrees(direction.x.atan2(direction.z)), degrees(direction.y.clamp(-1.0, 1.0).asin()));
    let (mut new_azimuth, mut new_elevation) = (azimuth, elevation);
    ui.add(DragValue::new(&mut new_azimuth).range(-100..=100).prefix("right ").suffix("°"))
        .on_hover_text("Direction of the lamp: right of the viewer");
    ui.add(DragValue::new(&mut new_elevation).range(-90..=90).prefix("up ").suffix("°"))
        .on_hover_text("Direction of the lamp: above the viewer");
    if (new_azimuth, new_elevation) != (azimuth, elevation) {
        let ((sin_a, cos_a), (sin_e, cos_e)) =
            (new_azimuth.to_radians().sin_cos(), new_elevation.to_radians().sin_cos());
        session.lighting = Lighting::Point(Vec3::new(cos_e * sin_a, sin_e, cos_e * cos_a));
    }
}
