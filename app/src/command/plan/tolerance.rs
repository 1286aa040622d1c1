//! What the whole frame costs over the tolerance.

use std::path::Path;

use anyhow::Result;
use nbrdf_core::plan::{Models, Options, Planner};
use serde_json::{Value, json};

use super::curve::{Curve, Lines, Point};
use super::{Opened, look, watched};
use crate::command::Global;
use crate::report;
use crate::report::table::Table;

/// Tolerances, from what is hardly seen to what is hardly bearable.
const TOLERANCES: [f64; 11] = [0.005, 0.0075, 0.01, 0.015, 0.02, 0.03, 0.04, 0.06, 0.08, 0.12, 0.16];

/// Plans for every tolerance; models and errors are found once.
pub fn sweep(opened: &Opened, options: Options, output: &Path, global: &Global) -> Result<()> {
    let view = look::whole(opened, global)?;
    let models = Models::new(&opened.materials, &opened.ladder);
    let planner = Planner::new(&view, &models, &opened.material)?;
    let mut rows: Vec<Value> = Vec::new();
    for tolerance in TOLERANCES {
        let plan = watched(&planner, Options { tolerance, ..options }, global)?;
        let worst = plan.choices.iter().map(|choice| choice.error).fold(0.0, f64::max);
        let chosen: Vec<&str> = plan.choices.iter().map(|choice| opened.ladder[choice.rung].name.as_str()).collect();
        rows.push(json!({
            "tolerance": tolerance, "ns": plan.totals.ns, "bytes": plan.totals.bytes, "worst_error": worst, "models": chosen,
            "nbrdf_everywhere": plan.beside.map(|full| json!({"ns": full.ns, "bytes": full.bytes})),
        }));
    }
    let summary = json!({
        "schema": 1, "scene": opened.path.display().to_string(), "rows": rows,
    });
    let number = |row: &Value, key: &str| row[key].as_f64().unwrap_or(f64::NAN);
    // Times of one row are of one run.
    let share = |row: &Value, key: &str| number(row, key) / number(&row["nbrdf_everywhere"], key);
    let points = |key: &str| -> Vec<Point> {
        let point = |row: &Value| Point {
            x: number(row, "tolerance"),
            y: share(row, key),
            label: String::new(),
            about: format!("FLIP {}: {} {key}", row["tolerance"], row[key]),
        };
        rows.iter().map(point).collect()
    };
    let at = |tolerance: f64| rows.iter().find(|row| row["tolerance"] == json!(tolerance));
    let title = at(0.04).map_or_else(String::new, |row| {
        format!(
            "Within FLIP 0.04 the frame takes {:.0} % of the time and {:.0} % of the bytes",
            100.0 * share(row, "ns"),
            100.0 * share(row, "bytes")
        )
    });
    let lines = |title: &str, y_label: &str, points: Vec<Point>| Lines {
        title: title.into(),
        y_label: y_label.into(),
        is_straight: false,
        lines: vec![("planned".into(), points)],
    };
    let curve = Curve {
        title,
        subtitle: format!("{}: planned models against pruned NBRDF everywhere", opened.path.display()),
        x_label: "tolerance: mean FLIP on every object's pixels, at most".into(),
        panels: vec![
            lines("Evaluation", "time, share of NBRDF's", points("ns")),
            lines("Storage", "bytes, share of NBRDF's", points("bytes")),
        ],
    };
    curve.write(output)?;
    report::print(global, &summary, || {
        let mut table = Table::new(
            ["tolerance", "ms", "bytes", "worst FLIP", "times faster", "times smaller"].map(str::to_owned).to_vec(),
        );
        for row in &rows {
            table.push(vec![
                row["tolerance"].to_string(),
                format!("{:.1}", 1e-6 * number(row, "ns")),
                row["bytes"].to_string(),
                report::figure(number(row, "worst_error")),
                format!("{:.2}", 1.0 / share(row, "ns")),
                format!("{:.2}", 1.0 / share(row, "bytes")),
            ]);
        }
        format!("{}\n\n{table}\ncurve in {}\n", opened.path.display(), output.display())
    })
}
