//! Curves in a plot.

use egui::{Ui, WidgetInfo};
use egui_plot::{HLine, HoverPosition, Line, LineStyle, Plot, VLine};

use super::copy::{Curve, Sheet};
use super::{key, marks, named};
use crate::gui::Session;
use crate::gui::session::{Figure, Quantity};
use crate::report;

/// Lowest reflectance \[1/sr\] of a logarithmic axis.
const DARKEST: f64 = 1e-5;

/// Height of a letter on its side, and of what is below the plot \[points\].
const LETTER: f32 = 7.5;
const BELOW: f32 = 46.0;

/// Curves over t, or over an angle.
pub fn show(ui: &mut Ui, session: &mut Session, sheet: &Sheet) {
    let written = sheet.y().chars().count() as f32 * LETTER;
    let is_low = ui.available_height() < written + BELOW;
    key::beside(ui, sheet, is_low.then(|| sheet.y()), |ui| plot(ui, session, sheet, is_low));
}

/// One that is low has no room for the name of its vertical axis.
fn plot(ui: &mut Ui, session: &mut Session, sheet: &Sheet, is_low: bool) {
    let choice = &session.figures;
    let (is_along, is_half) = (choice.figure == Figure::Along, choice.figure == Figure::Half);
    let has_limit = choice.figure == Figure::Albedo || (is_along && choice.quantity == Quantity::Albedo);
    let high = |[x, y]: [f64; 2]| if is_half { [x, y.max(DARKEST).log10()] } else { [x, y] };
    let (curves, x, y) = (sheet.curves.clone(), sheet.x().to_owned(), sheet.y().to_owned());
    let mut plot = base(ui, "curves", hover(curves, x, y)).x_axis_label(sheet.x());
    if !is_low {
        plot = plot.y_axis_label(sheet.y());
    }
    if is_half {
        plot = plot.y_axis_formatter(|mark, _| powers(mark.value)).y_grid_spacer(marks::round(marks::UP, 1.0));
    } else {
        plot = plot.include_y(0.0);
    }
    if has_limit {
        plot = plot.include_y(1.0);
    }
    if is_along {
        let [low, high] = session.blend.range();
        plot = plot.include_x(low).include_x(high);
    }
    let visuals = ui.visuals().clone();
    let t = f64::from(session.blend.t);
    let has_t = is_along && !session.blend.is_polygon();
    let shown = plot.show(ui, |plot| {
        if has_limit {
            let limit = HLine::new("", 1.0).color(visuals.warn_fg_color).style(LineStyle::dashed_dense());
            plot.hline(limit.allow_hover(false));
        }
        if has_t {
            plot.vline(VLine::new("", t).color(visuals.selection.stroke.color).width(1.5).allow_hover(false));
        }
        for Curve { card, title, points } in &sheet.curves {
            let points: Vec<[f64; 2]> = points.iter().map(|&point| high(point)).collect();
            let line = Line::new(title.clone(), points).color(named::colour(*card, &visuals));
            plot.line(line.width(2.0).style(named::style(*card)));
        }
    });
    let label = format!("Figure: {} over {}; curves: {}", sheet.y(), sheet.x(), sheet.curves.len());
    shown.response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &label));
    if has_t
        && shown.response.clicked()
        && let Some(pointer) = shown.response.interact_pointer_pos()
    {
        session.blend.go_to(shown.transform.value_from_position(pointer).x as f32);
    }
}

/// A plot that stays in its place: the wheel is the pane's, a click is the figure's; zoom by pinching or with Ctrl, a double
/// click shows everything again.
pub fn base<'a>(ui: &Ui, id: &str, hover: impl Fn(&HoverPosition<'_>) -> Option<String> + 'a) -> Plot<'a> {
    Plot::new(id)
        .allow_drag(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .show_crosshair(false)
        .grid_color(ui.visuals().weak_text_color().gamma_multiply(0.3))
        .grid_fade(0.0)
        .x_grid_spacer(marks::round(marks::ACROSS, 0.0))
        .y_grid_spacer(marks::round(marks::UP, 0.0))
        .label_formatter(hover)
}

/// What is said of a curve's point: whose, where, what, with units.
pub fn hover(curves: Vec<Curve>, x: String, y: String) -> impl Fn(&HoverPosition<'_>) -> Option<String> {
    move |at| match at {
        HoverPosition::NearDataPoint { plot_name, index, .. } => {
            let curve = curves.iter().find(|curve| curve.title == *plot_name)?;
            let [here, value] = curve.points.get(*index)?;
            Some(format!("{plot_name}\n{x}: {}\n{y}: {}", report::figure(*here), report::figure(*value)))
        }
        HoverPosition::Elsewhere { .. } => None,
    }
}

/// A power of ten.
pub fn powers(exponent: f64) -> String {
    let value = 10f64.powf(exponent);
    let is_whole = (exponent - exponent.round()).abs() < 1e-9;
    match is_whole {
        true if (-3.0..=4.0).contains(&exponent) => value.to_string(),
        true => format!("1e{exponent:.0}"),
        false => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::worker::Card;

    #[test]
    fn powers_are_written_where_they_are_whole() {
        assert_eq!([-2.0, 0.0, 3.0, -5.0, 0.5].map(powers), ["0.01", "1", "1000", "1e-5", ""]);
    }

    #[test]
    fn hovering_tells_whose_value_it_is_with_its_unit() {
        let curve = Curve { card: Card::Method("latent"), title: "Latent".to_owned(), points: vec![[0.5, 34.24]] };
        let said = hover(vec![curve], "t".to_owned(), "PSNR [dB]".to_owned());
        let position = egui_plot::PlotPoint::new(0.5, 34.24);
        let found = said(&HoverPosition::NearDataPoint { plot_name: "Latent", position, index: 0 });
        assert_eq!(found.as_deref(), Some("Latent\nt: 0.500\nPSNR [dB]: 34.2"));
        assert_eq!(said(&HoverPosition::Elsewhere { position }), None);
    }
}
