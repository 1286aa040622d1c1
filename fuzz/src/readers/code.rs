//! Texts in JSON: codes, reports of charts and of stress.

use autoencoder::{Architecture, Autoencoder};
use nbrdf::command::{chart, stress};
use nbrdf::material::parse_code;
use nbrdf::report::saved::SavedReport;
use nbrdf_core::Representation;

use super::assert_reflects;

/// A code; one of the built-in autoencoder is decoded, whatever mark it carries.
pub fn code(bytes: &[u8]) -> bool {
    let Ok(mut code) = parse_code("code.json", bytes) else { return false };
    let model = Autoencoder::built_in(Architecture::Znbrdf);
    code.checkpoint = model.checkpoint().to_owned();
    if let Ok(decoded) = model.decode(&code) {
        assert_reflects(decoded.as_ref());
        assert!(model.distance(&code).unwrap().is_some_and(|distance| distance >= 0.0));
    }
    true
}

/// A chart's report, which is drawn.
pub fn chart_report(bytes: &[u8]) -> bool {
    let Ok(saved) = chart::Saved::parse("chart.json", bytes) else { return false };
    if saved.check_metric("log_error").is_ok() {
        let svg = chart::scatter(&saved, "log_error", false).svg();
        assert!(svg.starts_with("<svg") && !svg.contains("NaN"), "{svg}");
        assert_eq!(saved.json("log_error")["schema"], 1);
    }
    true
}

/// A report of the stress test, which is drawn.
pub fn stress_report(bytes: &[u8]) -> bool {
    let Ok(saved) = stress::Saved::parse("stress.json", bytes) else { return false };
    let [page, map] = stress::drawn(&saved);
    assert!(page.starts_with("<!doctype html>") && map.starts_with("<svg") && !map.contains("NaN"));
    assert_eq!(saved.json()["schema"], 1);
    true
}
