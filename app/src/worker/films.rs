//! Pictures that are rendered over and over, and the geometry they share.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use nbrdf_core::render::{Light, METRIC_SIZE, Sphere};
use nbrdf_core::{Brdf, Image, Weights};

use super::{Card, Scenery, Timing, guarded};

/// Spheres kept: one light for each of a few sizes.
const KEPT: usize = 4;

/// What a picture shows: an end, or a point of a method's path.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subject {
    pub card: Card,
    pub ends: Arc<[String]>,
    /// Where between the ends, and how t runs; none of an end.
    pub point: Option<(Weights, Timing)>,
}

/// The pictures: of each card one in the size of the metrics, and one in another.
pub(super) struct Films {
    spheres: HashMap<usize, (Scenery, Arc<Sphere>)>,
    films: HashMap<(Card, usize), Film>,
    /// Running mean of seconds per pixel and lamp.
    pace: f64,
}

struct Film {
    /// What it shows, once it is whole.
    shows: Option<(Subject, Scenery)>,
    image: Image,
}

impl Default for Films {
    fn default() -> Self {
        Self { spheres: HashMap::new(), films: HashMap::new(), pace: 2e-8 }
    }
}

impl Films {
    /// How long so many pictures of this size take.
    pub fn expected(&self, pictures: usize, size: usize, light: &Light) -> Duration {
        Duration::from_secs_f64(work(size, light) * pictures as f64 * self.pace)
    }

    /// The picture of a card in this size, as it was rendered last.
    pub fn image(&self, card: Card, size: usize) -> Option<&Image> {
        self.films.get(&(card, size)).filter(|film| film.shows.is_some()).map(|film| &film.image)
    }

    /// Renders a subject over the last picture of its card, unless it is there.
    pub fn render(
        &mut self,
        subject: &Subject,
        point: &dyn Brdf,
        (scenery, light): (Scenery, &Light),
        size: usize,
    ) -> Result<(), String> {
        let card = subject.card;
        let sphere = self.sphere(scenery, light, size);
        if size != METRIC_SIZE {
            self.films.retain(|(other, of), _| *other != card || *of == METRIC_SIZE || *of == size);
        }
        let new = || Film { shows: None, image: Image::black(size, size) };
        let film = self.films.entry((card, size)).or_insert_with(new);
        if film.shows.as_ref().is_some_and(|(shown, under)| (shown, *under) == (subject, scenery)) {
            return Ok(());
        }
        let start = Instant::now();
        // A picture that is not finished is none of anything.
        film.shows = None;
        guarded("Rendering", || sphere.render_into(point, &mut film.image))?;
        film.shows = Some((subject.clone(), scenery));
        self.pace = 0.8 * self.pace + 0.2 * start.elapsed().as_secs_f64() / work(size, light);
        Ok(())
    }

    /// The geometry.
    pub fn sphere(&mut self, scenery: Scenery, light: &Light, size: usize) -> Arc<Sphere> {
        if let Some((known, sphere)) = self.spheres.get(&size)
            && *known == scenery
        {
            return Arc::clone(sphere);
        }
        if self.spheres.len() >= KEPT {
            self.spheres.clear();
        }
        let sphere = Arc::new(Sphere::new(size, light));
        self.spheres.insert(size, (scenery, Arc::clone(&sphere)));
        sphere
    }
}

/// Pixels times lamps.
fn work(size: usize, light: &Light) -> f64 {
    (size * size * light.lamps.len()) as f64
}
