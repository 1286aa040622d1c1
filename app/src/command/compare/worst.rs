//! Pictures of the pairs on which a method is worst.

use std::path::Path;

use anyhow::{Context, Result};
use nbrdf_core::metric::{ImageMetric, badness};
use nbrdf_core::render::Light;
use nbrdf_core::{Image, Interpolation, Material, Weights};
use rayon::prelude::*;

use super::Measured;
use crate::measure::higher_is_better;
use crate::report;
use crate::strip::{Cell, Row, Strip, ground};

/// Rows of a picture.
const ROWS: usize = 10;
/// Spheres of a row, from end to end.
const STEPS: u8 = 7;
/// Side of a sphere \[pixels\].
const SIZE: usize = 96;

/// Writes `folder/method.png`: a row of spheres for each of the ten worst pairs by `key`, the worst first.
pub fn draw(
    folder: &Path,
    method: &dyn Interpolation,
    title: &str,
    pairs: &[[Material; 2]],
    measured: &[Measured],
    key: &str,
) -> Result<()> {
    let figure = |i: usize| measured[i].figures.get(key).copied().unwrap_or(f64::NAN);
    let bad = |&i: &usize| badness(figure(i), higher_is_better(key));
    let mut order: Vec<usize> = (0..measured.len()).collect();
    order.sort_by(|a, b| bad(b).total_cmp(&bad(a)));
    order.truncate(ROWS);
    let cell = Cell::new(SIZE, &Light::studio());
    let row = |&i: &usize| -> Result<Row> {
        let path = method.between(&pairs[i])?;
        let sphere = |t: f32| -> Result<Image> { Ok(cell.draw(path.at(&Weights::two(t))?.as_ref(), 1.0, ground())) };
        let spheres = places().map(sphere).collect::<Result<_>>()?;
        Ok(Row { title: measured[i].pair.clone(), name: format!("{key} {}", report::figure(figure(i))), spheres })
    };
    let strip = Strip {
        heading: format!("{title}: the {} worst of {} pairs by {key}", order.len(), measured.len()),
        remark: format!("studio light; {}", unit(key)),
        columns: places().map(|t| format!("t = {t:.2}")).collect(),
        rows: order.par_iter().map(row).collect::<Result<_>>()?,
    };
    let file = folder.join(format!("{}.png", method.name()));
    strip.labelled().write_png(&file).with_context(|| file.display().to_string())
}

/// Of the spheres on a path.
fn places() -> impl Iterator<Item = f32> {
    (0..STEPS).map(|step| f32::from(step) / f32::from(STEPS - 1))
}

fn unit(key: &str) -> &'static str {
    match key.trim_start_matches("mix_") {
        metric if metric == ImageMetric::Psnr.name() => "the middle against the linear mix, dB, more is closer",
        "hue_excursion" => "largest distance in u'v' from the colours between the ends",
        "length_ratio" => "length of the path in dE_ITP over the distance of its ends",
        "step_ratio" => "largest step in dE_ITP over the mean step",
        _ => "worst first",
    }
}
