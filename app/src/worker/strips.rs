//! Film strips: a whole path in a row of small pictures.

use std::collections::HashMap;
use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::image::Tone;
use nbrdf_core::{Brdf, Image, Path, Weights};

use super::here::Here;
use super::paths::{Key, Prepared};
use super::picture::Picture;
use super::studio::Studio;
use super::{Answer, Card, Edits, Request, Scenery, Timing, Tour, Walk, guarded};

/// What a film strip in the window shows: the way, scenery, exposure and tone curve, size.
pub(super) type Strip = (Way, Scenery, (u32, Tone), usize);

/// Ends, timing, which way, and what is edited on it.
type Way = (Arc<[String]>, Timing, Tour, Edits);

/// The edited points of a strip, step by step: an edit takes longer than a picture, and they stay while light and exposure
/// change and when a strip is begun anew.
pub(super) struct Reel {
    way: Way,
    points: HashMap<usize, Arc<dyn Brdf>>,
}

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
            let key = request.key(method);
            let Some(path) = self.ready(&key) else { continue };
            let is_edited = self.office.is_edited(path.as_ref(), &request.here(method));
            let edits = if is_edited { request.walk.edits } else { Edits::default() };
            let way = (Arc::clone(&request.ends), request.timing, tour, edits);
            let strip = (way.clone(), scenery, tone, request.strip);
            if self.strips.get(&card) == Some(&strip) {
                continue;
            }
            if !is_edited {
                self.reels.remove(&card);
            } else if self.reels.get(&card).is_none_or(|reel| reel.way != way) {
                self.reels.insert(card, Reel { way, points: HashMap::new() });
            }
            for step in 0..tour.frames(ends) {
                if self.office.requests.has_news() {
                    return false;
                }
                let place = tour.place(step, ends);
                let t = (tour != Tour::Around).then_some(place);
                let walk = Walk { t, edits, ..request.walk };
                let here = Here { key: key.clone(), walk: &walk, weights: &tour.weights(place, ends) };
                let frame = || {
                    let point = self.point_on(card, step, path.as_ref(), &here)?;
                    let weights = here.weights(&self.office);
                    anyhow::Ok(render(self, &weights, point.as_ref()))
                };
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

    /// The material at a step of a strip, edited where it has a reel.
    fn point_on(&mut self, card: Card, step: usize, path: &dyn Path, here: &Here) -> Result<Arc<dyn Brdf>> {
        let Some(reel) = self.reels.get(&card) else {
            return Ok(Arc::from(path.at(&here.weights(&self.office))?));
        };
        if let Some(point) = reel.points.get(&step) {
            return Ok(Arc::clone(point));
        }
        let (point, _) = self.office.exact(path, here)?;
        if let Some(reel) = self.reels.get_mut(&card) {
            reel.points.insert(step, Arc::clone(&point));
        }
        Ok(point)
    }

    /// The path of a method, if it is ready by now.
    fn ready(&self, key: &Key) -> Option<Arc<dyn Path>> {
        match self.office.paths.get(key) {
            Some(Prepared::Ready(path)) => Some(path),
            _ => None,
        }
    }
}
