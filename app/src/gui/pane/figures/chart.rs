//! The chart of all representations: speed against accuracy, the materials on the screen marked.

use egui::{ProgressBar, RichText, TextStyle, Ui, Visuals, WidgetInfo};
use egui_plot::{Corner, HoverPosition, Legend, Line, MarkerShape, Points};

use super::lines::{base, powers};
use super::marks;
use crate::catalog::Family;
use crate::gui::session::letter;
use crate::gui::{Gallery, Session, look};
use crate::measure::front::{TIE, front};
use crate::measure::point::title_of;
use crate::report;
use crate::worker::{ChartNews, Rival};

/// Starts the measurement, or stops it.
pub fn button(ui: &mut Ui, news: Option<&ChartNews>) -> Option<bool> {
    let Some((news, doing)) = news.and_then(|news| Some((news, news.doing?))) else {
        let about = "Measures every representation on a few held-out materials and on those shown: a minute or more. \
                     Each waits a second for other work to end, and says so if that goes on";
        return ui.button("Measure all").on_hover_text(about).clicked().then_some(true);
    };
    let share = news.rivals.len() as f32 / news.count.max(1) as f32;
    ui.add(ProgressBar::new(share).desired_width(120.0).text(RichText::new(doing).small()));
    ui.button("Cancel").on_hover_text("Stops after the material that is being measured").clicked().then_some(false)
}

/// A mark: where it is, and what is said of it.
struct Mark {
    at: [f64; 2],
    about: String,
}

/// The marks of one kind.
struct Kind {
    name: String,
    colour: egui::Color32,
    shape: MarkerShape,
    marks: Vec<Mark>,
}

/// The chart, as far as it is measured.
pub fn show(ui: &mut Ui, session: &Session, gallery: &Gallery) {
    let Some(news) = gallery.curves.chart.as_ref().filter(|news| !news.rivals.is_empty()) else {
        return super::empty(ui, "“Measure all” charts every representation: speed against accuracy.");
    };
    let metric = &session.figures.metric;
    let kinds = kinds(session, &news.rivals, metric, ui.visuals());
    let models: Vec<(f64, f64)> = news.rivals.iter().map(|rival| (rival.point.times.ns, mean(rival, metric))).collect();
    let best: Vec<[f64; 2]> =
        front(&models, TIE).into_iter().map(|place| [models[place].0.log10(), models[place].1.log10()]).collect();
    let said: Vec<(String, Vec<String>)> = kinds
        .iter()
        .map(|kind| (kind.name.clone(), kind.marks.iter().map(|mark| mark.about.clone()).collect()))
        .collect();
    let hover = move |at: &HoverPosition<'_>| match at {
        HoverPosition::NearDataPoint { plot_name, index, .. } => {
            said.iter().find(|(name, _)| name == plot_name)?.1.get(*index).cloned()
        }
        HoverPosition::Elsewhere { .. } => None,
    };
    let legend = Legend::default().text_style(TextStyle::Small).position(Corner::RightTop).follow_insertion_order(true);
    let plot = base(ui, "chart", hover)
        .legend(legend)
        .x_grid_spacer(marks::round(marks::ACROSS, 1.0))
        .y_grid_spacer(marks::round(marks::UP, 1.0))
        .x_axis_label("ns per evaluation, one thread")
        .y_axis_label(title_of(metric))
        .x_axis_formatter(|mark, _| powers(mark.value))
        .y_axis_formatter(|mark, _| powers(mark.value));
    let faint = ui.visuals().weak_text_color();
    let shown = plot.show(ui, |plot| {
        plot.line(Line::new("", best).color(faint).width(1.0).allow_hover(false));
        for Kind { name, colour, shape, marks } in kinds {
            let points: Vec<[f64; 2]> = marks.iter().map(|mark| mark.at).collect();
            let is_own = matches!(shape, MarkerShape::Cross | MarkerShape::Plus);
            let radius = if is_own { 3.5 } else { 4.5 };
            plot.points(Points::new(name, points).color(colour).shape(shape).radius(radius).filled(true));
        }
    });
    let label = format!("Figure: speed against {}; {} models", title_of(metric), news.rivals.len());
    shown.response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &label));
}

/// Models by family, then the materials on the screen.
fn kinds(session: &Session, rivals: &[Rival], metric: &str, visuals: &Visuals) -> Vec<Kind> {
    let families = Family::ALL.into_iter().enumerate().map(|(place, family)| {
        let own = rivals.iter().filter(|rival| rival.point.family == family);
        let marks = own.filter_map(|rival| mark(rival, mean(rival, metric), "mean of held-out materials"));
        Kind {
            name: family.title().to_owned(),
            colour: look::series(place, visuals),
            shape: SHAPES[place % SHAPES.len()],
            marks: marks.collect(),
        }
    });
    let ends = session.blend.ends.iter().enumerate().map(|(end, name)| {
        let error = |rival: &Rival| Some(*rival.own.iter().find(|(own, _)| own == name)?.1.get(metric)?);
        let marks = rivals.iter().filter_map(|rival| mark(rival, error(rival)?, name));
        Kind {
            name: format!("{} {name}", letter(end)),
            colour: look::accent(end, visuals),
            shape: if end % 2 == 0 { MarkerShape::Cross } else { MarkerShape::Plus },
            marks: marks.collect(),
        }
    });
    families.chain(ends).filter(|kind| !kind.marks.is_empty()).collect()
}

const SHAPES: [MarkerShape; 5] =
    [MarkerShape::Circle, MarkerShape::Square, MarkerShape::Diamond, MarkerShape::Up, MarkerShape::Down];

fn mean(rival: &Rival, metric: &str) -> f64 {
    rival.point.error.get(metric).map_or(f64::NAN, |band| band.mean)
}

/// None of what a logarithmic axis has no place for.
fn mark(rival: &Rival, error: f64, of: &str) -> Option<Mark> {
    let point = &rival.point;
    let ns = point.times.ns;
    let is_shown = ns > 0.0 && error > 0.0 && ns.is_finite() && error.is_finite();
    let about = format!(
        "{}\n{} ({of})\n{} ns{}, {} bytes, {} MB shared",
        point.title(),
        report::figure(error),
        report::figure(ns),
        if rival.is_disturbed { " (timed while other work ran)" } else { "" },
        point.bytes,
        report::figure(point.shared_bytes as f64 / 1e6)
    );
    is_shown.then(|| Mark { at: [ns.log10(), error.log10()], about })
}
