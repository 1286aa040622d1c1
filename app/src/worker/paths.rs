//! The thread that prepares paths: it encodes the ends, and learns a basis where one is needed.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use anyhow::{Context, Result};
use nbrdf_core::path::clock::Clock;
use nbrdf_core::path::even::Even;
use nbrdf_core::{Interpolation as _, Path, Weights};

use super::{Answer, Office, Timing, guarded};
use crate::catalog::Catalog;

/// What a path is prepared from.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Key {
    /// Names of the ends.
    pub ends: Arc<[String]>,
    /// Catalog name of the interpolation.
    pub method: &'static str,
    /// How t runs.
    pub timing: Timing,
}

impl Key {
    /// Of a method's path between these ends.
    pub fn new(ends: &Arc<[String]>, method: &'static str, timing: Timing) -> Self {
        Self { ends: Arc::clone(ends), method, timing }
    }
}

/// Paths kept at most; they are small, so this only bounds a long day's work.
const KEPT: usize = 256;

/// What became of a path.
#[derive(Clone)]
pub enum Prepared {
    /// It can be walked.
    Ready(Arc<dyn Path>),
    /// It cannot, for this reason.
    Failed(String),
}

/// All paths prepared so far.
#[derive(Default)]
pub struct Paths {
    prepared: Mutex<HashMap<Key, Prepared>>,
    /// When to be where, on even paths between three ends and more.
    clocks: Mutex<HashMap<Key, Clock>>,
}

impl Paths {
    /// The path, if it was prepared.
    pub fn get(&self, key: &Key) -> Option<Prepared> {
        self.lock().get(key).cloned()
    }

    /// Weights of a path's ends at a time along them; others stay as they are.
    pub fn weights(&self, key: &Key, t: Option<f32>, plain: &Weights) -> Weights {
        let is_timed = key.timing == Timing::Even && key.ends.len() > 2;
        let Some(t) = t.filter(|_| is_timed) else { return plain.clone() };
        let clocks = self.clocks.lock().unwrap_or_else(PoisonError::into_inner);
        clocks.get(key).map_or_else(|| plain.clone(), |clock| Weights::along_spline(clock.set(t), key.ends.len()))
    }

    /// Keeps a path, unless its materials may be others by now.
    fn insert(&self, key: Key, prepared: Prepared, clock: Option<Clock>, is_still: impl Fn() -> bool) {
        let mut paths = self.lock();
        // Under the lock: whoever changes materials says so before asking to forget their paths.
        if !is_still() {
            return;
        }
        let mut clocks = self.clocks.lock().unwrap_or_else(PoisonError::into_inner);
        if paths.len() >= KEPT {
            paths.clear();
            clocks.clear();
        }
        clocks.extend(clock.map(|clock| (key.clone(), clock)));
        paths.insert(key, prepared);
    }

    /// Forgets the paths between materials that are others now.
    pub fn forget(&self, names: &[String]) {
        let is_true = |key: &Key| !key.ends.iter().any(|end| names.contains(end));
        self.lock().retain(|key, _| is_true(key));
        self.clocks.lock().unwrap_or_else(PoisonError::into_inner).retain(|key, _| is_true(key));
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<Key, Prepared>> {
        self.prepared.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Prepares what is wanted until the mailbox closes.
pub(super) fn run(office: &Office) {
    while let Some(wanted) = office.wants.take() {
        let _busy = office.activity.begin();
        for key in wanted {
            if office.paths.get(&key).is_some() {
                // Somebody else made it, after it was missed.
                office.ring();
                continue;
            }
            let (title, arrivals) = (title(key.method), office.arrivals());
            office.say(Answer::Preparing(Some(title)));
            let (prepared, clock) = match guarded(title, || prepare(office, &key)) {
                Ok(Ok((path, clock))) => (Prepared::Ready(path), clock),
                Ok(Err(error)) => (Prepared::Failed(format!("{title}: {error:#}")), None),
                Err(panic) => (Prepared::Failed(panic), None),
            };
            if office.arrivals() != arrivals {
                // An end may be another by now; whoever wants the path asks for it again.
                office.ring();
                continue;
            }
            if let Prepared::Failed(why) = &prepared {
                office.say(Answer::Notice(why.clone()));
            }
            office.keep(key, prepared, clock, arrivals);
            if office.wants.has_news() {
                break;
            }
        }
        office.say(Answer::Preparing(None));
    }
}

impl Office {
    /// Keeps a path that was begun after so many [arrivals](Self::arrivals), and tells everybody who may have waited for it.
    pub(super) fn keep(&self, key: Key, prepared: Prepared, clock: Option<Clock>, arrivals: u64) {
        self.paths.insert(key, prepared, clock, || self.arrivals() == arrivals);
        self.ring();
    }

    /// Something that was not there before is there now: whoever may have missed it looks again.
    pub(super) fn ring(&self) {
        self.requests.again();
        self.points.again();
        self.questions.again();
        self.map_requests.again();
    }
}

/// Makes a path, and the clock it is walked by where it has one of its own.
pub(super) fn prepare(office: &Office, Key { ends, method, timing }: &Key) -> Result<(Arc<dyn Path>, Option<Clock>)> {
    let find = |name: &String| office.material(name).with_context(|| format!("no material `{name}`"));
    let ends: Vec<_> = ends.iter().map(find).collect::<Result<_>>()?;
    let interpolation = (office.stock.interpolation)(method)?;
    let path = match timing {
        Timing::Even if ends.len() == 2 => Even::new(method, interpolation).between(&ends)?,
        Timing::Straight | Timing::Even => interpolation.between(&ends)?,
    };
    let is_timed = *timing == Timing::Even && ends.len() > 2;
    let clock = is_timed.then(|| Clock::of(path.as_ref(), ends.len())).transpose()?;
    Ok((Arc::from(path), clock))
}

/// Name of a method for people.
fn title(method: &'static str) -> &'static str {
    Catalog::interpolation_entry(method).map_or(method, |entry| entry.title)
}
