//! Spheres under lamps: coarse at once, fine when left alone, and compared.

use std::sync::Arc;
use std::time::Duration;

use nbrdf_core::render::{Light, METRIC_SIZE};
use rayon::prelude::*;

use super::films::Subject;
use super::picture::Picture;
use super::studio::{MIX, QUIET, Studio};
use super::{Answer, Card, Request, Scenery, Timing};

/// All fine pictures together may take this long before coarse ones go ahead of them.
const AT_ONCE: Duration = Duration::from_millis(25);

/// What a picture in the window shows: subject, light, exposure, size.
pub(super) type Sent = (Subject, Scenery, u32, usize);

impl Studio {
    /// Renders and compares the spheres, then the film strips; whether it came to the end.
    pub fn under_lamps(&mut self, subjects: &[Subject], request: &Request, light: &Light) -> bool {
        let at_once = self.films.expected(subjects.len(), request.size, light) < AT_ONCE;
        let size = if at_once { request.size } else { METRIC_SIZE.min(request.size) };
        for subject in subjects {
            self.send(subject, request, light, size);
        }
        self.compare(subjects, request, light);
        if !at_once {
            if !self.office.requests.stays_quiet(QUIET) {
                return false;
            }
            for subject in subjects {
                self.send(subject, request, light, request.size);
                if self.office.requests.has_news() {
                    return false;
                }
            }
        }
        self.roll(request, |studio, _, brdf| studio.films.sphere(request.scenery, light, request.strip).render(brdf))
    }

    /// Renders and sends a sphere, unless the window has that picture.
    fn send(&mut self, subject: &Subject, request: &Request, light: &Light, size: usize) {
        let card = subject.card;
        let stamp = (subject.clone(), request.scenery, request.exposure.to_bits(), size);
        let is_there = |sent: &Sent| (&sent.0, sent.1, sent.2) == (&stamp.0, stamp.1, stamp.2) && sent.3 >= size;
        if self.sent.get(&card).is_some_and(is_there) {
            return;
        }
        if let Err(why) = self.render(subject, (request.scenery, light), size) {
            self.withdraw(card, Answer::Failed(card, why.clone()));
            self.tell(&request.ends, why);
        }
        if let Some(image) = self.films.image(card, size) {
            self.office.say(Answer::Picture(card, Picture::of(image, request.exposure, &self.office.plates)));
            self.sent.insert(card, stamp);
        }
    }

    /// Compares the spheres with the linear mix and the ends, as they are seen.
    fn compare(&mut self, subjects: &[Subject], request: &Request, light: &Light) {
        let mix = Subject {
            card: MIX,
            ends: Arc::clone(&request.ends),
            point: Some((request.weights.clone(), Timing::Straight)),
        };
        for subject in subjects.iter().chain([&mix]) {
            // A sphere that fails has said so when it was sent.
            if self.render(subject, (request.scenery, light), METRIC_SIZE).is_err() {
                return;
            }
        }
        let sphere = self.films.sphere(request.scenery, light, METRIC_SIZE);
        let (covered, gain) = (sphere.covered(), request.exposure.exp2());
        self.seen.resize_with(subjects.len() + 1, Default::default);
        let cards: Vec<_> = subjects.iter().map(|subject| subject.card).chain([MIX]).collect();
        self.seen.par_iter_mut().zip(&cards).for_each(|(seen, card)| {
            self.films.image(*card, METRIC_SIZE).into_iter().for_each(|image| seen.look(image, gain, covered));
        });
        let [spheres @ .., mix] = self.seen.as_slice() else { return };
        // Ends come first.
        let ends = &spheres[..request.ends.len()];
        for (card, seen) in cards.iter().zip(spheres) {
            let own = if let Card::End(end) = card { Some(*end) } else { None };
            let figures = seen.compare(mix, ends, own, covered);
            self.office.say(Answer::Figures(*card, Some(figures)));
        }
    }
}
