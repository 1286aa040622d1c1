//! The picture: of the materials themselves, of their models, or of the difference.

use egui::{Color32, Rect, Sense, Stroke, Ui, WidgetInfo, vec2};

use crate::gui::gallery::Tableau;
use crate::gui::session::{Scene, Shown};
use crate::gui::{look, picture};
use crate::report::figure;

const CHOICES: [(Shown, &str, &str); 3] = [
    (Shown::Reference, "Reference", "Every object with its material as it is"),
    (Shown::Planned, "Planned", "Every object with the model that was chosen for it"),
    (
        Shown::Difference,
        "Difference",
        "FLIP between the two, pixel by pixel: black is 0, white is four times the tolerance",
    ),
];

/// Choice and picture, this high at most \[points\]; a click selects an object.
pub fn show(ui: &mut Ui, scene: &mut Scene, tableau: &Tableau, [width, height]: [usize; 2], highest: f32) {
    let top = ui.cursor().top();
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (shown, name, about) in CHOICES {
            ui.selectable_value(&mut scene.shown, shown, name).on_hover_text(about);
        }
        if let Some(plan) = tableau.plan.as_ref().filter(|_| scene.shown == Shown::Difference) {
            let legend = format!("white: FLIP {}", figure(plan.white));
            ui.label(egui::RichText::new(legend).small().weak()).on_hover_text("Mean FLIP that is white; black is 0");
        }
    });
    let highest = (highest - (ui.cursor().top() - top)).max(90.0);
    let room = vec2(ui.available_width(), highest);
    let scale = (room.x / width as f32).min(room.y / height as f32);
    let (rect, picture) = ui.allocate_exact_size(vec2(width as f32, height as f32) * scale, Sense::click());
    let name = CHOICES.iter().find(|(shown, ..)| *shown == scene.shown).map_or("", |(_, name, _)| name);
    let selected = scene.selected.as_deref().unwrap_or("nothing");
    let label = format!("Picture of the scene, {}, {selected} selected", name.to_lowercase());
    picture.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, label.as_str()));
    let texture = match scene.shown {
        Shown::Reference => &tableau.reference,
        Shown::Planned => &tableau.planned,
        Shown::Difference => &tableau.difference,
    };
    match texture {
        Some(texture) => picture::whole(ui.painter(), texture, rect, Color32::WHITE),
        None => {
            ui.painter().rect_filled(rect, 0.0, ui.visuals().faint_bg_color);
        }
    }
    if let Some(object) = &scene.selected {
        outline(ui, rect, tableau, object, width);
    }
    let object = |at: egui::Pos2| {
        let share = (at - rect.min) / rect.size();
        tableau.object_at([share.x, share.y])
    };
    let under = picture.hover_pos().and_then(object);
    let clicked = picture.clicked().then(|| picture.interact_pointer_pos().and_then(object));
    if let Some(clicked) = clicked {
        match clicked {
            Some(object) => scene.select(object),
            None => scene.selected = None,
        }
    }
    look::focus(ui.painter(), &picture, ui.visuals());
    if picture.hovered() {
        picture.on_hover_text_at_pointer(under.unwrap_or("No object; click one to select it"));
    }
}

/// The rim of the selected object, to be seen on any picture.
fn outline(ui: &Ui, rect: Rect, tableau: &Tableau, object: &str, width: usize) {
    let scale = rect.width() / width as f32;
    let at = |[x, y]: [usize; 2]| rect.min + vec2(x as f32, y as f32) * scale;
    let accent = look::accent(0, ui.visuals());
    for stroke in [Stroke::new(3.5, Color32::from_black_alpha(150)), Stroke::new(1.8, accent)] {
        for run in tableau.outline(object) {
            ui.painter().line_segment(run.map(at), stroke);
        }
    }
}
