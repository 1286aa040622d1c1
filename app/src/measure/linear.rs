//! What linear models make of materials: how close they come, and which of the points they span could exist.
//!
//! W. Matusik et al., *A Data-Driven Reflectance Model* (2003), sections 5 and 6: a subspace holds all measured materials,
//! and between them much that is none. Judged for the first k of all components, for every kind of values: held-out
//! materials, middles between training materials, and points drawn from the Gaussian of the training codes.

mod places;

use anyhow::Result;
use nbrdf_core::metric::{Spread, log_error};
use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::representation::pca_tables::{PcaOptions, PcaTables};
use nbrdf_core::representation::span::Span;
use nbrdf_core::representation::values::Values;
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Material, Representation, Rgb};
use rand::RngExt;
use rayon::prelude::*;
use serde::Serialize;

use super::standard_pairs;
use crate::progress;
use places::{Physics, Places};

/// Numbers of components; those beyond what so many training materials span are left out.
const COUNTS: [usize; 10] = [1, 2, 5, 10, 15, 20, 32, 45, 60, 79];
/// A point that is clearly negative in a larger share of directions than this counts as negative.
const NEGATIVE: f64 = 0.01;
/// Share of the training materials that are nearer to their nearest than a point must be to count as near.
const NEAR: f64 = 0.9;
/// Stream of the drawn points' random numbers.
const STREAM: u64 = 60;

/// Points of one sort at one number of components.
#[derive(Debug, Serialize)]
pub struct Group {
    /// Points.
    pub count: usize,
    /// Mean `negative_share`, before the clamp at zero.
    pub negative_share: f64,
    /// Share of points whose f cos θ_i is below −10⁻³ in more than a hundredth of directions: what logarithms of f cos θ_i
    /// never are, and those relative to the median only where the view is grazing.
    pub negative: f64,
    /// Lowest f cos θ_i of any point \[1/sr\].
    pub lowest: f64,
    /// Share of points from which more light leaves than arrives (`albedo_max` > 1, after the clamp).
    pub violating: f64,
    /// Median distance to the nearest training material in the code, in median distances of these to their nearest.
    pub apart: f64,
    /// Share of points further from the nearest training material than nine in ten of these are from theirs.
    pub off: f64,
    /// `log_error`, of materials that have a true reflectance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log_error: Option<Spread>,
}

/// One number of components.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Components.
    pub components: usize,
    /// Held-out materials, projected.
    pub held_out: Group,
    /// Middles of pairs of training codes.
    pub between: Group,
    /// Drawn from the Gaussian of the training codes.
    pub drawn: Group,
}

/// One kind of values.
#[derive(Debug, Serialize)]
pub struct Kind {
    /// What the tables hold.
    pub values: Values,
    /// By rising number of components.
    pub rows: Vec<Row>,
}

/// One point at one number of components.
struct Judged {
    physics: Physics,
    /// Distance to the nearest training material.
    distance: f64,
    log_error: Option<f64>,
}

/// A code, and the material it stands for where there is one.
struct Point<'a> {
    code: Vec<f32>,
    truth: Option<(&'a str, Vec<Rgb>)>,
}

/// Learns one kind from the training materials and judges what it spans; `done` is called after each of
/// `points(training, held out, draws)`.
pub fn linear(
    values: Values,
    training: &[Material],
    held_out: &[&Material],
    (draws, seed): (usize, u64),
    done: &(dyn Fn() + Sync),
) -> Result<Kind> {
    let largest = training.len().saturating_sub(1);
    let counts: Vec<usize> = COUNTS.into_iter().filter(|count| *count <= largest).collect();
    let components = counts.last().copied().unwrap_or(1);
    let tables =
        PcaTables::learn(training, PcaOptions { name: values.name(), components, values, ..PcaOptions::PROTOCOL })?;
    progress::check()?;
    let places = Places::new();
    let span = Span::new(&tables, places.at());
    let encode = |material: &Material| tables.encode(material).map(|code| code.code);
    let codes = training.iter().map(encode).collect::<Result<Vec<_>, _>>()?;
    let known = Known::new(&codes, &counts);
    let judge = |point: &Point| -> Result<Vec<Judged>> {
        progress::check()?;
        let mut judged = Vec::with_capacity(counts.len());
        span.prefixes(&point.code, &counts, |place, signed| {
            let physics = places.judge(signed);
            let log_error = point.truth.as_ref().map(|(_, truth)| {
                let clamped: Vec<Rgb> = signed[..rus32k().len()].iter().map(|f| f.map(|f| f.max(0.0))).collect();
                log_error(rus32k(), truth, &clamped)
            });
            judged.push(Judged { physics, distance: known.distance(place, &point.code), log_error });
        });
        done();
        Ok(judged)
    };
    let of = |points: Vec<Point>| -> Result<Vec<Group>> {
        let judged = points.par_iter().map(judge).collect::<Result<Vec<_>>>()?;
        Ok((0..counts.len()).map(|place| group(&points, &judged, place, &known)).collect())
    };
    let projected = held_out.iter().map(|material| {
        let values = evaluate(material.brdf.as_ref(), rus32k());
        Ok(Point { code: encode(material)?, truth: Some((material.name.as_str(), values)) })
    });
    let held_out = of(projected.collect::<Result<_>>()?)?;
    let between = of(middles(&codes))?;
    let drawn = of(gaussian(&codes, draws, seed))?;
    let groups = held_out.into_iter().zip(between).zip(drawn).zip(&counts);
    let row = |(((held_out, between), drawn), &components)| Row { components, held_out, between, drawn };
    Ok(Kind { values, rows: groups.map(row).collect() })
}

