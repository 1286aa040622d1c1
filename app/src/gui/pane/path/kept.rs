//! Blends kept under names: to keep the present one, to load, rename and forget others.

use egui::{Button, Id, Popup, PopupCloseBehavior, RichText, ScrollArea, TextEdit, Ui};

use crate::gui::Session;

/// What is done to a kept blend.
enum Change {
    Load,
    Rename(String),
    Forget,
}

pub fn show(ui: &mut Ui, session: &mut Session) {
    let button = ui.button("Blends").on_hover_text("Keep this blend under a name, or load another");
    // By name, not by count: the popup stays open when there are more slots before it, or fewer.
    let own = Id::unique("kept blends");
    let typed = own.with("name");
    if button.clicked() {
        let name = session.free_name();
        ui.data_mut(|data| data.insert_temp(typed, name));
    }
    let popup = Popup::from_toggle_button_response(&button).id(own);
    popup.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.set_width(260.0);
        keep(ui, session, typed);
        ui.separator();
        list(ui, session);
    });
}

fn keep(ui: &mut Ui, session: &mut Session, typed: Id) {
    let mut name = ui.data(|data| data.get_temp::<String>(typed)).unwrap_or_default();
    ui.horizontal(|ui| {
        ui.add(TextEdit::singleline(&mut name).hint_text("Name").desired_width(180.0));
        let is_named = !name.trim().is_empty();
        let button = ui.add_enabled(is_named, Button::new("Keep"));
        if button.on_hover_text("Materials, place, timing, edits and methods, under this name").clicked() {
            session.keep_blend(&name);
            name = session.free_name();
        }
    });
    ui.data_mut(|data| data.insert_temp(typed, name));
}

fn list(ui: &mut Ui, session: &mut Session) {
    if session.blends.is_empty() {
        ui.label(RichText::new("No blends are kept yet: give this one a name.").weak());
    }
    let mut change = None;
    ScrollArea::vertical().max_height(240.0).show(ui, |ui| {
        for (place, kept) in session.blends.iter().enumerate() {
            let row = ui.push_id(place, |ui| ui.horizontal(|ui| row(ui, &kept.name)).inner).inner;
            change = row.map(|row| (place, row)).or(change.take());
        }
    });
    match change {
        Some((place, Change::Load)) => {
            session.load_blend(place);
            ui.close();
        }
        Some((place, Change::Rename(name))) => session.rename_blend(place, &name),
        Some((place, Change::Forget)) => session.forget_blend(place),
        None => {}
    }
}

fn row(ui: &mut Ui, name: &str) -> Option<Change> {
    let mut change = None;
    let editing = ui.scope_id().with("rename");
    if let Some(mut text) = ui.data(|data| data.get_temp::<String>(editing)) {
        let field = ui.add(TextEdit::singleline(&mut text).desired_width(180.0));
        if field.lost_focus() {
            ui.data_mut(|data| data.remove::<String>(editing));
            let is_given_up = ui.input(|input| input.key_pressed(egui::Key::Escape));
            return (!is_given_up).then_some(Change::Rename(text));
        }
        field.request_focus();
        ui.data_mut(|data| data.insert_temp(editing, text));
        return None;
    }
    let load = ui.add(Button::new(format!("Load {name}")).truncate().min_size(egui::vec2(120.0, 0.0)));
    if load.on_hover_text("Show this blend").clicked() {
        change = Some(Change::Load);
    }
    if ui.small_button("Rename").on_hover_text(format!("Give {name} another name")).clicked() {
        ui.data_mut(|data| data.insert_temp(editing, name.to_owned()));
    }
    if ui.small_button("Delete").on_hover_text(format!("Forget {name}; undo brings it back")).clicked() {
        change = Some(Change::Forget);
    }
    change
}
