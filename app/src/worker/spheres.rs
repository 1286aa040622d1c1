//! The thread that renders spheres: coarse at once, fine when nothing newer was asked for.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;
use std::time::{Duration, Instant};

use nbrdf_core::path::mix::{Mix, Mixed};
use nbrdf_core::render::{METRIC_SIZE, Sphere};
use nbrdf_core::{Brdf, Image, Path, Weights};
use rayon::prelude::*;

use super::figures::Seen;
use super::paths::Prepared;
use super::picture::{Picture, exposed};
use super::{Answer, Card, Lighting, Office, Request, STRIP_STEPS, guarded};

/// All fine pictures together may take this long before coarse ones go ahead of them.
const AT_ONCE: Duration = Duration::from_millis(25);
/// How long nothing new must come before fine pictures are rendered.
const QUIET: Duration = Duration::from_millis(60);

/// What a picture shows: card, ends, t of a method.
type Subject = (Card, [String; 2], u32);

/// One sphere to render.
struct Shown {
    subject: Subject,
    brdf: Arc<dyn Brdf>,
}

/// The thread's memory.
struct Studio {
    office: Office,
    spheres: HashMap<usize, (Lighting, Arc<Sphere>)>,
    images: HashMap<(Card, usize), (Subject, Lighting, Arc<Image>)>,
    sent: HashMap<Card, (Subject, Lighting, u32, usize)>,
    strips: HashMap<Card, ([String; 2], Lighting, u32, usize)>,
    /// What the user was told about these ends; nobody wants to dismiss it twice.
    told: ([String; 2], HashSet<String>),
    /// Running mean of seconds per pixel and lamp.
    pace: f64,
}

