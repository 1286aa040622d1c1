//! The thread that renders: what was asked for last, coarse at once, fine when nothing newer came.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;
use std::time::Duration;

use nbrdf_core::path::mix::{Mix, Mixed};
use nbrdf_core::{Brdf, Path, Weights};

use super::edits::Want;
use super::figures::Seen;
use super::films::{Films, Set, Subject};
use super::paths::Prepared;
use super::spheres::Sent;
use super::strips::{Reel, Strip};
use super::surround::Lobes;
use super::{Answer, Card, Office, Request, guarded};

/// How long nothing new must come before finer pictures are rendered.
pub(super) const QUIET: Duration = Duration::from_millis(60);
/// The linear mix is kept under a name that no method of the catalog has.
pub(super) const MIX: Card = Card::Method("");

/// The thread's memory.
pub(super) struct Studio {
    pub office: Office,
    /// The present point of every path, moved in place.
    points: HashMap<Card, Box<dyn Brdf>>,
    pub films: Films,
    /// What the window has of every card.
    pub sent: HashMap<Card, Sent>,
    pub strips: HashMap<Card, Strip>,
    /// Edited points of the film strips.
    pub reels: HashMap<Card, Reel>,
    pub seen: Vec<Seen>,
    /// What the user was told about these ends; nobody wants to dismiss it twice.
    told: (Arc<[String]>, HashSet<String>),
    pub lobes: Lobes,
    arrivals: u64,
}

/// Renders the newest request until the mailbox closes.
pub(super) fn run(office: &Office) {
    let requests = Arc::clone(&office.requests);
    let mut studio = Studio {
        office: office.clone(),
        points: HashMap::new(),
        films: Films::default(),
        sent: HashMap::new(),
        strips: HashMap::new(),
        reels: HashMap::new(),
        seen: Vec::new(),
        told: (Arc::new([]), HashSet::new()),
        lobes: HashMap::new(),
        arrivals: 0,
    };
    while let Some((number, request)) = requests.take() {
        let _busy = office.activity.begin();
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
        // Before materials, mesh and map are looked up: what arrives from here on is noticed the next time.
        let arrivals = self.office.arrivals();
        if arrivals != self.arrivals {
            // The same request may be for another picture.
            self.arrivals = arrivals;
            self.films.clear();
            self.films.sets.clear();
            self.sent.clear();
            self.strips.clear();
            self.lobes.clear();
            self.reels.clear();
        }
        let Some((subjects, pending)) = self.gather(request) else { return true };
        let scenery = request.scenery;
        let model = self.office.model(scenery.shape);
        let is_shown = match scenery.lighting.lamps() {
            Some(light) => self.under_lamps(&subjects, request, Set { scenery, light: &light, model: &model }),
            None => self.surrounded(&subjects, request, &model),
        };
        is_shown && !pending
    }

    /// What of a request can be rendered by now, and whether some must wait. Points of paths, ends and the linear mix
    /// lie in `points` afterwards.
    fn gather(&mut self, request: &Request) -> Option<(Vec<Subject>, bool)> {
        let ends = &request.ends;
        let mut found: Vec<Subject> = Vec::new();
        let mut parts = Vec::new();
        for ((end, name), &weight) in ends.iter().enumerate().zip(request.weights.as_slice()) {
            let card = Card::End(end);
            let Some(material) = self.office.material(name) else {
                let why = format!("There is no material `{name}`; choose one from the list.");
                self.withdraw(card, Answer::Failed(card, why.clone()));
                self.tell(ends, why);
                continue;
            };
            self.points.insert(card, Box::new(Mixed::new(Mix::Linear, vec![(1.0, Arc::clone(&material.brdf))])));
            parts.push((weight, material.brdf));
            found.push(Subject { card, ends: Arc::new([name.clone()]), point: None, edited: None });
        }
        if found.len() < ends.len() {
            for &method in &request.methods {
                let card = Card::Method(method);
                self.withdraw(card, Answer::Failed(card, "a material of the blend is missing".to_owned()));
            }
            return None;
        }
        let parts = parts.into_iter().filter(|(weight, _)| *weight != 0.0).collect();
        self.points.insert(MIX, Box::new(Mixed::new(Mix::Linear, parts)));
        let (mut wanted, mut changes) = (Vec::new(), Vec::new());
        for &method in &request.methods {
            let card = Card::Method(method);
            let key = request.key(method);
            match self.office.paths.get(&key) {
                Some(Prepared::Ready(path)) => {
                    let weights = self.office.paths.weights(&key, request.walk.t, &request.weights);
                    let moved = self.move_to(card, path.as_ref(), &weights);
                    let edit = |()| self.edit(card, path.as_ref(), &weights, &request.walk, &mut changes);
                    match moved.and_then(edit) {
                        Ok(edited) => {
                            let point = Some((weights, request.timing));
                            found.push(Subject { card, ends: Arc::clone(ends), point, edited });
                        }
                        Err(why) => self.withdraw(card, Answer::Failed(card, why)),
                    }
                }
                Some(Prepared::Failed(why)) => self.withdraw(card, Answer::Failed(card, why)),
                None => {
                    self.withdraw(card, Answer::Pending(card));
                    wanted.push(key);
                }
            }
        }
        // What is only measured is not waited for.
        let is_waiting = |want: &Want| self.office.found.exact(want).is_none();
        let is_editing = request.walk.is_edit() && changes.iter().any(is_waiting);
        if !changes.is_empty() {
            self.office.changes.put(changes);
        }
        let pending = !wanted.is_empty();
        if pending {
            self.office.wants.put(wanted);
        }
        let (explored, is_waiting) = self.explore(request);
        found.extend(explored);
        Some((found, pending || is_waiting || is_editing))
    }

    /// Puts a card's point at these weights: in place, where there is one.
    fn move_to(&mut self, card: Card, path: &dyn Path, weights: &Weights) -> Result<(), String> {
        let moved = guarded("The path", || match self.points.get_mut(&card) {
            Some(point) => path.move_to(weights, point),
            None => path.at(weights).map(|point| drop(self.points.insert(card, point))),
        })?;
        moved.map_err(|error| error.to_string())
    }

    /// Puts a material on a card.
    pub fn put(&mut self, card: Card, point: Box<dyn Brdf>) {
        self.points.insert(card, point);
    }

    /// The material that a card shows now.
    pub fn point(&self, card: Card) -> Option<&dyn Brdf> {
        self.points.get(&card).map(Box::as_ref)
    }

    /// Renders a subject's present point, unless that picture is there; whether it was not stopped.
    pub fn render(
        &mut self,
        subject: &Subject,
        set: Set,
        size: usize,
        stops: &(dyn Fn() -> bool + Sync),
    ) -> Result<bool, String> {
        let point = self.points.get(&subject.card).ok_or("there is no such material")?;
        self.films.render(subject, point.as_ref(), set, size, stops)
    }

    /// There is no such sphere now: the window forgets what it has of it, so nothing counts as sent.
    pub fn withdraw(&mut self, card: Card, answer: Answer) {
        self.sent.remove(&card);
        self.strips.remove(&card);
        self.office.found.forget(card);
        self.office.say(answer);
    }

    /// A notice, once for these ends.
    pub fn tell(&mut self, ends: &Arc<[String]>, why: String) {
        if self.told.0 != *ends {
            self.told = (Arc::clone(ends), HashSet::new());
        }
        if self.told.1.insert(why.clone()) {
            self.office.say(Answer::Notice(why));
        }
    }
}
