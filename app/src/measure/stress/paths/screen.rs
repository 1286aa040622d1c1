//! All pairs of materials: screened by values at few directions, the worst of them rendered.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::metric::image_errors;
use nbrdf_core::path::PathError;
use nbrdf_core::render::Sphere;
use nbrdf_core::sampling::rus32k;
use nbrdf_core::{Brdf, Directions, Image, Interpolation, Material, Path, Rgb, Warning, Weights};
use rayon::prelude::*;

use super::super::picture::View;
use super::super::tally::{Look, Tally};
use super::super::{Cell, Setup};
use super::{FAR_ENDS, WORST_PAIR, Walker};
use crate::catalog::Catalog;

/// Every so many directions of rus32k.
const THINNED: usize = 32;
/// The farthest pairs: every so many of all.
const FARTHEST: usize = 100;

/// Pairs, and how far their ends are from each other.
pub(super) struct Screening<'a> {
    setup: &'a Setup<'a>,
    at: Vec<Directions>,
    /// Places of the ends.
    pairs: Vec<(usize, usize)>,
    /// The pairs that are farthest apart.
    farthest: Vec<usize>,
}

/// ln(1 + f cos) at the thinned directions.
type Seen = Vec<f32>;

fn distance(a: &Seen, b: &Seen) -> f64 {
    a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs())).sum::<f64>() / a.len() as f64
}

/// Where a walk by code or weights is as straight between all ends as between two, all are prepared at once; the
/// others would learn each pair anew, and are judged at the pairs that are worst for the walk they are made of.
enum Prepared {
    Together(Box<dyn Path>),
    One,
}

/// The method whose worst pairs another one is judged at: those that search for a way of their own take seconds a pair.
fn stand_in(name: &str) -> Option<&'static str> {
    match name {
        "latent_even" | "latent_geodesic" => Some("latent"),
        "latent_refined_geodesic" => Some("latent_refined"),
        _ => None,
    }
}

impl<'a> Screening<'a> {
    pub fn new(setup: &'a Setup<'a>, ends: &[Material]) -> Self {
        let at: Vec<Directions> = rus32k().iter().step_by(THINNED).copied().collect();
        let pairs: Vec<(usize, usize)> =
            (0..ends.len()).flat_map(|i| (i + 1..ends.len()).map(move |j| (i, j))).collect();
        let seen: Vec<Seen> = ends.par_iter().map(|end| seen(&at, end.brdf.as_ref())).collect();
        let apart: Vec<f64> = pairs.iter().map(|&(i, j)| distance(&seen[i], &seen[j])).collect();
        let farthest = largest(&apart, pairs.len().div_ceil(FARTHEST));
        Self { setup, at, pairs, farthest }
    }

    /// The cells of worst and farthest pairs.
    pub fn cells(&self, walker: &Walker) -> Result<Vec<Cell>> {
        let name = walker.method.name();
        let screened = match stand_in(name) {
            Some(other) => {
                self.screened(Catalog::interpolation_entry(other)?.build(self.setup.catalog)?.as_ref(), walker)
            }
            None => self.screened(walker.method, walker),
        }?;
        let worst = largest(&screened, self.setup.extent.pairs);
        let mut cells = Vec::new();
        for (hazard, chosen) in [(&WORST_PAIR, &worst), (&FAR_ENDS, &self.farthest)] {
            if !self.setup.wants(hazard) {
                continue;
            }
            (walker.done)(name)?;
            let mut tally = Tally::new(hazard);
            let rendered: Vec<Rendered> = chosen.par_iter().map(|&pair| self.rendered(walker, pair)).collect();
            for Rendered { name, result } in rendered {
                match result {
                    Ok((detour, panels, warnings)) => {
                        tally.add(&name, detour, || (Look { panels, view: View::Walk }, warnings));
                    }
                    Err(error) => tally.refuse(&name, &error),
                }
            }
            let by = stand_in(name).map(|other| format!("pairs chosen by {other}"));
            let cell = tally.cell(name, None);
            cells.extend(cell.map(|cell| Cell { note: cell.note.or(by), ..cell }));
        }
        Ok(cells)
    }

