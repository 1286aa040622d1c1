//! Planned scenes: the asking end, and what comes back.
//!
//! A thread of its own, since a plan takes seconds: it keeps the models of the scene that is open, so that another
//! tolerance costs little, and looks for newer letters between any two models.

mod example;
mod order;
mod planning;
mod sight;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use nbrdf_core::plan::{By, Totals};
use serde::{Deserialize, Serialize};

use super::Mailbox;
pub use example::EXAMPLES;
use order::Order;
pub(super) use planning::run;
pub use sight::{Run, Sight, Still};

/// Where a scene comes from.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Source {
    /// One of [`EXAMPLES`].
    Example(String),
    /// A file.
    File(PathBuf),
}

/// What is wanted of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Wish {
    /// Which scene.
    pub source: Source,
    /// Counts how often it was opened: its file may have changed.
    pub reading: u32,
    /// Mean FLIP that an object's pixels may have; that of the scene where it is left out.
    pub tolerance: Option<f64>,
    /// What is to be least.
    pub by: By,
}

/// What a pane asks for in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ask {
    /// Nothing new.
    #[default]
    Nothing,
    /// A plan, unless it is there or on its way.
    Plan,
    /// The last plan, after a stop.
    Again,
    /// To stop.
    Stop,
}

/// What the thread has to say.
#[derive(Debug)]
pub enum News {
    /// A scene's file was among those to open.
    Named(PathBuf),
    /// A scene is being read; the one before is gone.
    Reading,
    /// It was read: the tolerance it asks for itself.
    Read(Option<f64>),
    /// What is being done.
    Doing(String),
    /// What the materials themselves look like, and who is where.
    Seen(Box<Sight>),
    /// A plan.
    Planned(Box<Planned>),
    /// There is none, for this reason.
    Failed(String),
    /// The user has stopped it.
    Stopped,
    /// Everything up to the letter of this number is answered.
    Done(u64),
}

/// A plan, ready to be shown.
#[derive(Debug)]
pub struct Planned {
    /// The picture of the models.
    pub picture: Still,
    /// How it differs from that of the materials themselves: FLIP, black at 0, white at [`white`](Self::white).
    pub difference: Still,
    /// Mean FLIP that is white.
    pub white: f64,
    /// In the order of the scene's objects.
    pub rows: Vec<Row>,
    /// Mean FLIP that was allowed.
    pub tolerance: f64,
    /// What was to be least.
    pub by: By,
    /// What the scene costs.
    pub totals: Totals,
    /// What it costs with an NBRDF of every material.
    pub beside: Option<Totals>,
    /// How many times less time and fewer bytes that is.
    pub saved: Option<[f64; 2]>,
    /// Seconds that the plan took.
    pub seconds: f64,
    /// Whether it is of a small, grainy picture, and a better one follows.
    pub is_draft: bool,
}

/// What an object got.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its name.
    pub object: String,
    /// Its material's name.
    pub material: String,
    /// Whether the material comes from a file of its own.
    pub is_file: bool,
    /// The kind of model.
    pub model: String,
    /// Mean FLIP on its pixels, everything planned.
    pub error: f64,
    /// Nanoseconds per evaluation, one thread.
    pub ns: f64,
    /// Bytes of the material.
    pub bytes: usize,
    /// Why, for people.
    pub reason: String,
}

/// Whether a file is a scene, by its extension.
pub fn is_scene(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

/// The asking end.
#[derive(Default)]
pub(super) struct Scenes {
    pub letters: Arc<Mailbox<Order>>,
    last: Option<Wish>,
    number: u64,
}

impl Scenes {
    /// Asks, if that is news; the number of the letter comes back in [`News::Done`].
    pub fn ask(&mut self, ask: Ask, wish: Option<Wish>) -> Option<u64> {
        let wish = match ask {
            Ask::Nothing => return None,
            Ask::Plan if wish.is_none() || wish == self.last => return None,
            Ask::Plan => {
                self.last.clone_from(&wish);
                wish
            }
            Ask::Again => self.last.clone(),
            Ask::Stop => None,
        };
        self.number += 1;
        self.letters.put(Order { number: self.number, wish });
        Some(self.number)
    }
}

impl Drop for Scenes {
    fn drop(&mut self) {
        self.letters.close();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_wish_is_asked_for_once_and_again_after_a_stop() {
        let wish = Wish { source: Source::Example("shelf".to_owned()), reading: 0, tolerance: None, by: By::Time };
        let mut scenes = Scenes::default();
        assert_eq!(scenes.ask(Ask::Plan, None), None);
        assert_eq!(scenes.ask(Ask::Plan, Some(wish.clone())), Some(1));
        assert_eq!(scenes.ask(Ask::Plan, Some(wish.clone())), None);
        assert_eq!(scenes.ask(Ask::Stop, Some(wish.clone())), Some(2));
        assert!(scenes.letters.take().is_some_and(|order| order.wish.is_none()));
        assert_eq!(scenes.ask(Ask::Plan, Some(wish.clone())), None, "stopped is stopped");
        assert_eq!(scenes.ask(Ask::Again, Some(wish.clone())), Some(3));
        assert_eq!(scenes.letters.take().and_then(|order| order.wish), Some(wish));
    }
}
