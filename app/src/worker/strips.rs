//! Film strips: a whole path in a row of small pictures.

use std::sync::Arc;

use nbrdf_core::image::Tone;
use nbrdf_core::{Brdf, Image, Path, Weights};

use super::paths::{Key, Prepared};
use super::picture::Picture;
use super::studio::Studio;
use super::{Answer, Card, Request, Scenery, Timing, Tour, guarded};

/// What a film strip in the window shows: ends, timing, which way, scenery, exposure and tone curve, size.
pub(super) type Strip = (Arc<[String]>, Timing, Tour, Scenery, (u32, Tone), usize);

/// One point of a film strip, linear, and how opaque its pixels are.
pub(super) struct Frame {
    pub image: Image,
    pub opacity: Arc<[f32]>,
}

impl Studio {
    /// Renders film strips that changed, the material at t with `render`, none where it was stopped; whether it came to the
    /// end.
    pub fn roll(
        &mut self,
        request: &Request,
        mut render: impl FnMut(&mut Self, &Weights, &dyn Brdf) -> Option<Frame>,
    ) -> bool {
        // Strips show the whole shape: a zoom changes nothing.
        let scenery = request.scenery.whole();
        for &method in request.methods.iter().filter(|_| request.strip > 0) {
            let card = Card::Method(method);
            let (tour, ends) = (request.walk.tour, request.ends.len());
            let tone = (request.exposure.to_bits(), request.tone);
            let strip = (Arc::clone(&request.ends), request.timing, tour, scenery, tone, request.strip);
            let key = request.key(method);
            let Some(path) = self.ready(&key).filter(|_| self.strips.get(&card) != Some(&strip)) else {
                continue;
            };
            for step in 0..tour.frames(ends) {
                if self.office.requests.has_news() {
                    return false;
                }
                let place = tour.place(step, ends);
                let t = (tour != Tour::Around).then_some(place);
                let weights = self.office.paths.weights(&key, t, &tour.weights(place, ends));
                let frame = || path.at(&weights).map(|brdf| render(self, &weights, brdf.as_ref()));
                // Where the sphere itself fails, its card says so.
                let Ok(Ok(frame)) = guarded("Rendering", frame) else { continue };
                let Some(Frame { image, opacity }) = frame else { return false };
                let picture = Picture::of(&image, request.showing(), &opacity, &self.office.plates);
                self.office.say(Answer::Frame(card, step, picture));
            }
            self.strips.insert(card, strip);
        }
        true
    }

    /// The path of a method, if it is ready by now.
    fn ready(&self, key: &Key) -> Option<Arc<dyn Path>> {
        match self.office.paths.get(key) {
            Some(Prepared::Ready(path)) => Some(path),
            _ => None,
        }
    }
}
