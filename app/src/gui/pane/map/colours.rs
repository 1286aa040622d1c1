//! What colours on the map mean.

use egui::{Align2, Color32, FontId, Pos2, Rect, Sense, Shape, Stroke, Ui, WidgetInfo, ecolor::Hsva, pos2, vec2};
use nbrdf_core::Database;
use nbrdf_core::axis::Axis;
use nbrdf_core::image::DISPLAY_GAMMA;

use crate::gui::look;
use crate::gui::session::Tint;
use crate::report::{figure, heat::heat};
use crate::worker::Spot;

const BAR: f32 = 132.0;
const HEIGHT: f32 = 26.0;
const STEPS: u8 = 32;
const DATABASES: [(Database, &str); 3] = [(Database::Merl, "MERL"), (Database::Rgl, "RGL"), (Database::Other, "Own")];

/// Smallest and largest figure of the materials; none where colours mean no figure.
pub fn range(tint: Tint, spots: &[Spot]) -> Option<[f64; 2]> {
    if tint == Tint::Quality(Axis::Hue) {
        return Some([-0.5, 0.5]);
    }
    let values = spots.iter().filter_map(|spot| tint.value(spot));
    values.fold(None, |range, value| {
        let [low, high] = range.unwrap_or([value; 2]);
        Some([f64::min(low, value), f64::max(high, value)])
    })
}

/// The colour of a material, if it has one.
pub fn colour(tint: Tint, range: Option<[f64; 2]>, spot: &Spot, ui: &Ui) -> Option<Color32> {
    if tint == Tint::Database {
        return Some(of_database(Database::of(&spot.name), ui));
    }
    let ([low, high], value) = (range?, tint.value(spot)?);
    Some(of_share(tint, (value - low) / (high - low).max(1e-12)))
}

fn of_share(tint: Tint, share: f64) -> Color32 {
    if tint == Tint::Quality(Axis::Hue) {
        return Hsva::new((share as f32 + 0.5).rem_euclid(1.0), 0.75, 0.9, 1.0).into();
    }
    // Without the darkest and the lightest, which one of the themes would swallow.
    let [r, g, b] = heat(0.16 + 0.74 * share).0.map(|v| (255.0 * v.powf(1.0 / DISPLAY_GAMMA)).round() as u8);
    Color32::from_rgb(r, g, b)
}

fn of_database(database: Database, ui: &Ui) -> Color32 {
    let place = DATABASES.iter().position(|(known, _)| *known == database).unwrap_or(0);
    look::accent(2 + place, ui.visuals())
}

/// Colours and marks with their meaning.
pub fn legend(ui: &mut Ui, tint: Tint, range: Option<[f64; 2]>) {
    if let Some(range) = range {
        bar(ui, tint, range);
    }
    if tint == Tint::Database {
        for (database, name) in DATABASES {
            let colour = of_database(database, ui);
            entry(ui, name, tint.about(), |ui, at| {
                ui.painter().circle_filled(at, 4.0, colour);
            });
        }
    }
    let about =
        "Nothing was learned from materials with a dashed ring, or a square where there is no room for a picture";
    entry(ui, "held out", about, |ui, at| ui.painter().extend(dashed(at, 5.0, ui.visuals().weak_text_color())));
}

fn entry(ui: &mut Ui, name: &str, about: &str, mark: impl FnOnce(&Ui, Pos2)) {
    let galley =
        ui.painter().layout_no_wrap(name.to_owned(), FontId::proportional(11.0), ui.visuals().weak_text_color());
    let (rect, response) = ui.allocate_exact_size(vec2(18.0 + galley.size().x, HEIGHT), Sense::hover());
    mark(ui, rect.left_center() + vec2(7.0, 0.0));
    ui.painter().galley(
        rect.left_center() + vec2(16.0, -0.5 * galley.size().y),
        galley,
        ui.visuals().weak_text_color(),
    );
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, name));
    response.on_hover_text(about);
}

/// A dashed ring.
pub fn dashed(centre: Pos2, radius: f32, colour: Color32) -> Vec<Shape> {
    let corner = |step: u8| centre + radius * egui::Vec2::angled(std::f32::consts::TAU * f32::from(step) / 24.0);
    let dash = (0.26 * radius).max(2.0);
    Shape::dashed_line(&(0..=24).map(corner).collect::<Vec<_>>(), Stroke::new(2.0, colour), dash, dash)
}

/// All colours, and the figures of three of them.
fn bar(ui: &mut Ui, tint: Tint, [low, high]: [f64; 2]) {
    let (rect, response) = ui.allocate_exact_size(vec2(BAR, HEIGHT), Sense::hover());
    let strip = Rect::from_min_max(rect.min + vec2(0.0, 3.0), pos2(rect.right(), rect.top() + 12.0));
    let wide = strip.width() / f32::from(STEPS);
    for step in 0..STEPS {
        let left = strip.left() + wide * f32::from(step);
        let part = Rect::from_min_max(pos2(left, strip.top()), pos2(left + wide + 0.5, strip.bottom()));
        let share = (f64::from(step) + 0.5) / f64::from(STEPS);
        ui.painter().rect_filled(part.intersect(strip), 0.0, of_share(tint, share));
    }
    let places = [(low, Align2::LEFT_TOP), (0.5 * (low + high), Align2::CENTER_TOP), (high, Align2::RIGHT_TOP)];
    for ((value, align), x) in places.into_iter().zip([strip.left(), strip.center().x, strip.right()]) {
        let at = pos2(x, strip.bottom() + 1.0);
        ui.painter().text(at, align, figure(value), FontId::proportional(10.0), ui.visuals().weak_text_color());
    }
    response.widget_info(|| {
        let text = format!("{} from {} to {}", tint.title(), figure(low), figure(high));
        WidgetInfo::labeled(egui::Role::Image, true, text)
    });
    response.on_hover_text(tint.about());
}
