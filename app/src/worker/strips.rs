//! Film strips: a whole path in a row of small pictures.

use std::sync::Arc;

use nbrdf_core::{Brdf, Image, Path, Weights};

use super::paths::{Key, Prepared};
use super::picture::Picture;
use super::studio::Studio;
use super::{Answer, Card, Request, STRIP_STEPS, Scenery, Timing, guarded};

/// What a film strip in the window shows: ends, timing, scenery, exposure, size.
pub(super) type Strip = (Arc<[String]>, Timing, Scenery, u32, usize);

impl Studio {
    /// Renders film strips that changed, the material at t with `render`; whether it came to the end.
    pub fn roll(&mut self, request: &Request, mut render: impl FnMut(&mut Self, &Weights, &dyn Brdf) -> Image) -> bool {
        for &method in request.methods.iter().filter(|_| request.strip > 0) {
            let card = Card::Method(method);
            let strip =
                (Arc::clone(&request.ends), request.timing, request.scenery, request.exposure.to_bits(), request.strip);
            let Some(path) = self.ready(method, request).filter(|_| self.strips.get(&card) != Some(&strip)) else {
                continue;
            };
            for step in 0..STRIP_STEPS {
                if self.office.requests.has_news() {
                    return false;
                }
                let t = step as f32 / (STRIP_STEPS - 1) as f32;
                let weights = Weights::along_spline(t, request.ends.len());
                let frame = || path.at(&weights).map(|brdf| render(self, &weights, brdf.as_ref()));
                // Where the sphere itself fails, its card says so.
                let Ok(Ok(image)) = guarded("Rendering", frame) else { continue };
                let picture = Picture::of(&image, request.exposure, &self.office.plates);
                self.office.say(Answer::Frame(card, step, picture));
            }
            self.strips.insert(card, strip);
        }
        true
    }

    /// The path of a method, if it is ready by now.
    fn ready(&self, method: &'static str, request: &Request) -> Option<Arc<dyn Path>> {
        let key = Key { ends: Arc::clone(&request.ends), method, timing: request.timing };
        match self.office.paths.get(&key) {
            Some(Prepared::Ready(path)) => Some(path),
            _ => None,
        }
    }
}
