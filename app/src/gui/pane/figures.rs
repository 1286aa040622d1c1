//! Figures of the ends and of the ways between them: curves, slices, costs and warnings.

mod along;
mod chart;
mod copy;
mod cost;
mod key;
mod lines;
mod lobe;
mod marks;
mod named;
mod profiles;
mod slices;
mod warnings;

use egui::{Button, ComboBox, RichText, Spinner, Ui};

use super::Wanted;
use crate::gui::session::{Channel, Figure, Quantity, Radius};
use crate::gui::{Gallery, Session};
use crate::measure::point::{METRICS, title_of};
use crate::worker::{Findings, Found};
use copy::Sheet;

/// The pane.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery, wanted: &mut Wanted) {
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        for (figure, name, about) in Figure::ALL {
            ui.selectable_value(&mut session.figures.figure, figure, name).on_hover_text(about);
        }
    });
    let figure = session.figures.figure;
    let topic = figure.topic(&session.figures, &session.blend, session.look.exposure);
    let findings = gallery.curves.of(&topic).filter(|findings| is_of(findings, session));
    let sheet = sheet(session, findings, gallery);
    ui.horizontal_wrapped(|ui| {
        controls(ui, session, gallery, wanted);
        // Pictures are no numbers.
        if figure != Figure::Slice {
            copy(ui, sheet.as_ref());
        }
        let is_old =
            findings.is_none_or(|findings| !findings.is_fine || !session.still_asks(&findings.question, &topic));
        let waiting = findings.map_or(0, |findings| findings.waiting);
        if waiting > 0 {
            ui.label(RichText::new(format!("{waiting} more being prepared")).small().weak());
        }
        if is_old {
            ui.add(Spinner::new().size(14.0)).on_hover_text("Working it out");
        }
    });
    match findings.map(|findings| &findings.found) {
        None => empty(ui, "Working it out"),
        Some(Found::Nothing(why)) => empty(ui, why),
        Some(Found::Walks(_) | Found::Profiles(_)) => match (&sheet, figure) {
            (Some(sheet), Figure::Lobe) if !sheet.is_empty() => lobe::show(ui, session, sheet),
            (Some(sheet), _) if !sheet.is_empty() => lines::show(ui, session, sheet),
            _ => empty(ui, "No methods are shown: choose some above the spheres."),
        },
        Some(Found::Slices(slices)) => slices::show(ui, session, gallery, slices),
        Some(Found::Prices(prices)) => cost::show(ui, session, gallery, prices),
        Some(Found::Told(told)) => warnings::show(ui, session, told),
    }
    wanted.figure = Some(topic);
}

/// Whether findings are of the ends and the timing that are chosen; methods are told apart curve by curve.
fn is_of(findings: &Findings, session: &Session) -> bool {
    let question = &findings.question;
    *question.ends == *session.blend.ends && question.timing == session.blend.timing
}

/// The curves or rows that are shown, as numbers.
fn sheet(session: &Session, findings: Option<&Findings>, gallery: &Gallery) -> Option<Sheet> {
    match &findings?.found {
        Found::Walks(walks) => Some(along::sheet(session, walks)),
        Found::Profiles(found) => Some(profiles::sheet(session, found)),
        Found::Prices(prices) => Some(cost::sheet(session, prices, gallery)),
        Found::Told(told) => Some(warnings::sheet(session, told)),
        Found::Slices(_) | Found::Nothing(_) => None,
    }
}

fn controls(ui: &mut Ui, session: &mut Session, gallery: &Gallery, wanted: &mut Wanted) {
    let choice = &mut session.figures;
    match choice.figure {
        Figure::Along => {
            let choices =
                Quantity::ALL.map(|(quantity, name, unit, about)| (quantity, format!("{name} [{unit}]"), about));
            pick(ui, "Quantity", &mut choice.quantity, &choices);
        }
        Figure::Lobe => {
            angle(ui, "θ_i", &mut choice.theta_i, "Angle of the light from the normal, in degrees");
            let about = "What the distance from the middle says";
            let choices = Radius::ALL.map(|(radius, name)| (radius, name.to_owned(), about));
            pick(ui, "Radius", &mut choice.radius, &choices);
            channels(ui, &mut choice.channel);
        }
        Figure::Half => {
            let about = "Angle between light and half vector, in degrees; across the half vector's plane (φ_d = 90°)";
            angle(ui, "θ_d", &mut choice.theta_d, about);
            channels(ui, &mut choice.channel);
        }
        Figure::Albedo => channels(ui, &mut choice.channel),
        Figure::Cost => {
            let about = "The error of the chart, mean over held-out materials";
            let choices = METRICS.map(|metric| (metric.to_owned(), title_of(metric), about));
            pick(ui, "Error", &mut choice.metric, &choices);
            wanted.is_charting = chart::button(ui, gallery.curves.chart.as_ref());
        }
        Figure::Slice => {
            let about = "π f_r at the exposure of the spheres: a white diffuse surface is white";
            let exposure = format!("Exposure {:+.2} stops", session.look.exposure);
            ui.label(RichText::new(exposure).weak()).on_hover_text(about);
        }
        Figure::Warnings => {}
    }
}

fn channels(ui: &mut Ui, channel: &mut Channel) {
    let about = "Of linear light";
    pick(ui, "Channel", channel, &Channel::ALL.map(|(channel, name)| (channel, name.to_owned(), about)));
}

/// A choice by name.
fn pick<T: Clone + PartialEq>(ui: &mut Ui, label: &str, chosen: &mut T, choices: &[(T, String, &str)]) {
    let salt = label;
    let label = ui.label(RichText::new(label).weak());
    let name = choices.iter().find(|(own, ..)| own == chosen).map_or("", |(_, name, _)| name);
    let combo = ComboBox::from_id_salt(salt).selected_text(name).show_ui(ui, |ui| {
        for (own, name, about) in choices {
            ui.selectable_value(chosen, own.clone(), name).on_hover_text(*about);
        }
    });
    combo.response.labelled_by(label.id);
}

fn angle(ui: &mut Ui, label: &str, degrees: &mut f32, about: &str) {
    let label = ui.label(RichText::new(label).weak());
    let slider = egui::Slider::new(degrees, 0.0..=85.0).step_by(1.0).suffix("°").fixed_decimals(0);
    ui.add(slider).labelled_by(label.id).on_hover_text(about);
}

fn copy(ui: &mut Ui, sheet: Option<&Sheet>) {
    let sheet = sheet.filter(|sheet| !sheet.is_empty());
    let button = ui.add_enabled(sheet.is_some(), Button::new("Copy CSV"));
    let button = button.on_hover_text("The numbers that are shown, as comma-separated values, to the clipboard");
    if let Some(sheet) = sheet.filter(|_| button.clicked()) {
        ui.ctx().copy_text(sheet.csv());
    }
}

fn empty(ui: &mut Ui, text: &str) {
    ui.add_space(12.0);
    ui.vertical_centered(|ui| ui.label(RichText::new(text).weak()));
}
