//! What draws materials: on which surfaces, in which light.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use anyhow::{Context as _, Result, bail};
use nbrdf_core::render::{Frame, Light, Progressive, Sphere, Surfaces};
use nbrdf_core::sampler::lobe::Lobe;
use nbrdf_core::{Brdf, Image, Rgb};

use super::{Exporter, STOPPED};
use crate::strip::ground;
use crate::worker::{Lighting, Request};

/// Draws linear pictures, not yet exposed, black beside the surface.
pub(super) enum Painter {
    /// Under lamps.
    Lamps(Sphere),
    /// In light from all around, with so many samples per pixel.
    Around(Progressive, u32),
}

/// The lamps; those of the command line where they are the same. None where light comes from all around.
pub(super) fn lamps(lighting: Lighting) -> Option<Light> {
    let (found, point) = (lighting.lamps()?, Light::point());
    let is_at = |other: &Light| found.lamps[0].direction.distance(other.lamps[0].direction) < 1e-5;
    Some(if found.lamps.len() == 1 && is_at(&point) { point } else { found })
}

impl Exporter {
    /// What the pixels see of the shape that is shown.
    pub(super) fn surfaces(&self, shown: &Request, size: usize, frame: Frame) -> Result<Arc<Surfaces>> {
        let (stop, model) = (&self.stop, self.office.model(shown.scenery.shape));
        let found = Surfaces::unless(&|| stop.load(Ordering::Relaxed), size, &model, frame);
        Ok(Arc::new(found.context(STOPPED)?))
    }

    /// What draws on them in the light that is shown; where that comes from all around, with so many samples per pixel.
    pub(super) fn painter(&self, shown: &Request, surfaces: Arc<Surfaces>, samples: u32) -> Result<Painter> {
        let stop = &self.stop;
        let light = match shown.scenery.lighting {
            Lighting::Around { map, turn } => {
                let environment = self.office.map(map).rotated(f64::from(turn));
                return Ok(Painter::Around(Progressive::of(surfaces, environment, 0), samples));
            }
            lighting => lamps(lighting).unwrap_or_else(Light::studio),
        };
        let sphere = Sphere::unless(&|| stop.load(Ordering::Relaxed), surfaces, &light);
        Ok(Painter::Lamps(sphere.context(STOPPED)?))
    }

    /// One picture; `done` of `all` are drawn before it.
    pub(super) fn draw(&self, painter: &mut Painter, brdf: &dyn Brdf, [done, all]: [usize; 2]) -> Result<Image> {
        self.advance(done, all)?;
        Ok(match painter {
            Painter::Lamps(sphere) => {
                let mut image = Image::black(sphere.size(), sphere.size());
                let stops = || self.stop.load(Ordering::Relaxed);
                if !sphere.render_into_unless(&stops, brdf, &mut image) {
                    bail!(STOPPED);
                }
                image
            }
            Painter::Around(picture, samples) => {
                let lobe = Lobe::fit(brdf);
                picture.restart();
                for sample in 0..*samples {
                    if sample.is_multiple_of(16) {
                        let share = *samples as usize;
                        self.advance(done * share + sample as usize, all * share)?;
                    }
                    picture.pass(brdf, &lobe);
                }
                picture.image()
            }
        })
    }
}

/// As it is displayed: exposed, and through the tone curve.
pub(super) fn toned(linear: Rgb, shown: &Request) -> Rgb {
    let gain = shown.exposure.exp2();
    linear.map(|value| shown.tone.shown(value * gain))
}

/// The picture on the ground of strips, `across` × `across` samples to a pixel, each as opaque as given. Every sample goes
/// through the tone curve by itself, so that highlights have smooth edges.
pub(super) fn on_ground(fine: &Image, opacity: &[f32], across: usize, shown: &Request) -> Image {
    let (size, ground) = (fine.width() / across, ground());
    let share = 1.0 / (across * across) as f32;
    let sample = |x: usize, y: usize| {
        let alpha = opacity[y * fine.width() + x];
        toned(fine.get(x, y), shown).zip(ground, |inside, ground| ground + (inside - ground) * alpha)
    };
    let pixel = |i: usize| {
        let (left, top) = (across * (i % size), across * (i / size));
        let all = (0..across * across).map(|i| sample(left + i % across, top + i / across));
        all.fold(Rgb::BLACK, |sum, one| sum + one) * share
    };
    Image::new(size, size, (0..size * size).map(pixel).collect())
}
