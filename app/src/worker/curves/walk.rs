//! How good paths are, point by point.

use std::collections::HashMap;
use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::metric::{albedo_max, negative_share};
use nbrdf_core::path::mix::Mix;
use nbrdf_core::render::Sphere;
use nbrdf_core::{Brdf, Interpolation as _, Material, Path, Weights};

use super::Question;
use crate::worker::Office;
use crate::worker::figures::{Figures, Seen};
use crate::worker::paths::Key;

/// Points from end to end, less one: coarse, fine.
const STEPS: [i16; 2] = [8, 32];
/// Walks kept; they are small, so this only bounds a long day's work.
const KEPT: usize = 128;

/// One method's path.
#[derive(Clone, Debug, PartialEq)]
pub struct Along {
    /// Its name in the catalog.
    pub method: &'static str,
    /// Points by rising t.
    pub places: Vec<Place>,
}

/// One point of a path, seen under light `studio` at the size of the reports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Where on the path: 0 is the first material, 1 the last.
    pub t: f32,
    /// PSNR against the linear mix \[dB\]; 100 for the same picture.
    pub psnr: f64,
    /// Mean ΔE_ITP to the linear mix.
    pub to_mix: f64,
    /// From the point before: t halfway, and the mean ΔE_ITP for a step of 1/32; none of the first point.
    pub step: Option<[f64; 2]>,
    /// Distance of the mean colour from mixtures of the ends', in u′v′.
    pub hue: f64,
    /// Largest directional albedo.
    pub albedo: f64,
    /// Share of directions below zero before the clamp, 0..1.
    pub negative: f64,
}

/// Walks that were made.
#[derive(Default)]
pub(super) struct Walks(HashMap<(Key, bool, bool), Arc<Along>>);

impl Walks {
    /// Of these paths; none if something newer came.
    pub fn of(
        &mut self,
        office: &Office,
        (question, is_beyond, is_fine): (&Question, bool, bool),
        ends: &[Material],
        paths: &[(&'static str, Arc<dyn Path>)],
    ) -> Result<Option<Vec<Arc<Along>>>> {
        let key = |method| question.key(method);
        let is_known = |walks: &Self, method| walks.known(key(method), is_beyond, is_fine).is_some();
        let unknown: Vec<_> = paths.iter().filter(|(method, _)| !is_known(self, *method)).cloned().collect();
        if self.0.len() + unknown.len() > KEPT {
            self.0.clear();
            return self.of(office, (question, is_beyond, is_fine), ends, paths);
        }
        let place = |method, t, plain: &Weights| office.paths.weights(&key(method), Some(t), plain);
        let has_news = || office.questions.has_news();
        let range = (is_beyond, STEPS[usize::from(is_fine)]);
        let Some(walks) = walk(ends, &unknown, range, &place, &has_news)? else { return Ok(None) };
        for walk in walks {
            self.0.insert((key(walk.method), is_beyond, is_fine), Arc::new(walk));
        }
        Ok(Some(paths.iter().filter_map(|(method, _)| self.known(key(method), is_beyond, is_fine)).collect()))
    }

    /// A walk at least as fine as this.
    fn known(&self, key: Key, is_beyond: bool, is_fine: bool) -> Option<Arc<Along>> {
        let fine = (key, is_beyond, true);
        let found = self.0.get(&fine).cloned();
        found.or_else(|| self.0.get(&(fine.0, is_beyond, false)).filter(|_| !is_fine).cloned())
    }
}

/// A path that is being walked, with the last two pictures.
struct Walker<'a> {
    path: &'a dyn Path,
    walk: Along,
    here: Seen,
    before: Option<(f32, Seen)>,
}

/// Weights of a method's path at a time, from those of all.
type Places<'a> = dyn Fn(&'static str, f32, &Weights) -> Weights + 'a;

