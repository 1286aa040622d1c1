//! The thread that renders spheres: coarse at once, fine when nothing newer was asked for.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;
use std::time::{Duration, Instant};

use nbrdf_core::path::mix::{Mix, Mixed};
use nbrdf_core::render::{Light, METRIC_SIZE, Sphere};
use nbrdf_core::{Brdf, Image, Path, Weights};
use rayon::prelude::*;

use super::figures::Seen;
use super::paths::Prepared;
use super::picture::{Picture, exposed};
use super::{Answer, Card, Lighting, Office, Request, STRIP_STEPS, guarded};

/// All fine pictures together may take this long before coarse ones go ahead of them.
const AT_ONCE: Duration = Duration::from_millis(25);
/// How long nothing new must come before fine pictures are rendered.
pub(super) const QUIET: Duration = Duration::from_millis(60);
/// The linear mix is kept under a name that no method of the catalog has.
const MIX: Card = Card::Method("");

/// What a picture shows: card, ends, t of a method.
type Subject = (Card, [String; 2], u32);
/// What a picture in the window shows: subject, light, exposure, size.
type Sent = (Subject, Lighting, u32, usize);

/// What a film strip in the window shows: ends, light, exposure, size.
pub(super) type Strip = ([String; 2], Lighting, u32, usize);

/// A picture that is rendered over and over.
struct Film {
    subject: Subject,
    lighting: Lighting,
    image: Image,
}

/// The thread's memory.
pub(super) struct Studio {
    pub(super) office: Office,
    spheres: HashMap<usize, (Lighting, Arc<Sphere>)>,
    /// The present point of every path, moved in place.
    points: HashMap<Card, Box<dyn Brdf>>,
    films: HashMap<(Card, usize), Film>,
    sent: HashMap<Card, Sent>,
    strips: HashMap<Card, Strip>,
    /// What the user was told about these ends; nobody wants to dismiss it twice.
    told: ([String; 2], HashSet<String>),
    /// Running mean of seconds per pixel and lamp.
    pace: f64,
    pub(super) lobes: super::surround::Lobes,
}

/// Renders the newest request until the mailbox closes.
pub(super) fn run(office: Office) {
    let requests = Arc::clone(&office.requests);
    let mut studio = Studio {
        office,
        spheres: HashMap::new(),
        points: HashMap::new(),
        films: HashMap::new(),
        sent: HashMap::new(),
        strips: HashMap::new(),
        told: Default::default(),
        pace: 2e-8,
        lobes: Default::default(),
    };
    while let Some((number, request)) = requests.take() {
        match guarded("Rendering", || studio.show(&request)) {
            Ok(true) => studio.office.say(Answer::Done(number)),
            Ok(false) => {}
            Err(why) => {
                studio.office.say(Answer::Notice(why));
                studio.office.say(Answer::Done(number));
            }
        }
    }
}

impl Studio {
    /// Whether everything there is to show was shown.
    fn show(&mut self, request: &Request) -> bool {
        let Some((spheres, pending)) = self.gather(request) else { return true };
        let Some(light) = request.lighting.lamps() else {
            // Lamps start anew afterwards.
            self.sent.clear();
            return self.surround(&spheres.iter().map(|subject| subject.0).collect::<Vec<_>>(), request) && !pending;
        };
        let work = (spheres.len() * request.size * request.size * light.lamps.len()) as f64;
        let at_once = work * self.pace < AT_ONCE.as_secs_f64();
        let size = if at_once { request.size } else { METRIC_SIZE.min(request.size) };
        for subject in &spheres {
            self.send(subject, request, &light, size);
        }
        self.compare(&spheres, request, &light);
        if !at_once {
            if !self.office.requests.stays_quiet(QUIET) {
                return false;
            }
            for subject in &spheres {
                self.send(subject, request, &light, request.size);
                if self.office.requests.has_news() {
                    return false;
                }
            }
        }
        self.roll(request, &light) && !pending
    }

