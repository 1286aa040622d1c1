//! The report for people.

use serde_json::Value;

use crate::measure::families::LOBES;
use crate::report;
use crate::report::table::Table;

/// The keys shown to people, and which part of their spread.
const SHOWN: [(&str, &str, &str); 9] = [
    ("end_error", "mean", "end_error"),
    ("mix_psnr", "median", "mix PSNR dB"),
    ("mix_psnr", "max", "worst"),
    ("mix_ssim", "mean", "mix SSIM"),
    ("length_ratio", "median", "length_ratio"),
    ("step_ratio", "median", "step_ratio"),
    ("hue_excursion", "max", "hue, worst"),
    ("energy_violations", "", "energy > 1"),
    ("energy_violations_beyond", "", "beyond"),
];

/// A table of all methods.
pub(super) fn text(reference: &str, pairs: usize, rows: &[Value]) -> String {
    let mut head = vec!["method".to_owned()];
    head.extend(SHOWN.iter().map(|(_, part, title)| match *part {
        "" | "max" => (*title).to_owned(),
        part => format!("{title} ({part})"),
    }));
    let with_families = rows.first().is_some_and(|row| !row["families"].is_null());
    if with_families {
        head.extend(LOBES.iter().map(|lobe| format!("{} middles{}", lobe.name, if lobe.trained { "" } else { "*" })));
    }
    let mut table = Table::new(head);
    for row in rows {
        let mut cells = vec![row["name"].as_str().unwrap_or_default().to_owned()];
        cells.extend(SHOWN.iter().map(|(key, part, _)| match *part {
            "" => row[*key].to_string(),
            part => report::figure(row[*key][part].as_f64().unwrap_or(f64::NAN)),
        }));
        if with_families {
            cells.extend(LOBES.iter().map(|lobe| report::figure(middle_of_lobe(row, lobe.name))));
        }
        table.push(cells);
    }
    let note = if with_families { "\n* kept out of training; middles: mean of four families\n" } else { "" };
    format!("{pairs} pairs of MERL materials, light: studio, reference: {reference}\n\n{table}{note}")
}

/// Mean error of the middles of the families with this lobe.
fn middle_of_lobe(row: &Value, lobe: &str) -> f64 {
    let families = row["families"].as_array().map(Vec::as_slice).unwrap_or_default();
    let errors: Vec<f64> = families
        .iter()
        .filter(|family| family["lobe"] == lobe)
        .filter_map(|family| family["middle"].as_f64())
        .collect();
    errors.iter().sum::<f64>() / errors.len().max(1) as f64
}
