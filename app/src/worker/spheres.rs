//! Spheres under lamps: coarse at once, fine when left alone, and compared.

use std::sync::Arc;
use std::time::Duration;

use nbrdf_core::image::Tone;
use nbrdf_core::render::METRIC_SIZE;
use rayon::prelude::*;

use super::films::{Set, Subject};
use super::picture::Picture;
use super::strips::Frame;
use super::studio::{MIX, QUIET, Studio};
use super::{Answer, Card, Request, Scenery, Timing};

/// All fine pictures together may take this long before coarse ones go ahead of them.
const AT_ONCE: Duration = Duration::from_millis(25);

/// What a picture in the window shows: subject, what it is seen on, exposure, tone curve, size.
pub(super) type Sent = (Subject, Scenery, (u32, Tone), usize);

impl Studio {
    /// Renders and compares the spheres, then the film strips; whether it came to the end.
    pub fn under_lamps(&mut self, subjects: &[Subject], request: &Request, set: Set) -> bool {
        let large: Vec<&Subject> = subjects.iter().filter(|subject| request.is_large(subject.card)).collect();
        let at_once = self.films.expected(large.len(), set, request.size) < AT_ONCE;
        let size = if at_once { request.size } else { METRIC_SIZE.min(request.size) };
        for subject in subjects {
            let own = if request.is_large(subject.card) { size } else { METRIC_SIZE.min(size) };
            self.send(subject, request, set, own, &|| false);
        }
        self.differ_at(request, set, size);
        self.compare(subjects, request, set.plain());
        let requests = Arc::clone(&self.office.requests);
        let stops = || requests.has_news();
        if !at_once {
            if !requests.stays_quiet(QUIET) {
                return false;
            }
            for subject in large {
                self.send(subject, request, set, request.size, &stops);
                if stops() {
                    return false;
                }
            }
            self.differ_at(request, set, request.size);
        }
        self.roll(request, |studio, _, brdf| {
            let sphere = studio.films.sets.sphere(set.whole(), request.strip, &stops)?;
            let sight = studio.films.sets.sight((set.whole().scenery, set.model), request.strip, &stops)?;
            Some(Frame { image: sphere.render(brdf), opacity: sight.opacity })
        })
    }

    /// The difference of two pictures that were sent in this size.
    fn differ_at(&mut self, request: &Request, set: Set, size: usize) {
        if request.closeup.is_none_or(|closeup| closeup.scale.is_none()) {
            return;
        }
        // It is there: the pictures were made with it.
        let Some(sight) = self.films.sets.sight((set.scenery, set.model), size, &|| false) else { return };
        self.differ(request, &sight, |studio, card| studio.films.image(card, set, size).cloned());
    }

    /// Renders and sends a sphere, unless the window has that picture or it is stopped.
    fn send(&mut self, subject: &Subject, request: &Request, set: Set, size: usize, stops: &(dyn Fn() -> bool + Sync)) {
        let card = subject.card;
        let stamp = (subject.clone(), set.scenery, (request.exposure.to_bits(), request.tone), size);
        let is_there = |sent: &Sent| (&sent.0, sent.1, sent.2) == (&stamp.0, stamp.1, stamp.2) && sent.3 >= size;
        if self.sent.get(&card).is_some_and(is_there) {
            return;
        }
        match self.render(subject, set, size, stops) {
            Ok(true) => {}
            Ok(false) => return,
            Err(why) => {
                self.withdraw(card, Answer::Failed(card, why.clone()));
                self.tell(&request.ends, why);
            }
        }
        let Some(sight) = self.films.sets.sight((set.scenery, set.model), size, stops) else { return };
        if let Some(image) = self.films.image(card, set, size) {
            let picture = Picture::of(image, request.showing(), &sight.opacity, &self.office.plates);
            self.office.say(Answer::Picture(card, picture));
            self.sent.insert(card, stamp);
        }
    }

    /// Compares the spheres with the linear mix and the ends, as they are seen: on a whole sphere, whatever else is shown,
    /// and through the clip curve.
    fn compare(&mut self, subjects: &[Subject], request: &Request, set: Set) {
        let mix = Subject {
            card: MIX,
            ends: Arc::clone(&request.ends),
            point: Some((request.weights.clone(), Timing::Straight)),
            edited: None,
        };
        // A sphere that fails has said so when it was sent.
        let is_fine = |subject: &&Subject| self.render(subject, set, METRIC_SIZE, &|| false).is_ok();
        let cards: Vec<Card> = subjects.iter().chain([&mix]).filter(is_fine).map(|subject| subject.card).collect();
        let has = |card: &Card| cards.contains(card);
        for Subject { card, .. } in subjects.iter().filter(|subject| !has(&subject.card)) {
            self.office.say(Answer::Figures(*card, None));
        }
        let is_comparable = has(&MIX) && (0..request.ends.len()).all(|end| has(&Card::End(end)));
        if !is_comparable {
            return;
        }
        let Some(sphere) = self.films.sets.sphere(set, METRIC_SIZE, &|| false) else { return };
        let (covered, gain) = (sphere.covered(), request.exposure.exp2());
        self.seen.resize_with(cards.len(), Default::default);
        self.seen.par_iter_mut().zip(&cards).for_each(|(seen, card)| {
            self.films.image(*card, set, METRIC_SIZE).into_iter().for_each(|image| seen.look(image, gain, covered));
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