    /// What of a request can be rendered by now, and whether some must wait. Points of paths, ends and the linear mix
    /// lie in `points` afterwards.
    fn gather(&mut self, request: &Request) -> Option<(Vec<Subject>, bool)> {
        let ends = &request.ends;
        let mut found = Vec::new();
        let mut parts = Vec::new();
        for (card, name) in [Card::A, Card::B].into_iter().zip(ends) {
            let Some(material) = self.office.material(name) else {
                let why = format!("There is no material `{name}`; choose one from the list.");
                self.withdraw(card, Answer::Failed(card, why.clone()));
                self.tell(ends, why);
                continue;
            };
            self.points.insert(card, Box::new(Mixed::new(Mix::Linear, vec![(1.0, Arc::clone(&material.brdf))])));
            let weight = if card == Card::A { 1.0 - request.t } else { request.t };
            parts.push((weight, material.brdf));
            found.push((card, [name.clone(), String::new()], 0));
        }
        if found.len() < 2 {
            return None;
        }
        let parts = parts.into_iter().filter(|(weight, _)| *weight != 0.0).collect();
        self.points.insert(MIX, Box::new(Mixed::new(Mix::Linear, parts)));
        let mut wanted = Vec::new();
        for &method in &request.methods {
            let card = Card::Method(method);
            let key = (ends.clone(), method);
            match self.office.paths.get(&key) {
                Some(Prepared::Ready(path)) => match self.move_to(card, path.as_ref(), request.t) {
                    Ok(()) => found.push((card, ends.clone(), request.t.to_bits())),
                    Err(why) => self.withdraw(card, Answer::Failed(card, why)),
                },
                Some(Prepared::Failed(why)) => self.withdraw(card, Answer::Failed(card, why)),
                None => {
                    self.withdraw(card, Answer::Pending(card));
                    wanted.push(key);
                }
            }
        }
        let pending = !wanted.is_empty();
        if pending {
            self.office.wants.put(wanted);
        }
        Some((found, pending))
    }

    /// Puts a card's point at t: in place, where there is one.
    fn move_to(&mut self, card: Card, path: &dyn Path, t: f32) -> Result<(), String> {
        let weights = Weights::two(t);
        let moved = guarded("The path", || match self.points.get_mut(&card) {
            Some(point) => path.move_to(&weights, point),
            None => path.at(&weights).map(|point| drop(self.points.insert(card, point))),
        })?;
        moved.map_err(|error| error.to_string())
    }

    /// The material that a card shows now.
    pub(super) fn point(&self, card: Card) -> Option<&dyn Brdf> {
        self.points.get(&card).map(Box::as_ref)
    }

    /// There is no such sphere now: the window forgets what it has of it, so nothing counts as sent.
    pub(super) fn withdraw(&mut self, card: Card, answer: Answer) {
        self.sent.remove(&card);
        self.strips.remove(&card);
        self.office.say(answer);
    }

    pub(super) fn tell(&mut self, ends: &[String; 2], why: String) {
        if self.told.0 != *ends {
            self.told = (ends.clone(), HashSet::new());
        }
        if self.told.1.insert(why.clone()) {
            self.office.say(Answer::Notice(why));
        }
    }

    /// Renders and sends a sphere, unless the window has that picture.
    fn send(&mut self, subject: &Subject, request: &Request, light: &Light, size: usize) {
        let card = subject.0;
        let stamp = (subject.clone(), request.lighting, request.exposure.to_bits(), size);
        let is_there = |sent: &Sent| (&sent.0, sent.1, sent.2) == (&stamp.0, stamp.1, stamp.2) && sent.3 >= size;
        if self.sent.get(&card).is_some_and(is_there) {
            return;
        }
        let plates = self.office.plates.clone();
        let picture = self
            .image(subject, request.lighting, light, size)
            .map(|image| Picture::of(image, request.exposure, &plates));
        match picture {
            Ok(picture) => {
                self.office.say(Answer::Picture(card, picture));
                self.sent.insert(card, stamp);
            }
            Err(why) => {
                self.withdraw(card, Answer::Failed(card, why.clone()));
                self.tell(&request.ends, why);
            }
        }
    }

