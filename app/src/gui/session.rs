//! What the user chose; every change is a plain function, so that tests need no window.

mod blend;
mod listing;
mod look;
mod methods;

use egui::ThemePreference;
use serde::{Deserialize, Serialize};

pub use blend::{BEYOND, Blend, MOST_ENDS, TICKS, Towards, Way, corners, letter};
pub use listing::Listing;
pub use look::{LAMP, Look, MAX_EXPOSURE};
pub use methods::Methods;

use crate::worker::Card;

/// Everything the user can change.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Session {
    /// Materials, and where between them.
    pub blend: Blend,
    /// How they are looked at.
    pub look: Look,
    /// Interpolations shown.
    pub methods: Methods,
    /// Whether whole paths are shown.
    pub strips: bool,
    /// Dark, light, or as the system.
    pub theme: ThemePreference,
    /// Which materials are listed.
    pub listing: Listing,
}

impl Default for Session {
    fn default() -> Self {
        Self {
            blend: Blend::default(),
            look: Look::default(),
            methods: Methods::default(),
            strips: true,
            theme: ThemePreference::System,
            listing: Listing::default(),
        }
    }
}

impl Session {
    /// Exposure, light and place as at the start; materials and methods stay.
    pub fn reset(&mut self) {
        let Blend { t, place, playing, .. } = Blend::default();
        (self.blend.t, self.blend.place, self.blend.playing) = (t, place, playing);
        self.look = Look::default();
    }

    /// The spheres from left to right.
    pub fn cards(&self) -> Vec<Card> {
        let methods = self.methods.0.iter().map(|&method| Card::Method(method));
        let others = (1..self.blend.ends.len()).map(Card::End);
        std::iter::once(Card::End(0)).chain(methods).chain(others).collect()
    }
}
