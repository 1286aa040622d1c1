//! What is written to files, and where to.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{Session, letter};
use crate::catalog::{EXPORTERS, ExporterEntry};
use crate::gui::reproduce;
use crate::worker::export::{Goods, Job, PictureForm};
use crate::worker::{Card, Request};

/// Pixels per side of a sphere, at least and at most.
pub const SIZES: [u16; 2] = [16, 1024];
/// Points of a walk, at least and at most.
pub const STEPS: [u16; 2] = [2, 64];

/// What is written, and where to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Export {
    /// What of it.
    pub what: What,
    /// Whose: the letter of an end, or the catalog name of a method.
    pub card: String,
    /// Form of materials, by the name of the exporter.
    pub form: String,
    /// Form of pictures.
    pub picture: PictureForm,
    /// Pixels per side of a sphere.
    pub size: u16,
    /// Points of a walk, ends included.
    pub steps: u16,
    /// The folder; empty for the user's own.
    pub folder: String,
    /// What all files' names begin with; empty for the names of the materials.
    pub name: String,
}

/// What is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum What {
    /// The material that a card shows.
    Material,
    /// A sphere of it.
    #[default]
    Picture,
    /// Spheres all along the path, one row for each method.
    Strip,
    /// Figures all along the path.
    Curve,
    /// Materials all along the path of one method.
    Steps,
}

impl What {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Material, Self::Picture, Self::Strip, Self::Curve, Self::Steps];

    /// Its name, and one line on it.
    pub const fn about(self) -> [&'static str; 2] {
        match self {
            Self::Material => ["Material", "the material that a card shows now"],
            Self::Picture => ["Picture", "what a card shows now: in its shape, frame and light"],
            Self::Strip => ["Film strip", "pictures all along the path, one row for each method"],
            Self::Curve => ["Curve of figures", "figures all along the path, as a table"],
            Self::Steps => ["Materials along the path", "materials all along the path of one method"],
        }
    }

    /// Whether a card is to be chosen for it.
    pub const fn is_of_a_card(self) -> bool {
        matches!(self, Self::Material | Self::Picture | Self::Steps)
    }
}

impl Default for Export {
    fn default() -> Self {
        Self {
            what: What::default(),
            card: String::new(),
            form: EXPORTERS[0].name.to_owned(),
            picture: PictureForm::default(),
            size: 512,
            steps: 9,
            folder: String::new(),
            name: String::new(),
        }
    }
}

/// How a card is called in [`Export::card`].
pub fn name_of(card: Card) -> String {
    match card {
        Card::End(end) => letter(end).to_string(),
        Card::Method(method) => method.to_owned(),
        Card::Explored => "explored".to_owned(),
    }
}

impl Export {
    /// The form of materials; the first where a file of another version knows more.
    pub fn exporter(&self) -> &'static ExporterEntry {
        ExporterEntry::named(&self.form).unwrap_or(&EXPORTERS[0])
    }

    /// The folder, absolute.
    pub fn folder(&self) -> PathBuf {
        let home = || std::env::home_dir().unwrap_or_default();
        match self.folder.trim() {
            "" => home(),
            own => own.strip_prefix("~/").map_or_else(|| PathBuf::from(own), |rest| home().join(rest)),
        }
    }
}

impl Session {
    /// The cards that may be chosen for what is to be written.
    pub fn export_cards(&self) -> Vec<Card> {
        let is_method = |card: &Card| matches!(card, Card::Method(_));
        self.cards().into_iter().filter(|card| self.export.what != What::Steps || is_method(card)).collect()
    }

    /// The card that is chosen: the first method where it is not there any more.
    pub fn export_card(&self) -> Option<Card> {
        let cards = self.export_cards();
        let chosen = cards.iter().find(|card| name_of(**card) == self.export.card);
        chosen.or_else(|| cards.iter().find(|card| matches!(card, Card::Method(_)))).or(cards.first()).copied()
    }

    /// What the files' names begin with.
    pub fn export_name(&self) -> String {
        let given = self.export.name.trim();
        if !given.is_empty() {
            return given.to_owned();
        }
        let plain = |letter: char| if letter.is_ascii_alphanumeric() || "-_".contains(letter) { letter } else { '-' };
        let ends = &self.blend.ends;
        let joined = match self.export_card() {
            Some(Card::End(end)) if self.export.what.is_of_a_card() => ends[end].clone(),
            _ => ends.join("-"),
        };
        joined.chars().map(plain).take(96).collect()
    }

    /// What is to be written.
    ///
    /// # Errors
    /// What is missing, or wrong with the name.
    pub fn goods(&self) -> Result<Goods, String> {
        let name = self.export_name();
        if Path::new(&name).file_name().is_none_or(|whole| whole != name.as_str()) || name.contains(['/', '\\']) {
            return Err("The name is to be one of a file, without folders.".to_owned());
        }
        let Export { what, picture, size, steps, .. } = self.export;
        let [size, steps] = [(size, SIZES), (steps, STEPS)].map(|(value, [least, most])| value.clamp(least, most));
        let form = self.export.exporter();
        let card = self.export_card();
        let no_method = || "Show a method first: it makes the path.".to_owned();
        match (what, card) {
            (What::Material, Some(card)) => Ok(Goods::Material { card, form }),
            (What::Picture, Some(card)) => Ok(Goods::Picture { card, form: picture, size }),
            (What::Steps, Some(Card::Method(method))) => Ok(Goods::Steps { method, form, steps }),
            (What::Strip, _) if !self.methods.0.is_empty() => Ok(Goods::Strip { form: picture, size, steps }),
            (What::Curve, _) if !self.methods.0.is_empty() => Ok(Goods::Curve { steps }),
            _ => Err(no_method()),
        }
    }

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

    /// The files to be written.
    ///
    /// # Errors
    /// As [`goods`](Self::goods).
    pub fn job(&self, is_replacing: bool) -> Result<Job, String> {
        let goods = self.goods()?;
        Ok(Job {
            shown: self.shown(),
            t: (!self.blend.is_polygon()).then_some(self.blend.t),
            folder: self.export.folder(),
            name: self.export_name(),
            is_replacing,
            chosen: serde_json::json!({"blend": self.blend, "look": self.look}),
            command: reproduce::export(self, &goods),
            goods,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::session::Methods;

    #[test]
    fn names_are_those_of_the_materials_unless_given_and_never_lead_elsewhere() {
        let mut session = Session::default();
        session.blend.choose(0, "rgl/paper_white");
        assert_eq!(session.export_name(), "rgl-paper_white-blue-acrylic");
        session.export.card = "A".to_owned();
        assert_eq!(session.export_name(), "rgl-paper_white");
        for name in ["../a", "a/b", "..", "a\\b"] {
            session.export.name = name.to_owned();
            assert!(session.goods().is_err(), "{name}");
        }
    }

    #[test]
    fn a_card_that_is_gone_is_replaced_and_steps_are_of_methods() {
        let mut session = Session::default();
        session.export.card = "F".to_owned();
        assert_eq!(session.export_card(), Some(Card::Method("latent")));
        session.methods = Methods(Vec::new());
        assert_eq!(session.export_card(), Some(Card::End(0)));
        session.export.what = What::Steps;
        assert!(session.goods().is_err());
    }
}
