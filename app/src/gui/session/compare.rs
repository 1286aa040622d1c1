//! How spheres are compared: all side by side, or two of them in one large picture.

use serde::{Deserialize, Serialize};

use super::{Session, letter, shown};
use crate::catalog::Catalog;
use crate::worker::{Card, Closeup, Scale};

/// How spheres are compared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Compare {
    /// In which way.
    pub mode: Mode,
    /// Which two are in the large picture.
    pub pair: Pair,
    /// Where the first ends and the second begins: 0 at the left rim, 1 at the right.
    pub divider: f32,
    /// Whether they flicker by themselves.
    pub is_alternating: bool,
    /// Where the colours of their difference end.
    pub scale: Scale,
}

/// The ways to compare.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// All spheres, each on a card.
    #[default]
    SideBySide,
    /// One picture: one sphere left of a divider, another right of it.
    Swipe,
    /// A heat map of how two spheres differ.
    Difference,
    /// Two spheres by turns in one place.
    Flicker,
}

impl Mode {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::SideBySide, Self::Swipe, Self::Difference, Self::Flicker];

    /// Its name.
    pub const fn title(self) -> &'static str {
        match self {
            Self::SideBySide => "Side by side",
            Self::Swipe => "Swipe",
            Self::Difference => "Difference",
            Self::Flicker => "Flicker",
        }
    }

    /// What it shows.
    pub const fn about(self) -> &'static str {
        match self {
            Self::SideBySide => "All spheres, each on a card",
            Self::Swipe => "One large picture: one sphere left of the divider, another right of it",
            Self::Difference => "Where two spheres differ, in ΔE_ITP",
            Self::Flicker => "Two spheres by turns in the same place",
        }
    }
}

/// Two cards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "[Written; 2]", into = "[Written; 2]")]
pub struct Pair(pub [Card; 2]);

/// A card in a file: methods by their names in the catalog.
#[derive(Serialize, Deserialize)]
enum Written {
    End(usize),
    Method(String),
    Explored,
}

impl From<[Written; 2]> for Pair {
    /// A method that is no more becomes the first end.
    fn from(written: [Written; 2]) -> Self {
        Self(written.map(|card| match card {
            Written::End(end) => Card::End(end),
            Written::Explored => Card::Explored,
            Written::Method(name) => {
                Catalog::interpolation_entry(&name).map_or(Card::End(0), |entry| Card::Method(entry.name))
            }
        }))
    }
}

impl From<Pair> for [Written; 2] {
    fn from(Pair(cards): Pair) -> Self {
        cards.map(|card| match card {
            Card::End(end) => Written::End(end),
            Card::Explored => Written::Explored,
            Card::Method(name) => Written::Method(name.to_owned()),
        })
    }
}

impl Default for Compare {
    fn default() -> Self {
        Self {
            mode: Mode::SideBySide,
            pair: Pair([Card::Method("latent"), Card::Method("raw_weights")]),
            divider: 0.5,
            is_alternating: false,
            scale: Scale::Whole,
        }
    }
}

impl Compare {
    /// Moves the divider by a share of the picture's width.
    pub fn move_by(&mut self, share: f32) {
        self.move_to(self.divider + share);
    }

    /// Moves the divider.
    pub fn move_to(&mut self, divider: f32) {
        self.divider = divider.clamp(0.0, 1.0);
    }
}

impl Session {
    /// The two in the large picture: as chosen, or others where these are not shown.
    pub fn compared(&self) -> [Card; 2] {
        let (cards, Pair([first, second])) = (self.cards(), self.compare.pair);
        // In place of one that is not shown, the first that is not the other one, if there is any.
        let or_other = |own: Card, other: Card| {
            let found = cards.iter().find(|card| **card == own).or_else(|| cards.iter().find(|card| **card != other));
            found.or(cards.first()).copied().unwrap_or(Card::End(0))
        };
        let first = or_other(first, second);
        [first, or_other(second, first)]
    }

    /// What the worker is asked for in place of all cards.
    pub fn closeup(&self) -> Option<Closeup> {
        let scale = (self.compare.mode == Mode::Difference).then_some(self.compare.scale);
        (self.compare.mode != Mode::SideBySide).then(|| Closeup { cards: self.compared(), scale })
    }

    /// A card's name for people.
    pub fn title(&self, card: Card) -> String {
        match card {
            Card::End(end) => {
                let name = self.blend.ends.get(end).map_or("", String::as_str);
                format!("{} {}", letter(end), shown(name))
            }
            Card::Method(name) => Catalog::interpolation_entry(name).map_or(name, |entry| entry.title).to_owned(),
            Card::Explored => "Explored".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::session::Methods;

    #[test]
    fn a_pair_comes_back_from_its_file_and_a_method_that_is_no_more_is_the_first_end() {
        let pair = Pair([Card::Method("latent"), Card::End(1)]);
        let text = serde_json::to_string(&pair).unwrap();
        assert_eq!(serde_json::from_str::<Pair>(&text).unwrap(), pair);
        let old: Pair = serde_json::from_str(&text.replace("latent", "telepathy")).unwrap();
        assert_eq!(old, Pair([Card::End(0), Card::End(1)]));
    }

    #[test]
    fn cards_that_are_not_shown_are_not_compared() {
        let mut session = Session::default();
        assert_eq!(session.compared(), session.compare.pair.0);
        session.methods = Methods(vec!["raw_weights"]);
        assert_eq!(session.compared(), [Card::End(0), Card::Method("raw_weights")]);
        session.methods = Methods(Vec::new());
        assert_eq!(session.compared(), [Card::End(0), Card::End(1)]);
        session.compare.pair = Pair([Card::Method("latent"), Card::End(0)]);
        assert_eq!(session.compared(), [Card::End(1), Card::End(0)], "none with itself");
    }
}
