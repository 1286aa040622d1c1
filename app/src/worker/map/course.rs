//! Where paths run on the map.

use std::collections::HashMap;
use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::{Code, Material, Path, Representation as _, Weights};

use super::chart::{Chart, Projection};
use super::{Explored, MapRequest};
use crate::measure::guard;
use crate::worker::here::Here;
use crate::worker::paths::{self, Key, Prepared};
use crate::worker::{Office, guarded};

/// The path that is always shown.
const LATENT: &str = "latent";
/// Steps of a curve: principal components cost next to nothing, the place of a reflectance some 40 ms.
const STEPS: [usize; 2] = [32, 12];
/// Curves kept.
const KEPT: usize = 64;
/// Measured materials are nearer to those of training, in distances between these.
const USUAL: f64 = 6.0;

/// One path on a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Catalog name of the interpolation.
    pub method: &'static str,
    /// Places at rising t; empty where it is not walked along t.
    pub curve: Curve,
    /// Where it is now.
    pub here: [f32; 2],
}

/// Places of a map at rising t.
pub type Curve = Vec<(f32, [f32; 2])>;

/// Paths, and what is known of the explored place.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Of which map.
    pub projection: Projection,
    /// The latent path first, then others that walk through ZNBRDF codes.
    pub courses: Vec<Course>,
    /// Distance of the explored code to the nearest one of training; 1 is how far these are from each other.
    pub distance: Option<f64>,
    /// What is to be said of it.
    pub warning: Option<String>,
}

/// Curves found before.
#[derive(Default)]
pub(super) struct Courses {
    curves: HashMap<(Key, Projection, [u32; 2]), Curve>,
}

impl Courses {
    /// Everything that was asked for.
    pub fn track(&mut self, office: &Office, chart: &Chart, request: &MapRequest) -> Result<Track, String> {
        let mut courses = Vec::new();
        let others = request.methods.iter().copied().filter(|method| *method != LATENT);
        for method in std::iter::once(LATENT).chain(others) {
            let key = Key::new(&request.ends, method, request.timing);
            let Some(path) = path(office, &key) else { continue };
            let found = guarded("The path on the map", || self.course(office, chart, path.as_ref(), key, request));
            // Its card says why there is none.
            courses.extend(found.ok().and_then(Result::ok).flatten());
        }
        let (distance, warning) = request.explored.map_or(Ok((None, None)), |explored| known(office, explored))?;
        Ok(Track { projection: request.projection, courses, distance, warning })
    }

    /// None where a path walks through something else than codes of this model.
    fn course(
        &mut self,
        office: &Office,
        chart: &Chart,
        path: &dyn Path,
        key: Key,
        request: &MapRequest,
    ) -> Result<Option<Course>> {
        let model = office.stock.catalog.autoencoder();
        let is_own = |code: &Code| code.model == model.name() && code.checkpoint == model.checkpoint();
        let (brdf, code) =
            office.shown(path, &Here { key: key.clone(), walk: &request.walk, weights: &request.weights })?;
        let Some(code) = code.filter(is_own) else { return Ok(None) };
        let here = chart.place(&code.code, || Ok(Material::new(key.method, brdf)))?;
        let method = key.method;
        let Some([low, high]) = request.range else { return Ok(Some(Course { method, curve: Vec::new(), here })) };
        let known = (key.clone(), request.projection, [low.to_bits(), high.to_bits()]);
        if let Some(curve) = self.curves.get(&known) {
            return Ok(Some(Course { method, curve: curve.clone(), here }));
        }
        let steps = STEPS[request.projection as usize];
        let mut curve = Vec::with_capacity(steps + 1);
        for step in 0..=steps {
            let t = low + (high - low) * step as f32 / steps as f32;
            let weights = office.paths.weights(&key, Some(t), &Weights::along_spline(t, request.ends.len()));
            let Some(code) = path.code(&weights)?.filter(is_own) else { continue };
            let material = || Ok(Material::new(key.method, Arc::from(path.at(&weights)?)));
            curve.push((t, chart.place(&code.code, material)?));
        }
        if self.curves.len() >= KEPT {
            self.curves.clear();
        }
        self.curves.insert(known, curve.clone());
        Ok(Some(Course { method, curve, here }))
    }
}

/// A path that is prepared by now; the latent one is prepared here, where nobody else has done so.
fn path(office: &Office, key: &Key) -> Option<Arc<dyn Path>> {
    match office.paths.get(key) {
        Some(Prepared::Ready(path)) => Some(path),
        None if key.method == LATENT => {
            // An end that does not exist is told by others.
            let arrivals = office.arrivals();
            let (path, clock) = guarded("The latent path", || paths::prepare(office, key)).ok()?.ok()?;
            office.keep(key.clone(), Prepared::Ready(Arc::clone(&path)), clock, arrivals);
            Some(path)
        }
        _ => None,
    }
}

/// How far the explored code is from those of training, and what is to be said of it.
fn known(office: &Office, explored: Explored) -> Result<(Option<f64>, Option<String>), String> {
    let model = office.stock.catalog.autoencoder();
    let Some(numbers) = office.sheets.get(explored.projection).and_then(|sheet| sheet.ok()?.code(explored.place))
    else {
        return Ok((None, None));
    };
    let code = model.code(numbers);
    let distance = model.distance(&code).map_err(|error| error.to_string())?;
    let severe = guard::of_distance(&code, &model).map_err(|error| error.to_string())?;
    let warning = severe.map(|warning| warning.to_string()).or_else(|| {
        let is_far = |distance: &f64| distance.is_nan() || *distance > USUAL;
        let say = |distance| format!("far from the materials of training: {distance:.1} times their own distance");
        distance.filter(is_far).map(say)
    });
    Ok((distance, warning))
}
