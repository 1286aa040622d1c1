//! What is allowed, what is to be least, and what came of it.

use egui::{Button, RichText, Slider, Ui};
use nbrdf_core::plan::{By, TOLERANCE};

use super::table;
use crate::gui::session::TOLERANCES;
use crate::gui::{Gallery, Session};
use crate::worker::scene::Row;

/// Plans that took no longer than this are made while the slider is dragged \[seconds\].
const AT_ONCE: f64 = 0.3;

/// Choices and table; whether the user has not yet decided.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery) -> bool {
    let tableau = &gallery.scene;
    let scene = &mut session.scene;
    let mut tolerance = scene.tolerance.or(tableau.tolerance).unwrap_or(TOLERANCE);
    let mut is_dragged = false;
    ui.horizontal_wrapped(|ui| {
        let label = ui.label(RichText::new("Tolerance").weak());
        let slider = Slider::new(&mut tolerance, TOLERANCES[0]..=TOLERANCES[1]).logarithmic(true).max_decimals(4);
        let slider = ui.add(slider).labelled_by(label.id);
        is_dragged = slider.dragged();
        let about = "Mean FLIP that the pixels of an object may have: 0 is no difference, 1 the largest. \
                     About 0.04 is hardly seen";
        if slider.on_hover_text(about).changed() {
            scene.tolerance = Some(tolerance);
        }
    });
    ui.horizontal_wrapped(|ui| {
        let time = "The fastest models within the tolerance; within a tenth of their time, those of fewest bytes";
        ui.radio_value(&mut scene.by, By::Time, "Least time").on_hover_text(time);
        let bytes = "The models of fewest bytes within the tolerance; within a tenth of them, the fastest";
        ui.radio_value(&mut scene.by, By::Bytes, "Least bytes").on_hover_text(bytes);
    });
    let rows = tableau.plan.as_ref().map_or(&[][..], |plan| plan.rows.as_slice());
    let selected = rows.iter().find(|row| scene.selected.as_ref() == Some(&row.object));
    put(ui, session, gallery, selected);
    if let Some(plan) = &tableau.plan {
        table::show(ui, &mut session.scene, plan);
    }
    let is_quick = !tableau.is_busy() && tableau.plan.as_ref().is_some_and(|plan| plan.seconds < AT_ONCE);
    is_dragged && !is_quick
}

/// The material of the selected object can be put at A.
fn put(ui: &mut Ui, session: &mut Session, gallery: &Gallery, selected: Option<&Row>) {
    let name = selected.map(|row| row.material.as_str());
    let why = match selected {
        None => "Select an object first, in the picture or in the table",
        Some(_) => "Its material comes from a file: drop that on the window, and choose it in the library",
    };
    let is_known = selected.is_some_and(|row| !row.is_file && gallery.names.contains(&row.material));
    let text = format!("Put {} at A", name.unwrap_or("material"));
    let button = ui.add_enabled(is_known, Button::new(text).truncate());
    let button = button.on_hover_text("Walks from this material").on_disabled_hover_text(why);
    if let Some(name) = name.filter(|_| button.clicked()) {
        session.blend.choose(0, name);
    }
}
