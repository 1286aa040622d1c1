//! The materials that are asked for: what a card shows, and all along a path.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context as _, Result, bail};
use nbrdf_core::{Code, Material, Path, Weights};

use super::Exporter;
use super::code::told;
use super::job::Job;
use super::made::{Made, Point};
use crate::catalog::ExporterEntry;
use crate::catalog::exporters::Subject;
use crate::exported;
use crate::worker::paths::{Prepared, prepare};
use crate::worker::{Card, Request};

/// What a card shows.
pub(super) struct Shown {
    /// The material.
    pub material: Material,
    /// Its code, where it has one.
    pub code: Option<Code>,
    /// The point of a path that it is, if it is one.
    pub point: Option<Point>,
}

/// Name of a point between materials.
fn name_of_point(ends: &[String], weights: &Weights) -> String {
    let parts = ends.iter().zip(weights.as_slice()).filter(|(_, weight)| **weight != 0.0);
    let parts: Vec<String> = parts.map(|(end, weight)| format!("{weight:.2} {end}")).collect();
    let whole = parts.join(" + ");
    // Names of materials have an end somewhere.
    if whole.len() <= nbrdf_core::library::MAX_NAME { whole } else { format!("blend of {}", parts.len()) }
}

impl Exporter {
    /// The path of a method between the ends, prepared now unless it is there.
    pub(super) fn path(&self, method: &'static str, shown: &Request) -> Result<Arc<dyn Path>> {
        let key = shown.key(method);
        match self.office.paths.get(&key) {
            Some(Prepared::Ready(path)) => Ok(path),
            Some(Prepared::Failed(why)) => bail!(why),
            None => {
                let arrivals = self.office.arrivals();
                let (path, clock) = prepare(&self.office, &key)?;
                self.office.keep(key, Prepared::Ready(Arc::clone(&path)), clock, arrivals);
                Ok(path)
            }
        }
    }

    /// The materials at the ends.
    pub(super) fn ends(&self, shown: &Request) -> Result<Vec<Material>> {
        let find = |name: &String| self.office.material(name).with_context(|| format!("no material `{name}`"));
        shown.ends.iter().map(find).collect()
    }

    /// What a card shows.
    pub(super) fn shown(&self, shown: &Request, card: Card) -> Result<Shown> {
        let alone = |material| Shown { material, code: None, point: None };
        match card {
            Card::End(end) => {
                let end = self.ends(shown)?.into_iter().nth(end);
                Ok(alone(end.context("there is no such material")?))
            }
            Card::Method(method) => {
                let path = self.path(method, shown)?;
                let weights = self.office.paths.weights(&shown.key(method), shown.walk.t, &shown.weights);
                let name = name_of_point(&shown.ends, &weights);
                let (brdf, code) = self.office.here(path.as_ref(), method, shown)?;
                let is_edited = code != path.code(&weights)?;
                let code = code.map(|code| told(code, &name)).transpose()?;
                let point = Point { weights, edited: code.clone().filter(|_| is_edited) };
                Ok(Shown { material: Material::new(name, brdf), code, point: Some(point) })
            }
            Card::Explored => {
                let explored = shown.explored.context("nothing is explored")?;
                let brdf = self.office.explored(explored).map_err(anyhow::Error::msg)?;
                Ok(alone(Material::new("explored", Arc::from(brdf))))
            }
        }
    }

    /// The files of what a card shows.
    pub(super) fn material(&self, job: &Job, card: Card, form: &ExporterEntry) -> Result<Made> {
        let Shown { material, code, point } = self.shown(&job.shown, card)?;
        self.go_on()?;
        let subject = Subject { material: &material, code: code.as_ref() };
        let files = form.files(&job.folder.join(&job.name), &subject)?;
        self.go_on()?;
        let errors = vec![exported::error(form, &subject, &files, &self.office.stock.catalog)?];
        Ok(Made { files, point, errors })
    }

    /// The files of all materials along a path.
    pub(super) fn steps(&self, job: &Job, method: &'static str, form: &ExporterEntry, steps: u16) -> Result<Made> {
        let path = self.path(method, &job.shown)?;
        let (mut files, mut errors) = (Vec::new(), Vec::new());
        for (step, place) in (0..).zip(job.places(steps)?) {
            self.advance(step.into(), steps.into())?;
            let weights = self.weights(method, &job.shown, &place);
            let name = name_of_point(&job.shown.ends, &weights);
            let code = path.code(&weights)?.map(|code| told(code, &name)).transpose()?;
            let material = Material::new(name, Arc::from(path.at(&weights)?));
            let subject = Subject { material: &material, code: code.as_ref() };
            let of_step = form.files(&job.step(step), &subject)?;
            errors.push(exported::error(form, &subject, &of_step, &self.office.stock.catalog)?);
            files.extend(of_step);
            let bytes: usize = files.iter().map(|(_, bytes): &(PathBuf, Vec<u8>)| bytes.len()).sum();
            if bytes > super::MOST_BYTES {
                break;
            }
        }
        Ok(Made { files, point: None, errors })
    }
}
