//! What the worker is to write, from what is chosen.

use std::path::Path;

use super::{Export, SIZES, STEPS, What, name_of};
use crate::gui::{Session, reproduce};
use crate::worker::Card;
use crate::worker::export::{Goods, Job};

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
