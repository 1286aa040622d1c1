//! The report for people.

use nbrdf_core::Split;
use serde_json::Value;

use crate::report;
use crate::report::table::Table;

/// The keys shown to people; the JSON holds all.
const SHOWN: [(&str, &str); 8] = [
    ("log_error", "log_error"),
    ("relative_log", "relative_log"),
    ("point_psnr", "point PSNR dB"),
    ("studio_psnr", "studio PSNR dB"),
    ("studio_ssim", "studio SSIM"),
    ("studio_flip", "studio FLIP"),
    ("studio_delta_e_itp", "studio dE_ITP"),
    ("encode_s", "encode s"),
];

/// A table of all representations.
pub(super) fn text(reference: &str, split: Split, rows: &[Value]) -> String {
    let of = if split == Split::HeldOut { "held-out" } else { "validation" };
    let mut head = vec!["representation".to_owned(), "database".to_owned()];
    head.extend(SHOWN.iter().map(|(_, title)| (*title).to_owned()));
    head.push("ns per evaluation".to_owned());
    let mut table = Table::new(head);
    for row in rows {
        let word = |key: &str| row[key].as_str().unwrap_or_default().to_owned();
        let mut cells = vec![format!("{} {}", word("name"), word("variant")), word("database")];
        cells.extend(SHOWN.iter().map(|(key, _)| {
            let number = |part: &str| row[*key][part].as_f64().unwrap_or(f64::NAN);
            format!("{} ({})", report::figure(number("mean")), report::figure(number("max")))
        }));
        cells.push(report::figure(row["ns"].as_f64().unwrap_or(f64::NAN)));
        table.push(cells);
    }
    format!("Mean (worst) over {of} materials, reference: {reference}\n\n{table}")
}