/// Renders the newest request until the mailbox closes.
pub(super) fn run(office: Office) {
    let requests = Arc::clone(&office.requests);
    let mut studio = Studio {
        office,
        spheres: HashMap::new(),
        images: HashMap::new(),
        sent: HashMap::new(),
        strips: HashMap::new(),
        told: Default::default(),
        pace: 2e-8,
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
        let Some((spheres, mix, pending)) = self.gather(request) else { return true };
        let lamps = request.lighting.light().lamps.len();
        let work = (spheres.len() * request.size * request.size * lamps) as f64;
        let at_once = work * self.pace < AT_ONCE.as_secs_f64();
        let size = if at_once { request.size } else { METRIC_SIZE.min(request.size) };
        for sphere in &spheres {
            self.send(sphere, request, size);
        }
        self.compare(&spheres, &mix, request);
        if !at_once {
            if !self.office.requests.stays_quiet(QUIET) {
                return false;
            }
            for sphere in &spheres {
                self.send(sphere, request, request.size);
                if self.office.requests.has_news() {
                    return false;
                }
            }
        }
        self.roll(request) && !pending
    }

    /// The spheres of a request that can be rendered by now, the linear mix, and whether some must wait.
    fn gather(&mut self, request: &Request) -> Option<(Vec<Shown>, Shown, bool)> {
        let ends = &request.ends;
        let mut found = Vec::new();
        for (card, name) in [Card::A, Card::B].into_iter().zip(ends) {
            let Some(material) = self.office.material(name) else {
                let why = format!("There is no material `{name}`; choose one from the list.");
                self.withdraw(card, Answer::Failed(card, why.clone()));
                self.tell(ends, why);
                continue;
            };
            let alone = [name.clone(), String::new()];
            found.push(Shown { subject: (card, alone, 0), brdf: material.brdf });
        }
        let [a, b] = found.as_slice() else { return None };
        let parts = vec![(1.0 - request.t, Arc::clone(&a.brdf)), (request.t, Arc::clone(&b.brdf))];
        let parts = parts.into_iter().filter(|(weight, _)| *weight != 0.0).collect();
        // The mix is kept under a name that no method of the catalog has.
        let subject = (Card::Method(""), ends.clone(), request.t.to_bits());
        let mix = Shown { subject, brdf: Arc::new(Mixed::new(Mix::Linear, parts)) };
        let mut wanted = Vec::new();
        for &method in &request.methods {
            let card = Card::Method(method);
            let subject = (card, ends.clone(), request.t.to_bits());
            let key = (ends.clone(), method);
            match self.office.paths.get(&key) {
                Some(Prepared::Ready(path)) => match point(path.as_ref(), request.t) {
                    Ok(brdf) => found.push(Shown { subject, brdf }),
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
        Some((found, mix, pending))
    }

    /// There is no such sphere now: the window forgets what it has of it, so nothing counts as sent.
    fn withdraw(&mut self, card: Card, answer: Answer) {
        self.sent.remove(&card);
        self.strips.remove(&card);
        self.office.say(answer);
    }

    fn tell(&mut self, ends: &[String; 2], why: String) {
        if self.told.0 != *ends {
            self.told = (ends.clone(), HashSet::new());
        }
        if self.told.1.insert(why.clone()) {
            self.office.say(Answer::Notice(why));
        }
    }

    /// Renders and sends a sphere, unless the window has that picture.
    fn send(&mut self, shown: &Shown, request: &Request, size: usize) {
        let card = shown.subject.0;
        let stamp = (shown.subject.clone(), request.lighting, request.exposure.to_bits(), size);
        let is_there = |sent: &(Subject, Lighting, u32, usize)| {
            (&sent.0, sent.1, sent.2) == (&stamp.0, stamp.1, stamp.2) && sent.3 >= size
        };
        if self.sent.get(&card).is_some_and(is_there) {
            return;
        }
        match self.image(shown, request.lighting, size) {
            Ok(image) => {
                self.office.say(Answer::Picture(card, Picture::of(&exposed(&image, request.exposure))));
                self.sent.insert(card, stamp);
            }
            Err(why) => {
                self.withdraw(card, Answer::Failed(card, why.clone()));
                self.tell(&request.ends, why);
            }
        }
    }

    fn compare(&mut self, spheres: &[Shown], mix: &Shown, request: &Request) {
        let images: Result<Vec<_>, _> =
            spheres.iter().chain([mix]).map(|shown| self.image(shown, request.lighting, METRIC_SIZE)).collect();
        // A sphere that fails has said so when it was sent.
        let Ok(images) = images else { return };
        let seen: Vec<Seen> = images.par_iter().map(|image| Seen::new(exposed(image, request.exposure))).collect();
        let [ends @ .., mix] = seen.as_slice() else { return };
        let covered = self.sphere(request.lighting, METRIC_SIZE);
        for (shown, picture) in spheres.iter().zip(&seen) {
            let figures = picture.compare(mix, [&ends[0], &ends[1]], covered.covered());
            self.office.say(Answer::Figures(shown.subject.0, figures));
        }
    }

    /// Renders film strips that changed; whether it came to the end.
    fn roll(&mut self, request: &Request) -> bool {
        for &method in request.methods.iter().filter(|_| request.strip > 0) {
            let card = Card::Method(method);
            let stamp = (request.ends.clone(), request.lighting, request.exposure.to_bits(), request.strip);
            if self.strips.get(&card) == Some(&stamp) {
                continue;
            }
            let Some(Prepared::Ready(path)) = self.office.paths.get(&(request.ends.clone(), method)) else { continue };
            let sphere = self.sphere(request.lighting, request.strip);
            for step in 0..STRIP_STEPS {
                if self.office.requests.has_news() {
                    return false;
                }
                let t = step as f32 / (STRIP_STEPS - 1) as f32;
                let Ok(brdf) = point(path.as_ref(), t) else { continue };
                let Ok(image) = guarded("Rendering", || sphere.render(brdf.as_ref())) else { continue };
                self.office.say(Answer::Frame(card, step, Picture::of(&exposed(&image, request.exposure))));
            }
            self.strips.insert(card, stamp);
        }
        true
    }

    /// The linear picture; at most one of each size is kept per card.
    fn image(&mut self, shown: &Shown, lighting: Lighting, size: usize) -> Result<Arc<Image>, String> {
        let place = (shown.subject.0, size);
        if let Some((subject, light, image)) = self.images.get(&place)
            && (subject, *light) == (&shown.subject, lighting)
        {
            return Ok(Arc::clone(image));
        }
        let sphere = self.sphere(lighting, size);
        let start = Instant::now();
        let image = Arc::new(guarded("Rendering", || sphere.render(shown.brdf.as_ref()))?);
        let work = size * size * sphere.light().lamps.len();
        self.pace = 0.8 * self.pace + 0.2 * start.elapsed().as_secs_f64() / work as f64;
        self.images.retain(|(card, other), _| *card != place.0 || *other == METRIC_SIZE || *other == size);
        self.images.insert(place, (shown.subject.clone(), lighting, Arc::clone(&image)));
        Ok(image)
    }

    /// The geometry; one light is kept for each of a few sizes.
    fn sphere(&mut self, lighting: Lighting, size: usize) -> Arc<Sphere> {
        if let Some((light, sphere)) = self.spheres.get(&size)
            && *light == lighting
        {
            return Arc::clone(sphere);
        }
        if self.spheres.len() >= 4 {
            self.spheres.clear();
        }
        let sphere = Arc::new(Sphere::new(size, &lighting.light()));
        self.spheres.insert(size, (lighting, Arc::clone(&sphere)));
        sphere
    }
}

fn point(path: &dyn Path, t: f32) -> Result<Arc<dyn Brdf>, String> {
    let point = guarded("The path", || path.at(&Weights::two(t)))?;
    point.map(Arc::from).map_err(|error| error.to_string())
}
