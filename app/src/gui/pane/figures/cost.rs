//! What evaluation costs: a table of what is shown, beside the chart of all representations.

use egui::{Grid, RichText, ScrollArea, Ui, vec2};

use super::copy::Sheet;
use super::{chart, named};
use crate::gui::{Gallery, Session};
use crate::report;
use crate::worker::Price;

/// Widest table \[points\].
const TABLE: f32 = 330.0;
/// A pane narrower than this has the chart below the table \[points\].
const WIDE: f32 = 520.0;

/// Table and chart.
pub fn show(ui: &mut Ui, session: &Session, gallery: &Gallery, prices: &[Price]) {
    let size = ui.available_size();
    if size.x < WIDE {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ScrollArea::horizontal().id_salt("prices").show(ui, |ui| table(ui, session, prices));
            let height = (0.8 * size.x).clamp(160.0, 400.0);
            ui.allocate_ui(vec2(size.x, height), |ui| chart::show(ui, session, gallery));
        });
        return;
    }
    ui.horizontal_top(|ui| {
        ui.allocate_ui(vec2(TABLE.min(0.5 * size.x), size.y), |ui| {
            ScrollArea::both().id_salt("prices").auto_shrink(false).show(ui, |ui| table(ui, session, prices));
        });
        ui.allocate_ui(ui.available_size(), |ui| chart::show(ui, session, gallery));
    });
}

fn table(ui: &mut Ui, session: &Session, prices: &[Price]) {
    let heads = [
        ("", "The ends as they are, and the middles between them"),
        ("ns", "Nanoseconds per evaluation here and now, three channels together, one thread; measured once"),
        ("× loop", "How many times the plain loop over a network's weights takes as long"),
        ("bytes", "What evaluation reads of it, where that is one network or one table"),
        ("code", "Numbers it is decoded from, where there is a code"),
    ];
    Grid::new("prices").striped(true).num_columns(heads.len()).spacing(vec2(12.0, 4.0)).show(ui, |ui| {
        for (head, about) in heads {
            ui.label(RichText::new(head).small().weak()).on_hover_text(about);
        }
        ui.end_row();
        for price in prices.iter().filter(|price| named::is_shown(price.card, session)) {
            let [_, ns, ratio, bytes, numbers] = cells(session, price);
            ui.label(RichText::new(session.title(price.card)).color(named::colour(price.card, ui.visuals())));
            for cell in [ns, ratio, bytes, numbers] {
                ui.label(cell);
            }
            ui.end_row();
        }
    });
}

fn cells(session: &Session, price: &Price) -> [String; 5] {
    let count = |count: Option<usize>| count.map_or("–".to_owned(), |count| count.to_string());
    [
        session.title(price.card),
        report::figure(price.cost.ns),
        report::figure(price.cost.ratio_to_reference_loop),
        count(price.bytes),
        count(price.numbers),
    ]
}

/// The table, and the chart where there is one, as rows.
pub fn sheet(session: &Session, prices: &[Price], gallery: &Gallery) -> Sheet {
    let shown = prices.iter().filter(|price| named::is_shown(price.card, session));
    let columns = ["model", "ns", "times reference loop", "bytes", "numbers", session.figures.metric.as_str()];
    let own = shown.map(|price| cells(session, price).into_iter().chain(["–".to_owned()]).collect());
    let rivals = gallery.curves.chart.iter().flat_map(|chart| &chart.rivals);
    let rows = rivals.map(|rival| {
        let point = &rival.point;
        let error = point.error.get(&session.figures.metric).map_or(f64::NAN, |band| band.mean);
        vec![
            point.title(),
            report::figure(point.times.ns),
            report::figure(point.times.ratio_to_reference_loop),
            point.bytes.to_string(),
            "–".to_owned(),
            error.to_string(),
        ]
    });
    Sheet::of_rows(&columns, own.chain(rows).collect())
}