    fn compare(&mut self, spheres: &[Subject], request: &Request, light: &Light) {
        let mix = (MIX, request.ends.clone(), request.t.to_bits());
        let mut images = Vec::new();
        for subject in spheres.iter().chain([&mix]) {
            // A sphere that fails has said so when it was sent.
            let Ok(image) = self.image(subject, request.lighting, light, METRIC_SIZE) else { return };
            images.push(exposed(image, request.exposure));
        }
        let seen: Vec<Seen> = images.into_par_iter().map(Seen::new).collect();
        let [ends @ .., mix] = seen.as_slice() else { return };
        let covered = self.sphere(request.lighting, light, METRIC_SIZE);
        for (subject, picture) in spheres.iter().zip(&seen) {
            let figures = picture.compare(mix, [&ends[0], &ends[1]], covered.covered());
            self.office.say(Answer::Figures(subject.0, Some(figures)));
        }
    }

    /// Renders film strips that changed; whether it came to the end.
    fn roll(&mut self, request: &Request, light: &Light) -> bool {
        for &method in request.methods.iter().filter(|_| request.strip > 0) {
            let card = Card::Method(method);
            let Some((path, stamp)) = self.unrolled(card, method, request) else { continue };
            let sphere = self.sphere(request.lighting, light, request.strip);
            for step in 0..STRIP_STEPS {
                if self.office.requests.has_news() {
                    return false;
                }
                let t = step as f32 / (STRIP_STEPS - 1) as f32;
                let render = || path.at(&Weights::two(t)).map(|brdf| sphere.render(brdf.as_ref()));
                let Ok(Ok(image)) = guarded("Rendering", render) else { continue };
                let picture = Picture::of(&image, request.exposure, &self.office.plates);
                self.office.say(Answer::Frame(card, step, picture));
            }
            self.rolled(card, stamp);
        }
        true
    }

    /// The path of a strip that the window does not have, if there is one by now, and what it will show.
    pub(super) fn unrolled(
        &self,
        card: Card,
        method: &'static str,
        request: &Request,
    ) -> Option<(Arc<dyn Path>, Strip)> {
        let stamp = (request.ends.clone(), request.lighting, request.exposure.to_bits(), request.strip);
        let Some(Prepared::Ready(path)) = self.office.paths.get(&(request.ends.clone(), method)) else { return None };
        (self.strips.get(&card) != Some(&stamp)).then_some((path, stamp))
    }

    /// The window has this strip now.
    pub(super) fn rolled(&mut self, card: Card, stamp: Strip) {
        self.strips.insert(card, stamp);
    }

    /// The linear picture; at most one of each size is kept per card, and rendered over.
    fn image(&mut self, subject: &Subject, lighting: Lighting, light: &Light, size: usize) -> Result<&Image, String> {
        let place = (subject.0, size);
        let sphere = self.sphere(lighting, light, size);
        self.films.retain(|(card, other), _| *card != place.0 || *other == METRIC_SIZE || *other == size);
        let Self { films, points, pace, .. } = self;
        let point = points.get(&subject.0).ok_or("there is no such material")?;
        let film = films.entry(place).or_insert_with(|| Film {
            subject: (subject.0, Default::default(), 0),
            lighting,
            image: Image::black(size, size),
        });
        if (&film.subject, film.lighting) != (subject, lighting) {
            let start = Instant::now();
            // A picture that is not finished is none of anything.
            film.subject.1 = Default::default();
            guarded("Rendering", || sphere.render_into(point.as_ref(), &mut film.image))?;
            let work = size * size * light.lamps.len();
            *pace = 0.8 * *pace + 0.2 * start.elapsed().as_secs_f64() / work as f64;
            (film.subject, film.lighting) = (subject.clone(), lighting);
        }
        Ok(&film.image)
    }

    /// The geometry; one light is kept for each of a few sizes.
    fn sphere(&mut self, lighting: Lighting, light: &Light, size: usize) -> Arc<Sphere> {
        if let Some((known, sphere)) = self.spheres.get(&size)
            && *known == lighting
        {
            return Arc::clone(sphere);
        }
        if self.spheres.len() >= 4 {
            self.spheres.clear();
        }
        let sphere = Arc::new(Sphere::new(size, light));
        self.spheres.insert(size, (lighting, Arc::clone(&sphere)));
        sphere
    }
}