/// All paths side by side, so that the mix is rendered once; none if something newer came.
fn walk(
    ends: &[Material],
    paths: &[(&'static str, Arc<dyn Path>)],
    (is_beyond, steps): (bool, i16),
    place: &Places,
    has_news: &dyn Fn() -> bool,
) -> Result<Option<Vec<Along>>> {
    if paths.is_empty() {
        return Ok(Some(Vec::new()));
    }
    let sphere = Sphere::studio();
    let look = |brdf: &dyn Brdf, seen: &mut Seen| seen.look(&sphere.render(brdf), 1.0, sphere.covered());
    let mut walkers: Vec<Walker> = paths
        .iter()
        .map(|(method, path)| Walker {
            path: path.as_ref(),
            walk: Along { method, places: Vec::new() },
            here: Seen::default(),
            before: None,
        })
        .collect();
    let mut seen_ends: Vec<Seen> = ends.iter().map(|_| Seen::default()).collect();
    seen_ends.iter_mut().zip(ends).for_each(|(seen, end)| look(end.brdf.as_ref(), seen));
    let mix = Mix::Linear.between(ends)?;
    let mut seen_mix = Seen::default();
    let beyond = if is_beyond { steps / 2 } else { 0 };
    for step in -beyond..=steps + beyond {
        let t = f32::from(step) / f32::from(steps);
        let weights = Weights::along_spline(t, ends.len());
        look(mix.at(&weights)?.as_ref(), &mut seen_mix);
        for Walker { path, walk, here, before } in &mut walkers {
            if has_news() {
                return Ok(None);
            }
            // A point that does not exist is a gap.
            let Ok(point) = path.at(&place(walk.method, t, &weights)) else { continue };
            look(point.as_ref(), here);
            let Figures { psnr, to_mix, hue, .. } = here.compare(&seen_mix, &seen_ends, None, sphere.covered());
            let step = before.as_ref().map(|(from, before)| {
                let length = f64::from(t - from) * 32.0;
                [f64::from(0.5 * (t + from)), here.distance(before, sphere.covered()) / length]
            });
            let (albedo, negative) = (albedo_max(point.as_ref()), negative_share(point.as_ref()));
            walk.places.push(Place { t, psnr, to_mix, step, hue, albedo, negative });
            let last = before.take().map_or_else(Seen::default, |(_, seen)| seen);
            *before = Some((t, std::mem::replace(here, last)));
        }
    }
    Ok(Some(walkers.into_iter().map(|walker| walker.walk).collect()))
}

#[cfg(test)]
mod tests {
    use nbrdf_core::Rgb;
    use nbrdf_core::brdf::lambert::Lambert;

    use super::*;

    fn grey(name: &str, albedo: f32) -> Material {
        Material { name: name.to_owned(), brdf: Arc::new(Lambert { albedo: Rgb::splat(albedo) }), network: None }
    }

    fn plain(_: &str, _: f32, weights: &Weights) -> Weights {
        weights.clone()
    }

    #[test]
    fn a_path_is_walked_at_its_own_times() {
        let ends = [grey("dark", 0.2), grey("light", 0.6)];
        let path: Arc<dyn Path> = Arc::from(Mix::Linear.between(&ends).unwrap());
        let late = |_: &str, t: f32, _: &Weights| Weights::two(t * t);
        let walks = walk(&ends, &[("linear_mix", path)], (false, 8), &late, &|| false).unwrap().unwrap();
        let middle = walks[0].places[4];
        assert!(middle.t == 0.5 && (middle.albedo - 0.3).abs() < 1e-3, "{middle:?}");
    }

    #[test]
    fn the_linear_mix_is_exact_all_along_and_its_steps_do_not_depend_on_their_number() {
        let ends = [grey("dark", 0.2), grey("light", 0.6)];
        let path: Arc<dyn Path> = Arc::from(Mix::Linear.between(&ends).unwrap());
        let of = |steps| {
            walk(&ends, &[("linear_mix", Arc::clone(&path))], (true, steps), &plain, &|| false).unwrap().unwrap()
        };
        let (coarse, fine) = (of(8), of(32));
        let [coarse, fine] = [&coarse[0].places, &fine[0].places];
        assert_eq!([coarse.len(), fine.len()], [17, 65]);
        assert!(fine.iter().all(|place| (place.psnr, place.to_mix, place.negative) == (100.0, 0.0, 0.0)));
        assert!((fine[32].albedo - 0.4).abs() < 1e-3 && fine[32].t == 0.5, "{:?}", fine[32]);
        let step = |places: &[Place], at: usize| places[at].step.unwrap()[1];
        let four = (33..37).map(|at| step(fine, at)).sum::<f64>() / 4.0;
        assert!((step(coarse, 9) - four).abs() < 0.02 * four, "{} {four}", step(coarse, 9));
    }

    #[test]
    fn news_end_a_walk() {
        let ends = [grey("dark", 0.2), grey("light", 0.6)];
        let path: Arc<dyn Path> = Arc::from(Mix::Linear.between(&ends).unwrap());
        assert!(walk(&ends, &[("linear_mix", path)], (false, 8), &plain, &|| true).unwrap().is_none());
    }
}
