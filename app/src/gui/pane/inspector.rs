//! Light, exposure, and what else changes the look.

mod axes;

use egui::{ComboBox, DragValue, Label, RichText, ScrollArea, Slider, Ui};
use nbrdf_core::Vec3;

use super::view;
use crate::gui::session::{LAMP, MAX_EXPOSURE};
use crate::gui::{Gallery, Session};
use crate::worker::{Lighting, Listed};

/// The pane; whether it shows measured qualities.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery) -> bool {
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        heading(ui, "Light");
        ui.horizontal_wrapped(|ui| light(ui, session, &gallery.maps));
        ui.horizontal_wrapped(|ui| direction(ui, session));
        exposure(ui, session);
        ui.horizontal_wrapped(|ui| view::tone(ui, &mut session.look));
        heading(ui, "Shape");
        ui.horizontal_wrapped(|ui| view::shape(ui, &mut session.look, &gallery.meshes));
        ui.horizontal_wrapped(|ui| view::zoom(ui, &mut session.look));
        if ui.button("Reset").on_hover_text("Place, exposure, light and zoom as at the start (R)").clicked() {
            session.reset();
        }
        heading(ui, "Path");
        path(ui, session);
        heading(ui, "Axes");
        axes::show(ui, session, gallery);
    });
    true
}

fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(4.0);
    ui.label(RichText::new(text).strong());
}

fn path(ui: &mut Ui, session: &mut Session) {
    let blend = &mut session.blend;
    let about = "t from −0.5 to 1.5 (E); paths slow down where more light would leave than arrive";
    if ui.checkbox(&mut blend.is_beyond, "Beyond the ends").on_hover_text(about).changed() {
        blend.go_to(blend.t);
    }
    ui.checkbox(&mut session.strips, "Film strips").on_hover_text("Whole paths below the slider (F)");
}

fn exposure(ui: &mut Ui, session: &mut Session) {
    let label = ui.label(RichText::new("Exposure").weak());
    ui.spacing_mut().slider_width = (ui.available_width() - 92.0).clamp(40.0, 200.0);
    let slider = Slider::new(&mut session.look.exposure, -MAX_EXPOSURE..=MAX_EXPOSURE).step_by(0.25).suffix(" stops");
    ui.add(slider.fixed_decimals(2)).labelled_by(label.id).on_hover_text("Each stop doubles the light that is shown");
}

fn light(ui: &mut Ui, session: &mut Session, maps: &[Listed]) {
    let label = ui.label(RichText::new("Source").weak());
    let name = match session.look.scenery.lighting {
        Lighting::Studio => "Studio".to_owned(),
        Lighting::Point(_) => "Point".to_owned(),
        Lighting::Around { map, .. } => Listed::title(maps, map),
    };
    let mut choices = vec![
        ("Studio", "Eleven lamps: three keys and a ring of fills", Lighting::Studio),
        ("Point", "One lamp; drag on a picture", LAMP),
    ];
    let about = "All around, sample after sample; drag on a picture to turn it. Drop .hdr and .exr maps on the window";
    let around = |listed: &Listed| Lighting::Around { map: listed.asset, turn: 0.0 };
    choices.extend(maps.iter().map(|listed| (listed.name.as_str(), about, around(listed))));
    let combo = ComboBox::from_id_salt("light").selected_text(name).width(96.0).show_ui(ui, |ui| {
        for (own, about, lighting) in choices {
            // By what it is: two maps may have one name.
            let is_chosen = match (lighting, session.look.scenery.lighting) {
                (Lighting::Around { map, .. }, Lighting::Around { map: chosen, .. }) => map == chosen,
                (one, other) => std::mem::discriminant(&one) == std::mem::discriminant(&other),
            };
            if ui.selectable_label(is_chosen, own).on_hover_text(about).clicked() && !is_chosen {
                session.look.scenery.lighting = lighting;
            }
        }
    });
    combo.response.labelled_by(label.id);
}

fn direction(ui: &mut Ui, session: &mut Session) {
    if let Lighting::Around { turn, .. } = &mut session.look.scenery.lighting {
        let mut degrees = turn.to_degrees().round();
        let field = ui.add(DragValue::new(&mut degrees).range(-180..=180).prefix("turned ").suffix("°"));
        if field.on_hover_text("Turn of the map about the vertical axis").changed() {
            *turn = degrees.to_radians();
        }
        return;
    }
    let Lighting::Point(direction) = session.look.scenery.lighting else {
        ui.add(Label::new(RichText::new("Drag a picture to light it").weak()).truncate());
        return;
    };
    // + 0: nobody wants to read −0.
    let degrees = |radians: f32| radians.to_degrees().round() + 0.0;
    let (azimuth, elevation) = (degrees(direction.x.atan2(direction.z)), degrees(direction.y.clamp(-1.0, 1.0).asin()));
    let (mut new_azimuth, mut new_elevation) = (azimuth, elevation);
    ui.add(DragValue::new(&mut new_azimuth).range(-180..=180).prefix("right ").suffix("°"))
        .on_hover_text("Direction of the lamp: right of the viewer");
    ui.add(DragValue::new(&mut new_elevation).range(-90..=90).prefix("up ").suffix("°"))
        .on_hover_text("Direction of the lamp: above the viewer");
    if (new_azimuth, new_elevation) != (azimuth, elevation) {
        let ((sin_a, cos_a), (sin_e, cos_e)) =
            (new_azimuth.to_radians().sin_cos(), new_elevation.to_radians().sin_cos());
        session.look.scenery.lighting = Lighting::Point(Vec3::new(cos_e * sin_a, sin_e, cos_e * cos_a));
    }
}
