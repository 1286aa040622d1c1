//! What is chosen in the window for files.

use egui::{ComboBox, DragValue, RichText, TextEdit, Ui, vec2};

use crate::catalog::EXPORTERS;
use crate::gui::Session;
use crate::gui::session::{SIZES, STEPS, What, export_name_of};
use crate::worker::Card;
use crate::worker::export::PictureForm;

/// What is written, whose, in which form, and where to.
pub fn show(ui: &mut Ui, session: &mut Session) {
    what(ui, session);
    ui.separator();
    if session.export.what.is_of_a_card() {
        card(ui, session);
    }
    form(ui, session);
    place(ui, session);
}

fn what(ui: &mut Ui, session: &mut Session) {
    ui.horizontal_wrapped(|ui| {
        for what in What::ALL {
            let [title, about] = what.about();
            ui.selectable_value(&mut session.export.what, what, title).on_hover_text(about);
        }
    });
    ui.label(RichText::new(session.export.what.about()[1]).small().weak());
}

fn card(ui: &mut Ui, session: &mut Session) {
    let title = |card: Card| session.title(card);
    let cards: Vec<(String, String)> =
        session.export_cards().into_iter().map(|card| (export_name_of(card), title(card))).collect();
    let chosen = session.export_card();
    let shown = chosen.map_or_else(|| "none".to_owned(), title);
    let chosen = chosen.map(export_name_of);
    let choice = ComboBox::from_label("Card").selected_text(shown).show_ui(ui, |ui| {
        for (name, title) in cards {
            if ui.selectable_label(chosen.as_ref() == Some(&name), title).clicked() {
                session.export.card = name;
            }
        }
    });
    choice.response.on_hover_text("Whose material: an end, or the present point of a method");
}

fn form(ui: &mut Ui, session: &mut Session) {
    let export = &mut session.export;
    ui.horizontal_wrapped(|ui| match export.what {
        What::Material | What::Steps => {
            for entry in EXPORTERS {
                let is_chosen = export.exporter().name == entry.name;
                if ui.selectable_label(is_chosen, entry.name).on_hover_text(entry.about).clicked() {
                    entry.name.clone_into(&mut export.form);
                }
            }
        }
        What::Picture | What::Strip => {
            for (form, about) in PictureForm::ALL.into_iter().zip(["as it is displayed", "linear values"]) {
                let name = form.extension().to_uppercase();
                ui.selectable_value(&mut export.picture, form, name).on_hover_text(about);
            }
            let size = DragValue::new(&mut export.size).range(SIZES[0]..=SIZES[1]).suffix(" pixels");
            ui.add(size).on_hover_text("Side of a sphere [pixels]");
        }
        What::Curve => {
            ui.label("CSV");
        }
    });
    if matches!(export.what, What::Strip | What::Curve | What::Steps) {
        let steps = DragValue::new(&mut export.steps).range(STEPS[0]..=STEPS[1]).suffix(" points");
        ui.add(steps).on_hover_text("Points of the path, ends included");
    }
}

fn place(ui: &mut Ui, session: &mut Session) {
    let (folder, name) = (session.export.folder().display().to_string(), session.export_name());
    let fields = [
        ("Folder", folder, &mut session.export.folder, "Where the files go; it must be there"),
        ("Name", name, &mut session.export.name, "What the names of all files begin with"),
    ];
    for (title, hint, text, about) in fields {
        ui.horizontal(|ui| {
            let label = ui.add_sized(vec2(48.0, 20.0), egui::Label::new(title));
            let field = TextEdit::singleline(text).hint_text(hint).desired_width(f32::INFINITY);
            ui.add(field).labelled_by(label.id).on_hover_text(about);
        });
    }
}