/// How many points [`linear`] judges.
pub fn points(training: usize, held_out: usize, draws: usize) -> usize {
    held_out + standard_pairs(training).count() + draws
}

fn group(points: &[Point], judged: &[Vec<Judged>], place: usize, known: &Known) -> Group {
    let here = || judged.iter().map(|judged| &judged[place]);
    let count = points.len();
    let share = |is: &dyn Fn(&Judged) -> bool| here().filter(|point| is(point)).count() as f64 / count.max(1) as f64;
    let named = points.iter().zip(here());
    let errors = named.filter_map(|(point, judged)| Some((point.truth.as_ref()?.0, judged.log_error?)));
    let [typical, far] = known.neighbours[place];
    let mut distances: Vec<f64> = here().map(|point| point.distance).collect();
    Group {
        count,
        negative_share: here().map(|point| point.physics.negative_share).sum::<f64>() / count.max(1) as f64,
        negative: share(&|point| point.physics.clearly_negative_share > NEGATIVE),
        lowest: here().map(|point| point.physics.lowest).fold(f64::INFINITY, f64::min),
        violating: share(&|point| point.physics.albedo_max > 1.0),
        apart: quantile(&mut distances, 0.5) / typical.max(f64::MIN_POSITIVE),
        off: share(&|point| point.distance > far),
        log_error: Spread::new(errors, false),
    }
}

/// Training codes, and for every number of components how far one is from its nearest: the median, and what nine in ten
/// are within.
struct Known<'a> {
    codes: &'a [Vec<f32>],
    counts: &'a [usize],
    neighbours: Vec<[f64; 2]>,
}

impl<'a> Known<'a> {
    fn new(codes: &'a [Vec<f32>], counts: &'a [usize]) -> Self {
        let nearest = |i: usize, count: usize| {
            let others = codes.iter().enumerate().filter(|(j, _)| *j != i);
            others.map(|(_, other)| distance(&codes[i], other, count)).fold(f64::INFINITY, f64::min)
        };
        let neighbours = |&count: &usize| {
            let mut distances: Vec<f64> = (0..codes.len()).map(|i| nearest(i, count)).collect();
            [0.5, NEAR].map(|share| quantile(&mut distances, share))
        };
        Self { codes, counts, neighbours: counts.iter().map(neighbours).collect() }
    }

    fn distance(&self, place: usize, code: &[f32]) -> f64 {
        let distances = self.codes.iter().map(|known| distance(known, code, self.counts[place]));
        distances.fold(f64::INFINITY, f64::min)
    }
}

fn distance(a: &[f32], b: &[f32], count: usize) -> f64 {
    a.iter().zip(b).take(count).map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>().sqrt()
}

/// At `share` of the way from the lowest to the highest rank; sorts the values.
fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let rank = share * values.len().saturating_sub(1) as f64;
    let at = |rank: f64| values.get(rank as usize).copied().unwrap_or(f64::NAN);
    at(rank.floor()) + rank.fract() * (at(rank.ceil()) - at(rank.floor()))
}

fn middles(codes: &[Vec<f32>]) -> Vec<Point<'static>> {
    let middle = |(i, j): (usize, usize)| codes[i].iter().zip(&codes[j]).map(|(a, b)| 0.5 * (a + b)).collect();
    standard_pairs(codes.len()).map(|pair| Point { code: middle(pair), truth: None }).collect()
}

/// Mean + Σ gᵢ (codeᵢ − mean) / √n with normal gᵢ: the Gaussian of the codes' own mean and covariance, and of any first
/// numbers of theirs.
fn gaussian(codes: &[Vec<f32>], draws: usize, seed: u64) -> Vec<Point<'static>> {
    let n = codes.len() as f64;
    let numbers = codes.first().map_or(0, Vec::len);
    let mean = |k: usize| codes.iter().map(|code| f64::from(code[k])).sum::<f64>() / n;
    let mean: Vec<f64> = (0..numbers).map(mean).collect();
    let mut rng = generator(seed, STREAM);
    let draw = |_| {
        let mut code = mean.clone();
        for known in codes {
            // Box and Muller (1958); 1 − u is never 0.
            let [u, turn]: [f64; 2] = [rng.random(), rng.random()];
            let normal = (-2.0 * (1.0 - u).ln()).sqrt() * (std::f64::consts::TAU * turn).cos();
            for ((number, known), mean) in code.iter_mut().zip(known).zip(&mean) {
                *number += normal / n.sqrt() * (f64::from(*known) - mean);
            }
        }
        Point { code: code.into_iter().map(|v| v as f32).collect(), truth: None }
    };
    (0..draws).map(draw).collect()
}

#[cfg(test)]
mod tests;
