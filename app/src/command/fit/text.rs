//! What is told of a fit.

use serde_json::Value;

use crate::report;

/// The report for people.
pub(super) fn text(summary: &Value) -> String {
    let word = |key: &str| summary[key].as_str().unwrap_or_default();
    let error = &summary["error"];
    let mut lines = vec![format!("{} in {}", word("material"), word("output"))];
    let figure = |value: &Value| report::figure(value.as_f64().unwrap_or(f64::NAN));
    if error["samples"].is_null() {
        lines.push(format!(
            "  log_error {}, studio PSNR {} dB",
            figure(&error["log_error"]),
            figure(&error["studio_psnr"])
        ));
    } else {
        let by = match error["folds"].as_u64() {
            Some(folds) => format!("each judged by a fit without it, {folds} fits"),
            None => "judged by those it was fitted to: --leave-out 10 says how it does elsewhere".to_owned(),
        };
        lines.push(format!(
            "  {} samples, {} below the horizon left out; {by}",
            error["samples"], error["below_horizon"]
        ));
        for (key, name) in [
            ("relative_error", "the network"),
            ("of_lambert_ggx", "a GGX lobe over a diffuse base"),
            ("of_lambert", "a diffuse base"),
        ] {
            let share = |part: &str| 100.0 * error[key][part].as_f64().unwrap_or(f64::NAN);
            let [mean, median, p90] = ["mean", "median", "p90"].map(share);
            lines.push(format!(
                "  off by {mean:6.1} % in the mean, {median:5.1} in the median, {p90:5.1} at 90 %: {name}"
            ));
        }
    }
    lines.join("\n") + "\n"
}
