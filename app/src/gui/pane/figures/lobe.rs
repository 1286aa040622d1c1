//! The lobe in the plane of incidence, as a polar plot.

use egui::{Align2, RichText, Ui, WidgetInfo};
use egui_plot::{Line, LineStyle, PlotPoint, PlotUi, Text};

use super::copy::{Curve, Sheet};
use super::lines::{base, hover};
use super::{key, named};
use crate::gui::Session;
use crate::gui::session::Radius;
use crate::report;

/// Spokes, in degrees from the normal.
const SPOKES: [i16; 7] = [-90, -60, -30, 0, 30, 60, 90];
/// Room below and above, in radii.
const BELOW: f64 = 0.22;
const ABOVE: f64 = 1.22;

/// Every curve, up to the horizon; the light comes from the left.
pub fn show(ui: &mut Ui, session: &Session, sheet: &Sheet) {
    key::beside(ui, sheet, Some(sheet.y()), |ui| plot(ui, session, sheet));
}

fn plot(ui: &mut Ui, session: &Session, sheet: &Sheet) {
    let choice = &session.figures;
    let radius = choice.radius;
    let largest = sheet.curves.iter().flat_map(|curve| &curve.points).map(|[_, f]| radius.of(f.max(0.0)));
    let largest = largest.fold(0.0, f64::max).max(1e-6);
    let (curves, x, y) = (sheet.curves.clone(), sheet.x().to_owned(), sheet.y().to_owned());
    let visuals = ui.visuals().clone();
    let plot = base(ui, "lobe", hover(curves, x, y)).data_aspect(1.0).show_axes(false).show_grid(false);
    // Room for the numbers around it, in a low pane too.
    let plot = plot.include_y(-BELOW * largest).include_y(ABOVE * largest);
    let theta_i = f64::from(choice.theta_i);
    let shown = plot.show(ui, |plot| {
        rings(plot, radius, largest, visuals.weak_text_color());
        let light = Line::new("", vec![[0.0, 0.0], at(-theta_i, 1.05 * largest)]).allow_hover(false);
        plot.line(light.color(visuals.warn_fg_color).style(LineStyle::dashed_loose()));
        let end = at(-theta_i, 1.12 * largest);
        let text = RichText::new("light").small();
        plot.text(Text::new("", PlotPoint::new(end[0], end[1]), text).color(visuals.warn_fg_color));
        for Curve { card, title, points } in &sheet.curves {
            let points: Vec<[f64; 2]> = points.iter().map(|[theta, f]| at(*theta, radius.of(f.max(0.0)))).collect();
            let line = Line::new(title.clone(), points).color(named::colour(*card, &visuals));
            plot.line(line.width(2.0).style(named::style(*card)));
        }
    });
    let label = format!("Figure: lobe of {} at θ_i = {theta_i:.0}°; curves: {}", sheet.y(), sheet.curves.len());
    shown.response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &label));
}

/// A place in the plot: degrees from the normal, to the right, and the distance from the middle.
fn at(degrees: f64, radius: f64) -> [f64; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [radius * sin, radius * cos]
}

/// Half circles with their reflectances, and spokes with their angles.
fn rings(plot: &mut PlotUi<'_>, radius: Radius, largest: f64, colour: egui::Color32) {
    let faint = colour.gamma_multiply(0.35);
    let quiet = |points: Vec<[f64; 2]>| Line::new("", points).color(faint).width(1.0).allow_hover(false);
    let text = |place: [f64; 2], text: String| {
        Text::new("", PlotPoint::new(place[0], place[1]), RichText::new(text).small()).color(colour)
    };
    for share in [0.5, 1.0] {
        plot.line(quiet((-45..=45).map(|step| at(2.0 * f64::from(step), share * largest)).collect()));
        let value = report::figure(radius.back(share * largest));
        plot.text(text([-share * largest, -0.03 * largest], value).anchor(Align2::CENTER_TOP));
    }
    for spoke in SPOKES.map(f64::from) {
        plot.line(quiet(vec![[0.0, 0.0], at(spoke, largest)]));
        // The horizon's angles stand beside the numbers of the rings, not on them.
        let anchor = if spoke < -89.0 { Align2::RIGHT_CENTER } else { Align2::CENTER_CENTER };
        plot.text(text(at(spoke, 1.1 * largest), format!("{:.0}°", spoke.abs())).anchor(anchor));
    }
}
