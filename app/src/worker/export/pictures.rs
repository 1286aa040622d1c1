//! Pictures as files: one, or a walk of them.

use std::path::PathBuf;

use anyhow::Result;
use nbrdf_core::image::Tone;
use nbrdf_core::render::{Frame, Model};
use nbrdf_core::{Brdf, Image};

use super::job::Job;
use super::made::Made;
use super::painter::{Painter, lamps, on_ground, toned};
use super::{Exporter, PictureForm};
use crate::catalog::Catalog;
use crate::strip::{Cell, Row, Strip, ground};
use crate::worker::{Card, Request, Shape};

/// Samples per pixel of a picture under light from all around.
pub const SAMPLES: u32 = 256;
/// Those of each picture of a walk.
const STRIP_SAMPLES: u32 = 64;
/// Samples across a pixel of a labelled walk under lamps.
const ACROSS: usize = 2;

/// What draws the pictures of a walk.
enum Brush {
    /// As `nbrdf blend` draws spheres.
    Cell(Cell),
    /// On the same ground, so opaque, with so many samples across a pixel.
    Grounded(Painter, Vec<f32>, usize),
    /// For computing with.
    Linear(Painter),
}

impl Exporter {
    /// What a card shows, as the window shows it: on the same shape, in the same frame, through the same tone curve.
    pub(super) fn picture(&self, job: &Job, card: Card, form: PictureForm, size: usize) -> Result<Made> {
        let request = &job.shown;
        let shown = self.shown(request, card)?;
        let surfaces = self.surfaces(request, size, request.scenery.frame)?;
        let mut painter = self.painter(request, surfaces, SAMPLES)?;
        let linear = self.draw(&mut painter, shown.material.brdf.as_ref(), [0, 1])?;
        let image = match form {
            PictureForm::Png => linear.map(|pixel| toned(pixel, request)),
            PictureForm::Exr => exposed(&linear, request),
        };
        let files = vec![(job.file(form.extension()), encoded(&image, form)?)];
        Ok(Made { files, point: shown.point, errors: Vec::new() })
    }

    /// Pictures along the paths of all methods, of the whole shape; spheres as `nbrdf blend` draws them.
    pub(super) fn strip(
        &self,
        job: &Job,
        form: PictureForm,
        size: usize,
        steps: u16,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>> {
        let shown = &job.shown;
        let mut brush = self.brush(shown, form, size)?;
        let places = job.places(steps)?;
        let all = places.len() * shown.methods.len();
        let mut rows = Vec::new();
        for (row, &method) in shown.methods.iter().enumerate() {
            let path = self.path(method, shown)?;
            let mut spheres = Vec::new();
            for (step, place) in places.iter().enumerate() {
                let brdf = path.at(&self.weights(method, shown, place))?;
                spheres.push(self.paint(&mut brush, brdf.as_ref(), shown, [row * places.len() + step, all])?);
            }
            let title = Catalog::interpolation_entry(method).map_or(method, |entry| entry.title);
            rows.push(Row { title: title.to_owned(), name: method.to_owned(), spheres });
        }
        let light = lamps(shown.scenery.lighting);
        let mut remark = Strip::remark_of(light.as_ref().map_or("environment", |light| light.name), shown.exposure);
        if shown.tone != Tone::Clip {
            remark += &format!(", {} tone curve", shown.tone.title());
        }
        let columns = places.into_iter().map(|place| place.heading).collect();
        let strip = Strip { heading: Strip::heading_of(&shown.ends), remark, columns, rows };
        let image = if form == PictureForm::Png { strip.labelled() } else { strip.plain() };
        Ok(vec![(job.file(form.extension()), encoded(&image, form)?)])
    }

    fn brush(&self, shown: &Request, form: PictureForm, size: usize) -> Result<Brush> {
        let lamps = lamps(shown.scenery.lighting);
        if form == PictureForm::Exr {
            let surfaces = self.surfaces(shown, size, Frame::WHOLE)?;
            return Ok(Brush::Linear(self.painter(shown, surfaces, STRIP_SAMPLES)?));
        }
        if let Some(light) = &lamps
            && (shown.scenery.shape, shown.tone) == (Shape::Sphere, Tone::Clip)
        {
            return Ok(Brush::Cell(Cell::new(size, light)));
        }
        // More samples take many more rays of a mesh, and more time in light from all around.
        let is_mesh = matches!(self.office.model(shown.scenery.shape), Model::Mesh(_));
        let across = if is_mesh || lamps.is_none() { 1 } else { ACROSS };
        let surfaces = self.surfaces(shown, size * across, Frame::WHOLE)?;
        let opacity = surfaces.opacity();
        Ok(Brush::Grounded(self.painter(shown, surfaces, STRIP_SAMPLES)?, opacity, across))
    }

    /// One picture of a walk; `done` of `all` are drawn before it.
    fn paint(&self, brush: &mut Brush, brdf: &dyn Brdf, shown: &Request, [done, all]: [usize; 2]) -> Result<Image> {
        Ok(match brush {
            Brush::Cell(cell) => {
                self.advance(done, all)?;
                cell.draw(brdf, shown.exposure.exp2(), ground())
            }
            Brush::Grounded(painter, opacity, across) => {
                on_ground(&self.draw(painter, brdf, [done, all])?, opacity, *across, shown)
            }
            Brush::Linear(painter) => exposed(&self.draw(painter, brdf, [done, all])?, shown),
        })
    }
}

fn exposed(linear: &Image, shown: &Request) -> Image {
    let gain = shown.exposure.exp2();
    linear.map(|pixel| pixel * gain)
}

fn encoded(image: &Image, form: PictureForm) -> Result<Vec<u8>> {
    Ok(match form {
        PictureForm::Png => image.png_bytes()?,
        PictureForm::Exr => image.exr_bytes()?,
    })
}
