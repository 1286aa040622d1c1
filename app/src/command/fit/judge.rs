//! How close a fit comes to what was measured.

use nbrdf_core::Brdf;
use nbrdf_core::metric::{ImageMetric, Metric, Rendered, log_error};
use nbrdf_core::representation::analytic::{Analytic, GgxLobe, LambertAlone, Parametric};
use nbrdf_core::sample_list::SampleList;
use nbrdf_core::sampling::{evaluate, rus32k, turned_rus32k};
use serde_json::{Value, json};

/// Over a table; of a material that changes when it is turned, all around.
pub fn table_error(table: &dyn Brdf, fitted: &dyn Brdf, turns: bool) -> Value {
    let all_around;
    let at = match turns {
        true => {
            all_around = turned_rus32k();
            all_around.as_slice()
        }
        false => rus32k(),
    };
    let log_error = log_error(at, &evaluate(table, at), &evaluate(fitted, at));
    json!({"log_error": log_error, "studio_psnr": Rendered::studio(ImageMetric::Psnr).distance(table, fitted)})
}

/// Over samples, beside formulas that were fitted to the same ones.
pub fn samples_error(fitted_to: &SampleList, judged: &SampleList, fitted: &dyn Brdf) -> Value {
    json!({
        "samples": fitted_to.len(), "judged": judged.len(), "below_horizon": fitted_to.below,
        "mean_relative_error": relative_error(judged, fitted),
        "of_lambert": formula_error::<LambertAlone>(fitted_to, judged),
        "of_lambert_ggx": formula_error::<GgxLobe>(fitted_to, judged),
    })
}

/// Mean over samples and channels of |found − measured| / measured, those below a thousandth of the mean left out;
/// none where nothing is left.
fn relative_error(list: &SampleList, brdf: &dyn Brdf) -> Option<f64> {
    let found = evaluate(brdf, &list.at);
    let pairs = || list.values.iter().zip(&found).flat_map(|(a, b)| a.0.into_iter().zip(b.0));
    let floor = 1e-3 * pairs().map(|(a, _)| f64::from(a)).sum::<f64>() / (3 * list.len()) as f64;
    let (sum, count) = pairs()
        .filter(|(a, _)| f64::from(*a) > floor)
        .fold((0.0, 0_usize), |(sum, count), (a, b)| (sum + f64::from((b - a).abs() / a), count + 1));
    (count > 0).then(|| sum / count as f64)
}

/// The same of a formula fitted to the same samples.
fn formula_error<P: Parametric>(fitted: &SampleList, judged: &SampleList) -> Option<f64> {
    Analytic::<P>::fit_list(fitted).and_then(|brdf| relative_error(judged, brdf.as_ref()))
}
