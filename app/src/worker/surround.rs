//! Spheres under an environment map: grainy at once, smooth when left alone.

use std::collections::HashMap;
use std::sync::Arc;

use nbrdf_core::render::{METRIC_SIZE, Model, Progressive};
use nbrdf_core::sampler::lobe::Lobe;
use nbrdf_core::{Brdf, Weights};

use super::films::Subject;
use super::picture::Picture;
use super::strips::Frame;
use super::studio::{QUIET, Studio};
use super::{Answer, Card, Lighting, Request, guarded};

/// Samples per pixel of a picture that is not left alone.
const AT_ONCE: u32 = 4;
/// Samples per pixel after which film strips come first, and of their frames.
const DECENT: u32 = 16;
/// Samples per pixel of a finished picture.
const FINISHED: u32 = 256;

/// Fitted lobes by material.
pub(super) type Lobes = HashMap<String, Lobe>;

impl Studio {
    /// Renders the spheres, better and better, and the film strips in between; whether it came to the end.
    pub fn surrounded(&mut self, subjects: &[Subject], request: &Request, model: &Model) -> bool {
        let Lighting::Around { map, turn } = request.scenery.lighting else { return true };
        // Lamps start anew afterwards.
        self.sent.clear();
        self.office.points.forget();
        let cards = subjects.iter().map(|subject| subject.card).filter(|card| request.is_large(*card));
        let cards: Vec<Card> = cards.collect();
        let environment = self.office.map(map).rotated(f64::from(turn));
        let lobes: Vec<Lobe> = cards.iter().map(|card| self.lobe(*card, request)).collect();
        for subject in subjects {
            self.office.say(Answer::Figures(subject.card, None));
        }
        let requests = Arc::clone(&self.office.requests);
        let stops = || requests.has_news();
        for (size, samples) in [(METRIC_SIZE.min(request.size), AT_ONCE), (request.size, FINISHED)] {
            let is_coarse = size < request.size;
            let never = || false;
            let patience: &(dyn Fn() -> bool + Sync) = if is_coarse { &never } else { &stops };
            let Some(sight) = self.films.sets.sight((request.scenery, model), size, patience) else { return false };
            let new = || Progressive::of(Arc::clone(&sight.surfaces), environment.clone(), 0);
            let picture = |(card, lobe): (&Card, &Lobe)| (*card, *lobe, new());
            let mut pictures: Vec<_> = cards.iter().zip(&lobes).map(picture).collect();
            for pass in 1..=samples {
                // A fine picture appears when it is no grainier than the coarse one.
                let is_due = pass == samples || (pass.is_power_of_two() && (pass >= AT_ONCE || is_coarse));
                let mut index = 0;
                while let Some((card, lobe, picture)) = pictures.get_mut(index) {
                    if self.office.requests.has_news() {
                        return false;
                    }
                    if !self.expose(*card, lobe, picture, request) {
                        pictures.remove(index);
                        continue;
                    }
                    if is_due {
                        let image = picture.image();
                        let shown = Picture::of(&image, request.showing(), &sight.opacity, &self.office.plates);
                        self.office.say(Answer::Picture(*card, shown));
                        self.office.points.see(*card, image);
                    }
                    index += 1;
                }
                if is_due {
                    self.differ(request, &sight, |_, card| {
                        pictures.iter().find(|(other, ..)| *other == card).map(|(.., picture)| picture.image())
                    });
                }
                if pass == DECENT
                    && !self.roll(request, |studio, weights, brdf| {
                        let lobe = studio.mixed_lobe(weights, request);
                        let whole = request.scenery.whole();
                        let sight = studio.films.sets.sight((whole, model), request.strip, &stops)?;
                        let mut picture = Progressive::of(sight.surfaces, environment.clone(), 0);
                        (0..DECENT).for_each(|_| picture.pass(brdf, &lobe));
                        Some(Frame { image: picture.image(), opacity: sight.opacity })
                    })
                {
                    return false;
                }
            }
            if !self.office.requests.stays_quiet(QUIET) {
                return false;
            }
        }
        true
    }

    /// One more pass; false where the material fails.
    fn expose(&mut self, card: Card, lobe: &Lobe, picture: &mut Progressive, request: &Request) -> bool {
        let Some(point) = self.point(card) else { return false };
        let Err(why) = guarded("Rendering", || picture.pass(point, lobe)) else { return true };
        self.withdraw(card, Answer::Failed(card, why.clone()));
        self.tell(&request.ends, why);
        false
    }

    /// The lobe to draw lights from: fitted to the ends once, mixed in between. A lobe that does not fit costs samples,
    /// never truth.
    fn lobe(&mut self, card: Card, request: &Request) -> Lobe {
        match card {
            Card::End(end) => self.fitted(end, request),
            Card::Method(_) => self.mixed_lobe(&request.weights, request),
            Card::Explored => self.point(card).map_or(Lobe::COSINE, fit),
        }
    }

    fn mixed_lobe(&mut self, weights: &Weights, request: &Request) -> Lobe {
        let mut mixed = [0.0; 2];
        for (end, &weight) in weights.as_slice().iter().enumerate() {
            let own = self.fitted(end, request).coordinates();
            mixed.iter_mut().zip(own).for_each(|(sum, own)| *sum += f64::from(weight) * own);
        }
        Lobe::from_coordinates(mixed)
    }

    fn fitted(&mut self, end: usize, request: &Request) -> Lobe {
        let name = &request.ends[end];
        if let Some(known) = self.lobes.get(name) {
            return *known;
        }
        let lobe = self.point(Card::End(end)).map_or(Lobe::COSINE, fit);
        self.lobes.insert(name.clone(), lobe);
        lobe
    }
}

/// Fits a lobe to a material.
fn fit(point: &dyn Brdf) -> Lobe {
    guarded("The lobe", || Lobe::fit(point)).unwrap_or(Lobe::COSINE)
}
