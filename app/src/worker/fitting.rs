//! The thread that fits networks to measured files, one after the other.

use std::cell::Cell;
use std::path::Path;
use std::time::{Duration, Instant};

use nbrdf_core::measured::Measured;
use nbrdf_core::nbrdf::PUBLISHED_HIDDEN;
use nbrdf_core::nbrdf::fit::FitOptions;
use nbrdf_core::sampling::evaluate;

use super::cache::Kind;
use super::files::Desk;
use super::fits::Task;
use super::{Answer, guarded};
use crate::command::fit::judge::{relative_error, table_error};
use crate::fitted::{self, DIVERGED, Fitted};
use crate::measure::guard;

/// Steps between two questions whether to go on.
const STRIDE: usize = 64;
/// Between two looks at how far it is.
const PATIENCE: Duration = Duration::from_millis(100);

/// Fits whatever comes until the queue closes.
pub(super) fn run(desk: &Desk) {
    let office = &desk.office;
    while let Some(task) = desk.fits.next() {
        let _busy = office.activity.begin();
        let done = guarded("Fitting", || fit(desk, &task)).flatten();
        // Who cancelled it has been told.
        let is_wanted = desk.fits.remove(task.number).is_some();
        office.say(Answer::Jobs(desk.fits.shown()));
        match done {
            _ if !is_wanted => {}
            Ok((fitted, remark, key)) => {
                key.iter().for_each(|key| office.stock.cache.put(Kind::Network, key, &fitted.to_bytes()));
                desk.add(&task.path, vec![fitted.into_material(task.name)]);
                office.say(Answer::Notice(remark));
            }
            Err(why) => desk.lose(task.path, why),
        }
    }
}

/// The network, what to say of it, and what to keep it under.
fn fit(desk: &Desk, task: &Task) -> Result<(Fitted, String, Option<String>), String> {
    let office = &desk.office;
    let measured = Measured::load(&task.path).map_err(|error| error.to_string())?;
    // The file may have changed since it was queued; then nobody knows which of both was read.
    let key = task.key.clone().filter(|key| desk.key_of(&task.path).is_ok_and(|now| now.as_ref() == Some(key)));
    let turns = matches!(measured, Measured::Turning(_));
    let start = fitted::start(0, PUBLISHED_HIDDEN);
    let steps = office.stock.fit_steps;
    let options = FitOptions { steps, ..FitOptions::shared_start(0) };
    let (begun, asked, told) = (Instant::now(), Cell::new(0), Cell::new(None::<Instant>));
    let cancelled = || {
        let share = (STRIDE * asked.replace(asked.get() + 1)) as f32 / steps as f32;
        let left = (share > 0.0).then(|| begun.elapsed().as_secs_f64() * f64::from((1.0 - share) / share));
        let is_wanted = desk.fits.progress(task.number, share, left);
        if is_wanted && told.get().is_none_or(|at| at.elapsed() > PATIENCE) {
            told.set(Some(Instant::now()));
            office.say(Answer::Jobs(desk.fits.shown()));
        }
        !is_wanted
    };
    let fitted = Fitted::to(&measured, turns, &start, options, &cancelled)
        .ok_or_else(|| format!("{}: {DIVERGED}", task.path.display()))?;
    let remark = remark(&task.path, &measured, &fitted);
    Ok((fitted, format!("{}: {remark}", task.name), key))
}

/// How close the fit comes to the file.
fn remark(path: &Path, measured: &Measured, fitted: &Fitted) -> String {
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let (closeness, warning) = match measured {
        Measured::Everywhere(table) | Measured::Turning(table) => {
            let turns = matches!(measured, Measured::Turning(_));
            let error = table_error(table.as_ref(), fitted.brdf(), turns);
            let figure = |key: &str| error[key].as_f64().unwrap_or(f64::NAN);
            let turned = if turns { "; it changes when it is turned, which codes do not carry" } else { "" };
            let (log_error, psnr) = (figure("log_error"), figure("studio_psnr"));
            let closeness = format!("log_error {log_error:.4}, studio PSNR {psnr:.1} dB{turned}");
            (closeness, guard::of_source(table.as_ref()).next())
        }
        Measured::Somewhere(list) => {
            let error = relative_error(list, &evaluate(fitted.brdf(), &list.at));
            let share = |key: &str| 100.0 * error.as_ref().and_then(|error| error[key].as_f64()).unwrap_or(f64::NAN);
            let (mean, median) = (share("mean"), share("median"));
            let closeness =
                format!("off by {mean:.1} % in the mean, {median:.1} % in the median of {} samples", list.len());
            (closeness, guard::of_samples(list.len(), fitted.weights().len()))
        }
    };
    let warning = warning.map_or_else(String::new, |warning| format!(". {warning}"));
    format!("fitted to {file}, {closeness}{warning}")
}
