//! Where one object's model switches as the camera moves away, and back.

use std::path::Path;

use anyhow::Result;
use nbrdf_core::plan::{Followed, LEAVES, Models, Options, Planner, TAKES_OVER, Watch};
use serde::Serialize;
use serde_json::json;

use super::curve::{Curve, Lines, Point};
use super::{Opened, look};
use crate::command::Global;
use crate::failure::Failure;
use crate::report::table::Table;
use crate::{progress, report};

/// Steps of the distance, each this many times the one before: three to an octave, sixteen times as far.
const STEPS: usize = 13;
const STEP: f64 = 1.259_921_049_894_873;
/// A step within which the picture would be seen to change is halved as long as it is longer.
const SHORTEST: f64 = 1.02;
/// Objects of fewer pixels are specks, of which a mean says nothing.
const FEWEST_PIXELS: usize = 16;

/// The object at one distance.
#[derive(Serialize)]
struct Row {
    way: &'static str,
    distance: f64,
    pixels: usize,
    model: String,
    error: f64,
    ns: f64,
    change: Option<f64>,
}

/// One object on its way.
struct Journey<'a> {
    opened: &'a Opened,
    models: &'a Models<'a>,
    object: usize,
    options: Options,
    global: &'a Global,
    before: Option<usize>,
    rows: Vec<Row>,
}

/// Follows an object out and back, by time.
pub fn sweep(opened: &Opened, object: usize, options: Options, output: &Path, global: &Global) -> Result<()> {
    let models = Models::new(&opened.materials, &opened.ladder);
    let mut journey = Journey { opened, models: &models, object, options, global, before: None, rows: Vec::new() };
    let bar = progress::bar(2 * STEPS as u64, "distances", global.quiet);
    let mut factors = Vec::new();
    for step in 0..STEPS {
        let factor = STEP.powi(step as i32);
        bar.inc(1);
        if !journey.go("out", factors.last().copied().unwrap_or(factor), factor)? {
            break;
        }
        factors.push(factor);
    }
    if factors.is_empty() {
        let (file, name) = (opened.path.display(), &opened.scene.objects[object].name);
        return Err(Failure::InvalidFile(format!(
            "{file}: expected an object of {FEWEST_PIXELS} pixels or more, found fewer of '{name}': move the camera"
        ))
        .into());
    }
    let mut from = factors[factors.len() - 1];
    for factor in factors.iter().rev().copied() {
        journey.go("back", from, factor)?;
        from = factor;
        bar.inc(1);
    }
    bar.finish_and_clear();
    let rows = journey.rows;
    let name = &opened.scene.objects[object].name;
    let switches = rows.iter().filter(|row| row.change.is_some()).count();
    let largest = rows.iter().filter_map(|row| row.change).fold(0.0, f64::max);
    let summary = json!({
        "schema": 1, "scene": opened.path.display().to_string(), "object": name, "tolerance": options.tolerance,
        "rows": rows, "switches": switches, "largest_change": largest,
    });
    chart(name, &rows, options, largest).write(output)?;
    report::print(global, &summary, || text(name, &rows, switches, largest, output))
}

impl Journey<'_> {
    /// To a distance from that before, in halves where the picture would be seen to change; whether the object is large
    /// enough there.
    fn go(&mut self, way: &'static str, from: f64, to: f64) -> Result<bool> {
        let view = look::from(self.opened, &self.opened.scene.from_afar(self.object, to), self.global)?;
        if view.pixels_of(self.object).len() < FEWEST_PIXELS {
            return Ok(false);
        }
        let planner = Planner::new(&view, self.models, &self.opened.material)?;
        let pixels = planner.pixels(self.object);
        let watch = Watch { tried: &|_, _| {}, cancelled: &progress::cancelled };
        let Followed { rung, error, ns, change } = planner.follow(self.object, self.before, self.options, &watch)?;
        let is_long = (to / from).max(from / to) > SHORTEST;
        if is_long && change.is_some_and(|change| change > self.options.tolerance) {
            let between = (from * to).sqrt();
            return Ok(self.go(way, from, between)? && self.go(way, between, to)?);
        }
        self.before = Some(rung);
        let model = self.opened.ladder[rung].name.clone();
        self.rows.push(Row { way, distance: to, pixels, model, error, ns, change });
        Ok(true)
    }
}

fn chart(name: &str, rows: &[Row], options: Options, largest: f64) -> Curve {
    let points = |way: &str, value: &dyn Fn(&Row) -> f64| -> Vec<Point> {
        let mut points: Vec<Point> = Vec::new();
        let mut model = "";
        for row in rows.iter().filter(|row| row.way == way) {
            let label = if row.model == model { String::new() } else { row.model.clone() };
            let (distance, error) = (report::figure(row.distance), report::figure(row.error));
            let about = format!("{distance} times as far, {} pixels: {}, FLIP {error}", row.pixels, row.model);
            points.push(Point { x: row.distance, y: value(row), label, about });
            model = &row.model;
        }
        points.sort_by(|a, b| a.x.total_cmp(&b.x));
        points
    };
    let lines = |title: &str, y_label: &str, is_straight, value: &dyn Fn(&Row) -> f64| Lines {
        title: title.into(),
        y_label: y_label.into(),
        is_straight,
        lines: vec![("moving away".into(), points("out", value)), ("coming back".into(), points("back", value))],
    };
    let mut models: Vec<&str> = rows.iter().filter(|row| row.way == "out").map(|row| row.model.as_str()).collect();
    models.dedup();
    Curve {
        title: format!("'{name}' takes {} as it recedes", models.join(", then ")),
        subtitle: format!(
            "a cheaper model takes over below {:.0} % of FLIP {} and leaves above {:.0} %; {}",
            100.0 * TAKES_OVER,
            options.tolerance,
            100.0 * LEAVES,
            match rows.iter().any(|row| row.change.is_some()) {
                true => format!("a switch changes the picture by {} at most", report::figure(largest)),
                false => "no switch".to_owned(),
            }
        ),
        x_label: "distance from the camera, times that of the scene".into(),
        panels: vec![
            lines("Evaluation", "ns", false, &|row| row.ns),
            lines("Error", "mean FLIP on its pixels", true, &|row| row.error),
        ],
    }
}

fn text(name: &str, rows: &[Row], switches: usize, largest: f64, output: &Path) -> String {
    let head = ["way", "distance", "pixels", "model", "FLIP", "ns", "change"];
    let mut table = Table::new(head.map(str::to_owned).to_vec());
    for row in rows {
        table.push(vec![
            row.way.to_owned(),
            report::figure(row.distance),
            row.pixels.to_string(),
            row.model.clone(),
            report::figure(row.error),
            report::figure(row.ns),
            row.change.map_or_else(|| "-".to_owned(), report::figure),
        ]);
    }
    format!(
        "{name}\n\n{table}\n{switches} switches out and back, the largest changes the picture by FLIP {}; chart in {}\n",
        report::figure(largest),
        output.display()
    )
}
