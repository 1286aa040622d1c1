//! Undo and redo: what the session was before, step by step.
//!
//! Each step changes one of three: the kept blends, the favourites, or all else. To keep, rename or forget a blend and to
//! make a favourite are steps of their own, also in the middle of a drag or while a path plays; so undoing another step
//! never takes a kept blend or a favourite along.

use super::Session;

/// Steps kept.
const KEPT: usize = 200;

/// The past and the undone future of a session.
pub struct History {
    past: Vec<Session>,
    present: Session,
    future: Vec<Session>,
}

impl History {
    /// Nothing has happened yet.
    pub fn new(session: &Session) -> Self {
        Self { past: Vec::new(), present: still(session), future: Vec::new() }
    }

    /// Takes note of a change, once it is complete: a drag, a playing path or a word being typed is one step.
    pub fn watch(&mut self, session: &Session, is_complete: bool) {
        if session.blends != self.present.blends {
            let blends = session.blends.clone();
            self.step(Session { blends, ..self.present.clone() });
        }
        if session.listing.favourites != self.present.listing.favourites {
            let mut next = self.present.clone();
            next.listing.favourites.clone_from(&session.listing.favourites);
            self.step(next);
        }
        if is_complete && session.blend.playing.is_none() && !is_same(session, &self.present) {
            self.step(still(session));
        }
    }

    fn step(&mut self, next: Session) {
        if self.past.len() >= KEPT {
            self.past.remove(0);
        }
        self.past.push(std::mem::replace(&mut self.present, next));
        self.future.clear();
    }

    /// Whether there is something to undo, and to redo.
    pub fn ways(&self) -> [bool; 2] {
        [!self.past.is_empty(), !self.future.is_empty()]
    }

    /// One step back.
    pub fn undo(&mut self, session: &mut Session) {
        // What is going on is a step of its own.
        self.watch(&still(session), true);
        if let Some(before) = self.past.pop() {
            self.future.push(std::mem::replace(&mut self.present, before));
            self.restore(session);
        }
    }

    /// One step on again.
    pub fn redo(&mut self, session: &mut Session) {
        if let Some(after) = self.future.pop() {
            self.past.push(std::mem::replace(&mut self.present, after));
            self.restore(session);
        }
    }

    /// All but what is looked for in the list, with which tool, and where the map was moved: nobody wants a word they typed
    /// to go away with a slider. And but the files and the codes that are open, and where files are written to.
    fn restore(&self, session: &mut Session) {
        let before = std::mem::replace(session, self.present.clone());
        session.listing.search = before.listing.search;
        (session.files, session.origins) = (before.files, before.origins);
        (session.pasted, session.export) = (before.pasted, before.export);
        session.pick.is_picking = before.pick.is_picking;
        if session.map.projection == before.map.projection {
            (session.map.centre, session.map.zoom) = (before.map.centre, before.map.zoom);
        }
    }
}

fn still(session: &Session) -> Session {
    let mut session = session.clone();
    session.blend.playing = None;
    session.listing.search.clear();
    session.pick.is_picking = false;
    session.map.reset();
    session.files.clear();
    session.origins.clear();
    session.pasted = Default::default();
    session.export = Default::default();
    session
}

fn is_same(session: &Session, present: &Session) -> bool {
    // Cheap first: this is asked in every frame.
    session.blend == present.blend && still(session) == *present
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_is_one_step_and_comes_back() {
        let mut session = Session::default();
        let mut history = History::new(&session);
        for t in [0.6, 0.7, 0.8] {
            session.blend.go_to(t);
            history.watch(&session, false);
        }
        history.watch(&session, true);
        session.look.exposure = 1.0;
        history.watch(&session, true);
        session.listing.search = "blue".to_owned();
        history.undo(&mut session);
        assert_eq!((session.blend.t, session.look.exposure), (0.8, 0.0));
        history.undo(&mut session);
        assert_eq!((session.blend.t, session.listing.search.as_str()), (0.5, "blue"));
        assert_eq!(history.ways(), [false, true]);
        history.redo(&mut session);
        history.redo(&mut session);
        assert_eq!((session.blend.t, session.look.exposure), (0.8, 1.0));
    }

    #[test]
    fn something_new_ends_what_could_be_redone() {
        let mut session = Session::default();
        let mut history = History::new(&session);
        session.blend.go_to(0.1);
        history.undo(&mut session);
        assert_eq!(session.blend.t, 0.5, "a change that is still going on is undone, too");
        session.blend.go_to(0.9);
        history.watch(&session, true);
        assert_eq!(history.ways(), [true, false]);
    }

    fn names(session: &Session) -> Vec<&str> {
        session.blends.iter().map(|kept| kept.name.as_str()).collect()
    }

    #[test]
    fn a_blend_that_is_kept_while_a_path_is_dragged_stays_when_the_drag_is_undone() {
        let mut session = Session::default();
        let mut history = History::new(&session);
        session.blend.go_to(0.7);
        history.watch(&session, false);
        session.keep_blend("gold");
        session.listing.toggle_favourite("chrome");
        history.watch(&session, false);
        session.blend.go_to(0.9);
        history.watch(&session, true);
        history.undo(&mut session);
        assert_eq!((session.blend.t, names(&session)), (0.5, vec!["gold"]));
        assert!(session.listing.favourites.contains("chrome"));
        history.undo(&mut session);
        assert!(session.listing.favourites.is_empty());
        assert_eq!(names(&session), ["gold"]);
        history.undo(&mut session);
        assert_eq!((session.blend.t, names(&session)), (0.5, vec![]));
        (0..3).for_each(|_| history.redo(&mut session));
        assert_eq!((session.blend.t, names(&session)), (0.9, vec!["gold"]));
        assert!(session.listing.favourites.contains("chrome"));
    }

    #[test]
    fn keeping_renaming_and_forgetting_a_blend_are_one_step_each_while_a_path_plays() {
        let mut session = Session::default();
        let mut history = History::new(&session);
        session.blend.toggle_play();
        let changes: [fn(&mut Session); 3] = [
            |session| session.keep_blend("gold"),
            |session| session.rename_blend(0, "silver"),
            |session| session.forget_blend(0),
        ];
        for change in changes {
            session.blend.advance(0.1);
            change(&mut session);
            history.watch(&session, true);
        }
        history.undo(&mut session);
        assert_eq!((session.blend.t, session.blend.playing), (0.5, None), "what is going on is undone first");
        for after in [vec!["silver"], vec!["gold"], vec![]] {
            history.undo(&mut session);
            assert_eq!((session.blend.t, names(&session)), (0.5, after));
        }
        assert_eq!(history.ways(), [false, true]);
    }
}
