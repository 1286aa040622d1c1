//! Above picture and table: which scene, and how far its plan is.

use std::path::PathBuf;

use egui::{Align, Button, Id, Label, Layout, RichText, Spinner, TextEdit, Ui, vec2};

use crate::gui::gallery::Tableau;
use crate::gui::session::Scene;
use crate::measure::planned::times;
use crate::worker::scene::{Ask, EXAMPLES, Planned, Source, is_scene};

/// Opens a scene by its path, or an example.
pub fn open(ui: &mut Ui, scene: &mut Scene) {
    ui.horizontal_wrapped(|ui| {
        path(ui, scene);
        for (name, _, about) in EXAMPLES {
            let is_open = matches!(&scene.source, Some(Source::Example(own)) if own == name);
            let button = Button::selectable(is_open, format!("Example: {name}"));
            if ui.add(button).on_hover_text(about).clicked() && !is_open {
                scene.open(Source::Example(name.to_owned()));
            }
        }
    });
}

fn path(ui: &mut Ui, scene: &mut Scene) {
    let id = Id::unique("path of the scene");
    let opened = match &scene.source {
        Some(Source::File(path)) => path.display().to_string(),
        _ => String::new(),
    };
    // What is being typed, and for which scene: another one brings its own path.
    let known: Option<(String, String)> = ui.data(|data| data.get_temp(id));
    let mut text = known.filter(|(of, _)| *of == opened).map_or_else(|| opened.clone(), |(_, text)| text);
    let label = ui.label(RichText::new("Scene").weak());
    let width = (ui.available_width() - 70.0).clamp(60.0, 160.0);
    let field = TextEdit::singleline(&mut text).hint_text("scenes/shelf.toml").desired_width(width);
    let field = ui.add(field).labelled_by(label.id).on_hover_text("Path of a scene's file (.toml)");
    let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(egui::Key::Enter));
    let path = PathBuf::from(text.trim());
    let button = ui.add_enabled(is_scene(&path), Button::new("Open"));
    let about = "Reads the file and plans its scene; once more if it has changed";
    let is_clicked = button.on_hover_text(about).on_disabled_hover_text("Give the path of a .toml file").clicked();
    if is_scene(&path) && (is_clicked || is_entered) {
        scene.open_file(path);
    }
    ui.data_mut(|data| data.insert_temp(id, (opened, text)));
}

/// What is being done, or what came of it; what was asked for here.
pub fn state(ui: &mut Ui, tableau: &Tableau) -> Option<Ask> {
    let mut asked = None;
    let line = vec2(ui.available_width(), ui.spacing().interact_size.y);
    if let Some(why) = &tableau.failure {
        ui.label(RichText::new(why).color(ui.visuals().warn_fg_color));
        return asked;
    }
    ui.allocate_ui_with_layout(line, Layout::right_to_left(Align::Center), |ui| {
        let button = if tableau.is_busy() {
            Some(("Cancel", "Stops looking for models; what was found so far is kept", Ask::Stop))
        } else if tableau.is_stopped {
            Some(("Plan", "Goes on where it was stopped", Ask::Again))
        } else {
            None
        };
        if let Some((name, about, ask)) = button
            && ui.button(name).on_hover_text(about).clicked()
        {
            asked = Some(ask);
        }
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            if tableau.is_busy() {
                ui.add(Spinner::new().size(12.0));
                ui.add(Label::new(RichText::new(format!("Planning: {}", tableau.doing)).weak()).truncate());
            } else if tableau.is_stopped {
                ui.add(Label::new(RichText::new("Stopped").weak()).truncate());
            } else if let Some(plan) = &tableau.plan {
                ui.add(Label::new(RichText::new(saved(plan)).strong()).truncate()).on_hover_text(totals(plan));
            }
        });
    });
    asked
}

/// What the plan saves.
fn saved(plan: &Planned) -> String {
    match plan.saved {
        Some([time, bytes]) => format!(
            "{}, {} than an NBRDF for everything",
            times(time, ["less time", "more time"]),
            times(bytes, ["fewer bytes", "more bytes"])
        ),
        None => format!("{:.1} ms, {} bytes", 1e-6 * plan.totals.ns, plan.totals.bytes),
    }
}

fn totals(plan: &Planned) -> String {
    let cost = |ns: f64, bytes: usize| format!("{:.2} ms on one thread, {bytes} bytes", 1e-6 * ns);
    let planned = cost(plan.totals.ns, plan.totals.bytes);
    let full = plan
        .beside
        .as_ref()
        .map_or_else(String::new, |full| format!("\nA pruned NBRDF of every material: {}", cost(full.ns, full.bytes)));
    format!(
        "{} evaluations of the picture\nPlanned: {planned}{full}\nFound in {:.1} s",
        plan.totals.evaluations, plan.seconds
    )
}
