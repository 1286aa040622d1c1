//! Pictures that are rendered over and over, and the geometry they share.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use nbrdf_core::render::{Light, METRIC_SIZE, Model};
use nbrdf_core::{Brdf, Image, Weights};

use super::sets::Sets;
use super::{Card, Scenery, Timing, guarded};

/// What a picture shows: an end, or a point of a method's path.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Subject {
    pub card: Card,
    pub ends: Arc<[String]>,
    /// Where between the ends, and how t runs; none of an end.
    pub point: Option<(Weights, Timing)>,
    /// The code in place of the path's own, where that is edited.
    pub edited: Option<Arc<[f32]>>,
}

/// What all pictures of a request have in common.
#[derive(Clone, Copy)]
pub(super) struct Set<'a> {
    pub scenery: Scenery,
    pub light: &'a Light,
    pub model: &'a Model,
}

impl Set<'_> {
    /// The whole sphere in the same light: what figures are measured on.
    pub fn plain(self) -> Self {
        Self { scenery: self.scenery.plain(), model: &Model::Sphere, ..self }
    }

    /// Without a zoom.
    pub fn whole(self) -> Self {
        Self { scenery: self.scenery.whole(), ..self }
    }

    /// Whether it is what figures are measured on.
    pub fn is_plain(&self) -> bool {
        self.scenery == self.scenery.plain()
    }
}

/// The pictures: of each card one in the size and on the sphere of the metrics, one of another size, and a coarse one of
/// whatever else it is seen on.
pub(super) struct Films {
    pub sets: Sets,
    films: HashMap<Key, Film>,
    /// Running mean of seconds per pixel and lamp.
    pace: f64,
}

/// Card, size, and whether it is on the sphere of the figures.
type Key = (Card, usize, bool);

struct Film {
    /// What it shows, once it is whole.
    shows: Option<(Subject, Scenery)>,
    image: Image,
}

impl Default for Films {
    fn default() -> Self {
        Self { sets: Sets::default(), films: HashMap::new(), pace: 2e-8 }
    }
}

impl Films {
    /// How long so many pictures of this size take, their geometry included where it is not known.
    pub fn expected(&self, pictures: usize, set: Set, size: usize) -> Duration {
        let shading = work(size, set.light) * pictures as f64 * self.pace;
        Duration::from_secs_f64(shading + self.sets.expected(set, size))
    }

    /// The picture of a card in this size, as it was rendered last.
    pub fn image(&self, card: Card, set: Set, size: usize) -> Option<&Image> {
        let film = self.films.get(&(card, size, set.is_plain()));
        film.filter(|film| film.shows.as_ref().is_some_and(|(_, scenery)| *scenery == set.scenery))
            .map(|film| &film.image)
    }

    /// Renders a subject over the last picture of its card, unless it is there; whether it was not stopped.
    pub fn render(
        &mut self,
        subject: &Subject,
        point: &dyn Brdf,
        set: Set,
        size: usize,
        stops: &(dyn Fn() -> bool + Sync),
    ) -> Result<bool, String> {
        let card = subject.card;
        let Some(sphere) = self.sets.sphere(set, size, stops) else { return Ok(false) };
        if size != METRIC_SIZE {
            self.films.retain(|(other, of, is_plain), _| {
                *other != card || *of == METRIC_SIZE || (*of == size && *is_plain == set.is_plain())
            });
        }
        let new = || Film { shows: None, image: Image::black(size, size) };
        let film = self.films.entry((card, size, set.is_plain())).or_insert_with(new);
        if film.shows.as_ref().is_some_and(|(shown, under)| (shown, *under) == (subject, set.scenery)) {
            return Ok(true);
        }
        let start = Instant::now();
        // A picture that is not finished is none of anything.
        film.shows = None;
        if !guarded("Rendering", || sphere.render_into_unless(stops, point, &mut film.image))? {
            return Ok(false);
        }
        film.shows = Some((subject.clone(), set.scenery));
        self.pace = 0.8 * self.pace + 0.2 * start.elapsed().as_secs_f64() / work(size, set.light);
        Ok(true)
    }

    /// Forgets every picture: what they show is another now.
    pub fn clear(&mut self) {
        self.films.clear();
    }
}

/// Pixels times lamps.
fn work(size: usize, light: &Light) -> f64 {
    (size * size * light.lamps.len()) as f64
}
