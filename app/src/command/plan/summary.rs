//! A plan as a report.

use std::path::Path;

use nbrdf_core::plan::{By, Choice, Options, Plan, Planner, Totals};
use serde_json::{Value, json};

use super::Opened;
use crate::measure::planned::saved;
use crate::report;
use crate::report::table::Table;

/// The report of a plan that took so many seconds.
pub fn json(opened: &Opened, planner: &Planner, plan: &Plan, options: Options, seconds: f64) -> Value {
    let object = |(place, choice): (usize, &Choice)| {
        let own = &opened.scene.objects[place];
        let rung = &opened.ladder[choice.rung];
        let saved = choice.beside.map(|(ns, bytes)| {
            json!({"time": 1.0 - choice.ns / ns, "bytes": 1.0 - choice.bytes as f64 / bytes.max(1) as f64})
        });
        json!({
            "name": own.name, "material": opened.materials[opened.material[place]].name,
            "pixels": planner.pixels(place), "evaluations": planner.view().demands()[place].evaluations(),
            "model": rung.name, "error": choice.error, "ns": choice.ns, "bytes": choice.bytes,
            "shared_bytes": rung.shared.as_ref().map_or(0, |(_, bytes)| *bytes), "saved": saved,
            "unmet": choice.unmet.map(|(rung, error)| json!({"closest": opened.ladder[rung].name, "error": error})),
        })
    };
    let totals = |totals: &Totals| json!({"ns": totals.ns, "bytes": totals.bytes});
    let times = saved(plan);
    json!({
        "schema": 1, "scene": opened.path.display().to_string(), "tolerance": options.tolerance,
        "by": if options.by == By::Time { "time" } else { "bytes" },
        "objects": plan.choices.iter().enumerate().map(object).collect::<Vec<_>>(),
        "evaluations": plan.totals.evaluations, "planned": totals(&plan.totals),
        "nbrdf_everywhere": plan.beside.as_ref().map(totals),
        "times_faster": times.map(|[time, _]| time), "times_smaller": times.map(|[_, bytes]| bytes),
        "models_tried": plan.tried, "seconds": seconds,
    })
}

/// The same for people.
pub fn text(summary: &Value, picture: &Path) -> String {
    let head = ["object", "material", "pixels", "model", "FLIP", "ns", "time saved", "bytes", "saved", "shared kB"];
    let mut table = Table::new(head.map(str::to_owned).to_vec());
    let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let percent = |value: &Value| value.as_f64().map_or_else(|| "-".to_owned(), |v| format!("{:.0} %", 100.0 * v));
    let mut unmet = String::new();
    for object in summary["objects"].as_array().into_iter().flatten() {
        table.push(vec![
            word(&object["name"]),
            word(&object["material"]),
            object["pixels"].to_string(),
            word(&object["model"]),
            report::figure(number(&object["error"])),
            report::figure(number(&object["ns"])),
            percent(&object["saved"]["time"]),
            object["bytes"].to_string(),
            percent(&object["saved"]["bytes"]),
            format!("{:.0}", number(&object["shared_bytes"]) / 1e3),
        ]);
        if let Some(closest) = object["unmet"].as_object() {
            unmet += &format!(
                "{}: kept as it is, no other model that was tried is within the tolerance (closest: {} at {})\n",
                word(&object["name"]),
                word(&closest["closest"]),
                report::figure(number(&closest["error"]))
            );
        }
    }
    let total = |which: &str| {
        let total = &summary[which];
        format!("{:.1} ms, {} bytes", 1e-6 * number(&total["ns"]), total["bytes"])
    };
    format!(
        "{}: FLIP of {} at most, {} evaluations, one thread; saved: against the pruned NBRDF of the same material\n\n\
         {table}\n{unmet}\
         planned: {}; pruned NBRDF everywhere: {}: {:.2} times faster, {:.2} times smaller\n\
         {} models tried in {:.1} s; full, planned and difference in {}\n{}",
        word(&summary["scene"]),
        summary["tolerance"],
        summary["evaluations"],
        total("planned"),
        total("nbrdf_everywhere"),
        number(&summary["times_faster"]),
        number(&summary["times_smaller"]),
        summary["models_tried"],
        number(&summary["seconds"]),
        picture.display(),
        super::check::text(&summary["check"]),
    )
}
