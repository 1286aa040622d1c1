//! The thread that prepares paths: it encodes the ends, and learns a basis where one is needed.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use anyhow::{Context, Result};
use nbrdf_core::path::even::Even;
use nbrdf_core::{Interpolation as _, Path};

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
pub struct Paths(Mutex<HashMap<Key, Prepared>>);

impl Paths {
    /// The path, if it was prepared.
    pub fn get(&self, key: &Key) -> Option<Prepared> {
        self.lock().get(key).cloned()
    }

    fn insert(&self, key: Key, prepared: Prepared) {
        let mut paths = self.lock();
        if paths.len() >= KEPT {
            paths.clear();
        }
        paths.insert(key, prepared);
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<Key, Prepared>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Prepares what is wanted until the mailbox closes.
pub(super) fn run(office: &Office) {
    while let Some(wanted) = office.wants.take() {
        for key in wanted {
            if office.paths.get(&key).is_some() {
                continue;
            }
            let title = title(key.method);
            office.say(Answer::Preparing(Some(title)));
            let prepared = match guarded(title, || prepare(office, &key)) {
                Ok(Ok(path)) => Prepared::Ready(path),
                Ok(Err(error)) => Prepared::Failed(format!("{title}: {error:#}")),
                Err(panic) => Prepared::Failed(panic),
            };
            if let Prepared::Failed(why) = &prepared {
                office.say(Answer::Notice(why.clone()));
            }
            office.paths.insert(key, prepared);
            office.requests.again();
            if office.wants.has_news() {
                break;
            }
        }
        office.say(Answer::Preparing(None));
    }
}

fn prepare(office: &Office, Key { ends, method, timing }: &Key) -> Result<Arc<dyn Path>> {
    let find = |name: &String| office.material(name).with_context(|| format!("no material `{name}`"));
    let ends: Vec<_> = ends.iter().map(find).collect::<Result<_>>()?;
    let interpolation = (office.stock.interpolation)(method)?;
    let path = match timing {
        Timing::Straight => interpolation.between(&ends)?,
        Timing::Even => Even::new(method, interpolation).between(&ends)?,
    };
    Ok(Arc::from(path))
}

/// Name of a method for people.
fn title(method: &'static str) -> &'static str {
    Catalog::interpolation_entry(method).map_or(method, |entry| entry.title)
}