    /// Detours of all pairs, by values; −∞ where there is no walk.
    fn screened(&self, method: &dyn Interpolation, walker: &Walker) -> Result<Vec<f64>> {
        let ends = walker.ends;
        let prepared = match method.name() {
            // Units are matched with those of the first end: with others than a pair's own.
            "aligned_weights" => Prepared::One,
            _ => method.between(ends).map_or(Prepared::One, Prepared::Together),
        };
        let own: Option<Vec<Seen>> = match &prepared {
            Prepared::Together(path) => {
                let end = |i| self.point(path.as_ref(), &among(ends.len(), &[i]));
                (0..ends.len()).into_par_iter().map(end).collect()
            }
            Prepared::One => None,
        };
        let detour = |&(i, j): &(usize, usize)| -> Option<f64> {
            let [a, middle, b] = match (&prepared, &own) {
                (Prepared::Together(path), Some(own)) => {
                    let middle = self.point(path.as_ref(), &among(ends.len(), &[i, j]))?;
                    return Some(detour([&own[i], &middle, &own[j]]));
                }
                _ => {
                    let path = method.between(&[ends[i].clone(), ends[j].clone()]).ok()?;
                    [0.0, 0.5, 1.0].map(|t| self.point(path.as_ref(), &Weights::two(t)))
                }
            };
            Some(detour([&a?, &middle?, &b?]))
        };
        let mut detours = Vec::with_capacity(self.pairs.len());
        // In parts, so that the work can be ended.
        for part in self.pairs.chunks(256) {
            (walker.done)(&format!("{}, pair {} of {}", method.name(), detours.len(), self.pairs.len()))?;
            // Pairs that are refused must not take the places of those that are walked.
            detours.par_extend(part.par_iter().map(|pair| detour(pair).unwrap_or(f64::NEG_INFINITY)));
        }
        Ok(detours)
    }

    fn point(&self, path: &dyn Path, weights: &Weights) -> Option<Seen> {
        Some(seen(&self.at, path.at(weights).ok()?.as_ref()))
    }

    fn rendered(&self, walker: &Walker, pair: usize) -> Rendered {
        let (i, j) = self.pairs[pair];
        let ends = [walker.ends[i].clone(), walker.ends[j].clone()];
        let name = format!("{} > {}", ends[0].name, ends[1].name);
        let walk = || -> Result<Walked, PathError> {
            let path = walker.method.between(&ends)?;
            let point = |t: f32| -> Result<Arc<dyn Brdf>, PathError> { Ok(Arc::from(path.at(&Weights::two(t))?)) };
            let points = [point(0.0)?, point(0.5)?, point(1.0)?];
            let sphere = Sphere::studio();
            let [a, middle, b] = points.each_ref().map(|point| sphere.render(point.as_ref()));
            let between = |a: &Image, b: &Image| image_errors(a, b, sphere.covered()).delta_e_itp;
            let value = (between(&a, &middle) + between(&middle, &b)) / between(&a, &b);
            let labels = [ends[0].name.clone(), "half-way".to_owned(), ends[1].name.clone()];
            Ok((value, labels.into_iter().zip(points).collect(), path.warnings(&Weights::two(0.5))?))
        };
        Rendered { name, result: walk().map_err(|error| error.to_string()) }
    }
}

type Walked = (f64, Vec<(String, Arc<dyn Brdf>)>, Vec<Warning>);

struct Rendered {
    name: String,
    result: Result<Walked, String>,
}

fn seen(at: &[Directions], brdf: &dyn Brdf) -> Seen {
    // One thread: pairs are walked in parallel.
    let mut values = vec![Rgb::BLACK; at.len()];
    brdf.eval_into(at, &mut values);
    values.iter().zip(at).flat_map(|(f, at)| f.map(|f| (f * at.light.z).ln_1p()).0).collect()
}

fn detour([a, middle, b]: [&Seen; 3]) -> f64 {
    (distance(a, middle) + distance(middle, b)) / distance(a, b)
}

/// Equal weights of these ends among so many.
fn among(count: usize, chosen: &[usize]) -> Weights {
    let mut weights = vec![0.0; count];
    chosen.iter().for_each(|&i| weights[i] = 1.0 / chosen.len() as f32);
    Weights::normalized(weights).unwrap_or_else(|_| Weights::two(0.0))
}

/// Places of the largest, the largest first; what is no number counts as largest.
fn largest(values: &[f64], count: usize) -> Vec<usize> {
    let badness = |&i: &usize| if values[i].is_nan() { f64::INFINITY } else { values[i] };
    let mut places: Vec<usize> = (0..values.len()).collect();
    places.sort_by(|a, b| badness(b).total_cmp(&badness(a)).then(a.cmp(b)));
    places.truncate(count);
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_way_is_no_detour_and_the_largest_come_first() {
        let [a, middle, b] = [vec![0.0, 0.0], vec![0.5, 1.0], vec![1.0, 2.0]];
        assert!((detour([&a, &middle, &b]) - 1.0).abs() < 1e-12);
        assert!(detour([&a, &vec![3.0, 0.0], &b]) > 1.5);
        assert_eq!(largest(&[1.0, f64::NAN, 3.0, 3.0], 3), [1, 2, 3]);
        assert_eq!(among(3, &[0, 2]).as_slice(), [0.5, 0.0, 0.5]);
    }
}
