//! The thread that edits points of paths: an edit takes too long for a frame, so that while t moves the last change of
//! the code is added to the new one, and the true edit follows.

use std::collections::HashMap;
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use nbrdf_core::axis::Axis;
use nbrdf_core::quality::Qualities;
use nbrdf_core::{Code, Path, Representation as _, Weights};

use super::studio::{QUIET, Studio};
use super::walk::{Edits, is_edit};
use super::{Answer, Card, Office, Walk, guarded};
use crate::editor::{Edited, Editor};

/// Qualities of the point that a card shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// As the path has it.
    pub before: Qualities,
    /// As it is edited.
    pub after: Qualities,
    /// Which edits went less far than asked for, and why, for people.
    pub shortfalls: Vec<String>,
}

/// What is to be edited.
#[derive(Clone, PartialEq)]
pub(super) struct Want {
    pub card: Card,
    pub code: Code,
    pub edits: Edits,
}

/// The last edit of each card: what was asked for, and the numbers that it led to.
#[derive(Default)]
pub(super) struct Found(Mutex<ByCard>);

/// The last edit of each card.
type ByCard = HashMap<Card, (Want, Arc<[f32]>)>;

impl Found {
    /// A card shows nothing: what it showed before is measured anew.
    pub fn forget(&self, card: Card) {
        self.lock().remove(&card);
    }

    /// The numbers that just this led to, if it was edited last.
    pub fn exact(&self, want: &Want) -> Option<Arc<[f32]>> {
        self.lock().get(&want.card).filter(|(known, _)| known == want).map(|(_, numbers)| Arc::clone(numbers))
    }

    fn lock(&self) -> MutexGuard<'_, ByCard> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Edits what is wanted until the mailbox closes.
pub(super) fn run(office: &Office) {
    while let Some(wanted) = office.changes.take() {
        let _busy = office.activity.begin();
        // What is only measured waits until t rests: pictures come first.
        let is_moved = wanted.iter().any(|want| is_edit(&want.edits));
        let is_measured = office.is_measured.load(Ordering::Relaxed);
        let is_due = is_moved || is_measured && office.changes.stays_quiet(QUIET);
        if !is_due {
            continue;
        }
        for want in wanted {
            let is_found = office.found.exact(&want).is_some();
            if is_found {
                continue;
            }
            let Some(editor) = office.editor().filter(|editor| editor.knows(&want.code)) else { continue };
            let amounts = || Axis::ALL.into_iter().zip(want.edits.map(f64::from));
            let edited = guarded("Editing", || editor.edit(&want.code, amounts()).map_err(|error| error.to_string()));
            let numbers = match edited.and_then(|edited| edited) {
                Ok(Edited { code, before, after, shortfalls }) => {
                    office.say(Answer::Measured(want.card, Some(Measured { before, after, shortfalls })));
                    code
                }
                Err(why) => {
                    office.say(Answer::Measured(want.card, None));
                    office.say(Answer::Notice(why));
                    want.code.code.clone()
                }
            };
            let is_edit = is_edit(&want.edits);
            office.found.lock().insert(want.card, (want, numbers.into()));
            if is_edit {
                office.ring();
            }
            if office.changes.has_news() {
                break;
            }
        }
    }
}

impl Want {
    /// The edited numbers, and whether they are those of just this want. From another place of the same edits the
    /// change is taken over.
    pub fn known(&self, found: &Found) -> (Arc<[f32]>, bool) {
        match found.lock().get(&self.card) {
            Some((known, numbers)) if known == self => (Arc::clone(numbers), true),
            Some((known, numbers)) if known.edits == self.edits && known.code.code.len() == self.code.code.len() => {
                let change = numbers.iter().zip(&known.code.code).map(|(to, from)| to - from);
                (self.code.code.iter().zip(change).map(|(own, change)| own + change).collect(), false)
            }
            _ => (self.code.code.as_slice().into(), false),
        }
    }
}

impl Studio {
    /// Edits the point of a card, where its path walks through codes that can be; the code that it shows then. What is
    /// shown is added to `wanted`: it may have to be edited, or measured by and by.
    pub fn edit(
        &mut self,
        card: Card,
        path: &dyn Path,
        weights: &Weights,
        walk: &Walk,
        wanted: &mut Vec<Want>,
    ) -> Result<Option<Arc<[f32]>>, String> {
        let is_edit = walk.is_edit();
        if !is_edit {
            // Pictures do not need it.
            let code = path.code(weights).ok().flatten();
            wanted.extend(code.map(|code| Want { card, code, edits: walk.edits }));
            return Ok(None);
        }
        let code = path.code(weights).map_err(|error| error.to_string())?;
        let Some(editor) = self.office.editor() else { return Ok(None) };
        let Some(code) = code.filter(|code| editor.knows(code)) else { return Ok(None) };
        let want = Want { card, code, edits: walk.edits };
        let (numbers, is_exact) = want.known(&self.office.found);
        let point = decoded(editor, &numbers);
        wanted.push(want);
        // Where the estimate is no material, the true edit is waited for.
        match point {
            Ok(point) => {
                self.put(card, point);
                Ok(Some(numbers))
            }
            Err(_) if !is_exact => Ok(None),
            Err(why) => Err(why),
        }
    }
}

fn decoded(editor: &Editor, numbers: &[f32]) -> Result<Box<dyn nbrdf_core::Brdf>, String> {
    let model = editor.model();
    model.decode(&model.code(numbers.to_vec())).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn want(numbers: [f32; 2], gloss: f32) -> Want {
        let edits = [0.0, 0.0, 0.0, gloss, 0.0, 0.0, 0.0];
        Want { card: Card::Method("latent"), code: Code::new("m", "c", numbers.to_vec()), edits }
    }

    #[test]
    fn while_t_moves_the_last_change_is_taken_over() {
        let found = Found::default();
        let first = want([1.0, 2.0], 0.1);
        assert_eq!(first.known(&found), (Arc::from([1.0, 2.0]), false), "nothing is known yet");
        found.lock().insert(first.card, (first.clone(), Arc::from([1.5, 2.0])));
        assert_eq!(first.known(&found), (Arc::from([1.5, 2.0]), true));
        assert_eq!(want([3.0, 4.0], 0.1).known(&found), (Arc::from([3.5, 4.0]), false));
        assert_eq!(want([3.0, 4.0], 0.2).known(&found), (Arc::from([3.0, 4.0]), false), "another edit");
    }
}
