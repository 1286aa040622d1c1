//! What the window shows, as the worker is asked for it.

use std::sync::Arc;

use super::Session;
use crate::worker::Request;

impl Session {
    /// What the window shows, for work that needs no picture of it.
    pub fn shown(&self) -> Request {
        self.shown_between(self.blend.ends.as_slice().into())
    }

    /// The same, with the list of the ends that is there already.
    pub fn shown_between(&self, ends: Arc<[String]>) -> Request {
        Request {
            ends,
            weights: self.blend.weights(),
            timing: self.blend.timing,
            walk: self.blend.walk(),
            explored: self.explored,
            methods: self.methods.0.clone(),
            scenery: self.look.scenery,
            exposure: self.look.exposure,
            tone: self.look.tone,
            size: 0,
            strip: 0,
            closeup: None,
        }
    }
}
