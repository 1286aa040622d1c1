//! Blends kept under names.

use serde::{Deserialize, Serialize};

use super::{Blend, Methods, Session};

/// A blend under a name, and how it was shown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct KeptBlend {
    /// Name for people; no two have the same.
    pub name: String,
    /// Materials, place, timing and edits.
    pub blend: Blend,
    /// Interpolations shown.
    pub methods: Methods,
}

impl Session {
    /// Keeps the present blend under a name, in place of an earlier one of that name; a blank name keeps nothing.
    pub fn keep_blend(&mut self, name: &str) {
        let name = name.trim();
        if name.is_empty() {
            return;
        }
        let blend = Blend { playing: None, ..self.blend.clone() };
        let kept = KeptBlend { name: name.to_owned(), blend, methods: self.methods.clone() };
        match self.blends.iter_mut().find(|known| known.name == name) {
            Some(known) => *known = kept,
            None => self.blends.push(kept),
        }
    }

    /// Shows a kept blend again.
    pub fn load_blend(&mut self, place: usize) {
        if let Some(kept) = self.blends.get(place) {
            (self.blend, self.methods) = (kept.blend.clone(), kept.methods.clone());
        }
    }

    /// Gives a kept blend another name, unless that is blank or taken.
    pub fn rename_blend(&mut self, place: usize, name: &str) {
        let name = name.trim();
        let is_free = !name.is_empty() && self.blends.iter().all(|known| known.name != name);
        if let Some(kept) = self.blends.get_mut(place).filter(|_| is_free) {
            name.clone_into(&mut kept.name);
        }
    }

    /// Forgets a kept blend.
    pub fn forget_blend(&mut self, place: usize) {
        if place < self.blends.len() {
            self.blends.remove(place);
        }
    }

    /// A name that no kept blend has: the first and the last material.
    pub fn free_name(&self) -> String {
        let ends = &self.blend.ends;
        let plain =
            format!("{} to {}", ends.first().map_or("", String::as_str), ends.last().map_or("", String::as_str));
        let is_free = |name: &String| self.blends.iter().all(|known| known.name != *name);
        let numbered = (2..).map(|number: u32| format!("{plain} {number}"));
        std::iter::once(plain.clone()).chain(numbered).find(is_free).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kept_blend_comes_back_with_its_methods_and_place() {
        let mut session = Session::default();
        session.blend.choose(2, "chrome");
        session.blend.go_to(0.75);
        session.blend.edits[3] = 0.2;
        session.methods = Methods(vec!["linear_mix"]);
        session.keep_blend(" shiny ");
        let (blend, methods) = (session.blend.clone(), session.methods.clone());
        session.blend = Blend::default();
        session.methods = Methods::default();
        session.load_blend(0);
        assert_eq!((&session.blend, &session.methods), (&blend, &methods));
        let text = serde_json::to_string(&session).unwrap();
        assert_eq!(serde_json::from_str::<Session>(&text).unwrap(), session);
    }

    #[test]
    fn names_are_taken_once_and_are_not_blank() {
        let mut session = Session::default();
        session.keep_blend("  ");
        assert!(session.blends.is_empty());
        assert_eq!(session.free_name(), "gold-paint to blue-acrylic");
        session.keep_blend(&session.free_name());
        assert_eq!(session.free_name(), "gold-paint to blue-acrylic 2");
        session.keep_blend("other");
        session.keep_blend("other");
        session.rename_blend(1, "gold-paint to blue-acrylic");
        session.rename_blend(0, "gold");
        let names: Vec<&str> = session.blends.iter().map(|kept| kept.name.as_str()).collect();
        assert_eq!(names, ["gold", "other"]);
        session.forget_blend(0);
        session.forget_blend(9);
        assert_eq!(session.blends.len(), 1);
    }
}
