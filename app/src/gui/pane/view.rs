//! What materials are seen on, how much of it, and through which tone curve.

use egui::{Button, ComboBox, DragValue, RichText, Ui};
use nbrdf_core::image::Tone;
use nbrdf_core::render::{Frame, MAX_ZOOM};

use crate::gui::session::Look;
use crate::worker::{Listed, Shape};

/// Sphere, plane, or one of these meshes.
pub fn shape(ui: &mut Ui, look: &mut Look, meshes: &[Listed]) {
    let label = ui.label(RichText::new("On").weak());
    let mesh = "A mesh, which shadows itself. Drop .obj, .gltf and .glb files on the window";
    let mut choices = vec![
        ("Sphere", "As in reports; figures are always measured on it", Shape::Sphere),
        ("Plane", "A ground seen aslant, from steep to grazing; drag to put the highlight somewhere", Shape::Plane),
    ];
    choices.extend(meshes.iter().map(|listed| (listed.name.as_str(), mesh, Shape::Mesh(listed.asset))));
    let name = match look.scenery.shape {
        Shape::Sphere => "Sphere".to_owned(),
        Shape::Plane => "Plane".to_owned(),
        Shape::Mesh(asset) => Listed::title(meshes, asset),
    };
    let combo = ComboBox::from_id_salt("shape").selected_text(name).width(96.0).show_ui(ui, |ui| {
        for (name, about, shape) in choices {
            let is_chosen = shape == look.scenery.shape;
            if ui.selectable_label(is_chosen, name).on_hover_text(about).clicked() && !is_chosen {
                look.show_on(shape);
            }
        }
    });
    combo.response.labelled_by(label.id).on_hover_text("What the materials are seen on");
}

/// The tone curve.
pub fn tone(ui: &mut Ui, look: &mut Look) {
    let label = ui.label(RichText::new("Tone curve").weak());
    let combo = ComboBox::from_id_salt("tone").selected_text(look.tone.title()).width(84.0).show_ui(ui, |ui| {
        for tone in Tone::ALL {
            ui.selectable_value(&mut look.tone, tone, tone.title()).on_hover_text(tone.about());
        }
    });
    let about = "How linear light is shown, after exposure. Figures and thumbnails are those of the clip curve";
    combo.response.labelled_by(label.id).on_hover_text(about);
}

/// How much is enlarged, and all of it again.
pub fn zoom(ui: &mut Ui, look: &mut Look) {
    let frame = look.scenery.frame;
    let label = ui.label(RichText::new("Zoom").weak());
    let mut zoom = frame.zoom;
    let field = DragValue::new(&mut zoom).range(1.0..=MAX_ZOOM).speed(0.02).fixed_decimals(1).suffix("×");
    let about =
        "Of all pictures. Over a picture: the wheel or a pinch; Shift or another button drags, a double click resets";
    if ui.add(field).labelled_by(label.id).on_hover_text(about).changed() {
        look.scenery.frame = frame.zoomed(zoom / frame.zoom, [0.0; 2]);
    }
    let whole = ui.add_enabled(frame != Frame::WHOLE, Button::new("Whole"));
    if whole.on_hover_text("Show the whole shape again").clicked() {
        look.scenery.frame = Frame::WHOLE;
    }
}
