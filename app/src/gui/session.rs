//! What the user chose; every change is a plain function, so that tests need no window.

mod blend;
mod compare;
mod export;
mod figures;
mod files;
mod kept;
mod listing;
mod look;
mod map;
mod mend;
mod methods;
mod pasted;
mod pick;
mod play;
mod polygon;
mod scene;
mod shown;
mod slots;
mod sort;
mod tour;
mod weigh;

use std::path::PathBuf;

use egui::ThemePreference;
use serde::{Deserialize, Serialize};

pub use crate::worker::export::PictureForm;
pub use blend::{BEYOND, Blend, TICKS, Way, letter};
pub use compare::{Compare, Mode, Pair};
pub use export::{Export, SIZES, STEPS, What, name_of as export_name_of};
pub use figures::{Channel, Figure, FigureChoice, Quantity, Radius};
pub use kept::KeptBlend;
pub use listing::{Listing, shown};
pub use look::{LAMP, Look, MAX_EXPOSURE};
pub use map::{MapView, Tint};
pub use methods::Methods;
pub use pasted::Pasted;
pub use pick::Pick;
pub use play::Towards;
pub use polygon::corners;
pub use scene::{Scene, Shown, TOLERANCES};
pub use slots::MOST_ENDS;
pub use sort::Sort;

use crate::worker::{Card, Explored, Origins};

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
    /// How spheres are compared.
    pub compare: Compare,
    /// Which place of the spheres is looked at closely.
    pub pick: Pick,
    /// Which figure is shown, and of what.
    pub figures: FigureChoice,
    /// How the latent map is looked at.
    pub map: MapView,
    /// A place of the latent map that has a sphere of its own.
    pub explored: Option<Explored>,
    /// Which scene is planned, and how.
    pub scene: Scene,
    /// Blends kept under names.
    pub blends: Vec<KeptBlend>,
    /// What is written to files, and where to.
    pub export: Export,
    /// Files that are open, in the order they were opened; the next start opens them again.
    pub files: Vec<PathBuf>,
    /// Which of them the materials come from, by name, so that the next start finds them under the same names.
    pub origins: Origins,
    /// Codes that were pasted; the next start lists them again.
    pub pasted: Pasted,
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
            compare: Compare::default(),
            pick: Pick::default(),
            figures: FigureChoice::default(),
            map: MapView::default(),
            explored: None,
            scene: Scene::default(),
            blends: Vec::new(),
            export: Export::default(),
            files: Vec::new(),
            origins: Origins::new(),
            pasted: Pasted::default(),
        }
    }
}

impl Session {
    /// Exposure, light, zoom and place as at the start; materials, methods, shape and tone curve stay.
    pub fn reset(&mut self) {
        let Blend { t, place, playing, .. } = Blend::default();
        (self.blend.t, self.blend.place, self.blend.playing) = (t, place, playing);
        self.look.reset();
    }

    /// The spheres from left to right.
    pub fn cards(&self) -> Vec<Card> {
        let methods = self.methods.0.iter().map(|&method| Card::Method(method));
        let others = (1..self.blend.ends.len()).map(Card::End);
        let explored = self.explored.map(|_| Card::Explored);
        std::iter::once(Card::End(0)).chain(methods).chain(others).chain(explored).collect()
    }
}
