//! Directions and values at the picked point of all spheres.

mod table;

use egui::{ComboBox, Grid, RichText, ScrollArea, Sense, StrokeKind, Ui, WidgetInfo, vec2};
use nbrdf_core::Rgb;

use crate::gui::{Gallery, Session};
use crate::worker::{Incidence, Lighting, Point, Reading};
use table::angles;

/// Size of figures \[points\].
const DIGITS: f32 = 11.5;

/// The pane.
pub fn show(ui: &mut Ui, session: &mut Session, gallery: &Gallery) {
    ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        let Some(at) = session.pick.at else { return empty(ui, session.pick.is_picking) };
        let Some(point) = &gallery.point else {
            ui.weak("Looking");
            return;
        };
        ui.horizontal_wrapped(|ui| buttons(ui, session, point));
        ui.weak(format!("At {:.3}, {:.3}", at[0], at[1]).replace('-', "−"))
            .on_hover_text("Right of the middle and above it, in half picture widths");
        let Some(place) = chosen(session, point) else {
            ui.label("Nothing is lit there: pick a point on a sphere.");
            return;
        };
        lamp(ui, session, point, place);
        directions(ui, &point.lamps[place]);
        for card in session.cards() {
            ui.add_space(6.0);
            ui.label(RichText::new(session.title(card)).strong());
            match point.readings.iter().find(|(other, _)| *other == card) {
                Some((_, Ok(reading))) => {
                    ui.push_id(card, |ui| values(ui, reading, place));
                }
                Some((_, Err(why))) => {
                    ui.weak(why);
                }
                None => {
                    ui.weak("Looking");
                }
            }
        }
    });
}

fn empty(ui: &mut Ui, is_picking: bool) {
    ui.weak(if is_picking {
        "Click on a sphere."
    } else {
        "No point is picked. Hold Alt or Ctrl and click on a sphere, or press P and click."
    });
}

fn buttons(ui: &mut Ui, session: &mut Session, point: &Point) {
    if ui.button("Copy table").on_hover_text("As text with tabs, for spreadsheets").clicked() {
        ui.ctx().copy_text(table::text(session, point));
    }
    if ui.button("Clear").on_hover_text("Picks nothing any more").clicked() {
        session.pick.clear();
    }
}

/// Which of the point's lamps is looked at: the chosen one, or the brightest where it is behind the surface.
fn chosen(session: &Session, point: &Point) -> Option<usize> {
    let own = session.pick.lamp.and_then(|lamp| point.lamps.iter().position(|other| other.lamp == lamp));
    own.or((!point.lamps.is_empty()).then_some(0))
}

/// What a lamp is called.
fn name(lighting: Lighting, lamp: usize) -> String {
    match (lighting, lamp) {
        (Lighting::Point(_), _) => "Lamp".to_owned(),
        (Lighting::Around { .. }, _) => "Mirrored view".to_owned(),
        (Lighting::Studio, 0) => "Warm key".to_owned(),
        (Lighting::Studio, 1) => "Cool key".to_owned(),
        (Lighting::Studio, 2) => "Neutral key".to_owned(),
        (Lighting::Studio, fill) => format!("Fill {}", fill - 2),
    }
}

fn lamp(ui: &mut Ui, session: &mut Session, point: &Point, place: usize) {
    let lighting = session.look.scenery.lighting;
    if point.lamps.len() < 2 {
        ui.weak(name(lighting, point.lamps[place].lamp));
        return;
    }
    ui.horizontal_wrapped(|ui| {
        let label = ui.label(RichText::new("Lamp").weak());
        let combo = ComboBox::from_id_salt("lamp").selected_text(name(lighting, point.lamps[place].lamp)).width(96.0);
        let shown = combo.show_ui(ui, |ui| {
            for (other, Incidence { lamp, .. }) in point.lamps.iter().enumerate() {
                if ui.selectable_label(other == place, name(lighting, *lamp)).clicked() {
                    session.pick.lamp = Some(*lamp);
                }
            }
        });
        shown.response.labelled_by(label.id).on_hover_text("Lamps in front of the surface, brightest there first");
    });
}

fn directions(ui: &mut Ui, incidence: &Incidence) {
    Grid::new("directions").num_columns(4).spacing([8.0, 2.0]).show(ui, |ui| {
        for (place, (name, degrees, about)) in angles(incidence.directions).into_iter().enumerate() {
            ui.weak(name).on_hover_text(about);
            ui.label(digits(format!("{degrees:.2}°"))).on_hover_text(about);
            if place % 2 == 1 {
                ui.end_row();
            }
        }
    });
}

fn values(ui: &mut Ui, reading: &Reading, place: usize) {
    Grid::new("values").num_columns(4).spacing([7.0, 2.0]).show(ui, |ui| {
        let about = "Reflectance under this lamp, red, green and blue, in 1/sr";
        row(ui, "f_r 1/sr", reading.values.get(place).map(|Rgb(value)| value.map(number)), about);
        let about = "Linear radiance towards the viewer from all lamps, before exposure: 1 is a white surface facing a \
                     lamp of irradiance π";
        row(ui, "L", reading.radiance.map(|Rgb(value)| value.map(number)), about);
        row(ui, "shown", reading.shown.map(|bytes| bytes.map(|byte| byte.to_string())), "As displayed, 0 to 255");
        if let Some([r, g, b]) = reading.shown {
            ui.label("");
            let (rect, swatch) = ui.allocate_exact_size(vec2(40.0, 14.0), Sense::hover());
            let colour = egui::Color32::from_rgb(r, g, b);
            ui.painter().rect(rect, 3.0, colour, ui.visuals().widgets.noninteractive.bg_stroke, StrokeKind::Inside);
            swatch.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, format!("Colour {r}, {g}, {b}")));
            swatch.on_hover_text(format!("#{r:02x}{g:02x}{b:02x}"));
        }
    });
}

fn row(ui: &mut Ui, name: &str, cells: Option<[String; 3]>, about: &str) {
    ui.weak(name).on_hover_text(about);
    for cell in cells.unwrap_or_else(|| std::array::from_fn(|_| "–".to_owned())) {
        ui.label(digits(cell)).on_hover_text(about);
    }
    ui.end_row();
}

/// Figures that stand below each other: three columns of them have room in the narrowest pane.
fn digits(text: String) -> RichText {
    RichText::new(text).monospace().size(DIGITS)
}

/// Four digits of anything.
fn number(value: f32) -> String {
    match value.abs() {
        small if small != 0.0 && small < 1e-3 => format!("{value:.2e}"),
        large if large >= 1e4 => format!("{value:.2e}"),
        large if large >= 100.0 => format!("{value:.1}"),
        _ => format!("{value:.4}"),
    }
}
