//! How close a fit comes to what was measured.

use anyhow::Result;
use nbrdf_core::metric::{ImageMetric, Metric, Rendered, Spread, log_error};
use nbrdf_core::representation::analytic::{Analytic, GgxLobe, LambertAlone, Parametric};
use nbrdf_core::sample_list::SampleList;
use nbrdf_core::sampling::{evaluate, rus32k, turned_rus32k};
use nbrdf_core::{Brdf, Rgb};
use serde_json::{Value, json};

use crate::fitted::Fitted;

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

/// Over samples, beside formulas. With `folds`, each sample is judged by a fit that has not seen it nor any other of its
/// fold (every `folds`-th sample); else by `fitted`, which has seen all.
pub fn samples_error(
    list: &SampleList,
    folds: Option<usize>,
    fitted: &dyn Brdf,
    refit: &dyn Fn(&SampleList) -> Result<Fitted>,
) -> Result<Value> {
    let network = match folds {
        None => Some(evaluate(fitted, &list.at)),
        Some(folds) => found(list, folds, &|rest, out| Ok(Some(evaluate(refit(rest)?.brdf(), &out.at))))?,
    };
    Ok(json!({
        "samples": list.len(), "folds": folds, "below_horizon": list.below,
        "relative_error": network.and_then(|found| relative_error(list, &found)),
        "of_lambert_ggx": formula_error::<GgxLobe>(list, folds)?,
        "of_lambert": formula_error::<LambertAlone>(list, folds)?,
    }))
}

/// Values at the second samples of a fit to the first ones; none where that fails.
type Refit<'a> = dyn Fn(&SampleList, &SampleList) -> Result<Option<Vec<Rgb>>> + 'a;

/// What is found at the samples left out, fold by fold, in the order of the list; none where a fit fails.
fn found(list: &SampleList, folds: usize, fit: &Refit) -> Result<Option<Vec<Rgb>>> {
    let mut all = vec![Rgb::BLACK; list.len()];
    for fold in 0..folds.min(list.len()) {
        let [out, rest] = list.split(folds, fold);
        let Some(values) = fit(&rest, &out)? else { return Ok(None) };
        all.iter_mut().skip(fold).step_by(folds).zip(values).for_each(|(all, value)| *all = value);
    }
    Ok(Some(all))
}

/// Mean, median and 90th percentile of |found − measured| / measured over samples and channels, those below a thousandth of
/// the mean left out; none where nothing is left.
pub fn relative_error(list: &SampleList, found: &[Rgb]) -> Option<Value> {
    let pairs = || list.values.iter().zip(found).flat_map(|(a, b)| a.0.into_iter().zip(b.0));
    let floor = 1e-3 * pairs().map(|(a, _)| f64::from(a)).sum::<f64>() / (3 * list.len()) as f64;
    let seen = pairs().filter(|(a, _)| f64::from(*a) > floor);
    let errors = seen.map(|(a, b)| (String::new(), f64::from((b - a).abs() / a)));
    let Spread { mean, median, p90, .. } = Spread::new(errors, false)?;
    Some(json!({"mean": mean, "median": median, "p90": p90}))
}

/// The same of a formula.
fn formula_error<P: Parametric>(list: &SampleList, folds: Option<usize>) -> Result<Option<Value>> {
    let values = |fitted_to: &SampleList, judged: &SampleList| {
        Ok(Analytic::<P>::fit_list(fitted_to).map(|brdf| evaluate(brdf.as_ref(), &judged.at)))
    };
    let found = match folds {
        None => values(list, list)?,
        Some(folds) => found(list, folds, &values)?,
    };
    Ok(found.and_then(|found| relative_error(list, &found)))
}
