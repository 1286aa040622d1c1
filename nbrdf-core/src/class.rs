//! What kind of matter a material is, told by the words of its name.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A kind of matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Class {
    /// Bare metals and alloys.
    Metal,
    /// Plastics, phenolics, foams, and the vinyl films that cars are wrapped in.
    Plastic,
    /// Paints of all sorts, car paints of several layers too.
    Paint,
    /// Fabrics, felts and satins.
    Fabric,
    /// Wood, stained or not.
    Wood,
    /// Stones, minerals and ceramics.
    Mineral,
    /// Rubbers and latex.
    Rubber,
    /// Paper.
    Paper,
    /// Anything else.
    Other,
}

/// Words of names and what they say, the first line that knows a word decides: of `blue-metallic-paint` it is `paint`, of
/// `acrylic_felt_green` it is `felt`.
#[rustfmt::skip]
const WORDS: [(Class, &[&str]); 8] = [
    (Class::Paint, &["paint", "lacquer", "varnish", "layer", "ilm"]),
    (Class::Fabric, &["fabric", "felt", "satin", "cloth", "cotton", "silk", "velvet", "wool", "leather"]),
    (Class::Paper, &["paper", "cardboard"]),
    (Class::Rubber, &["rubber", "latex"]),
    (Class::Plastic, &[
        "plastic", "phenolic", "acrylic", "delrin", "nylon", "polyethylene", "polyurethane", "foam", "pvc", "teflon",
        "spectralon", "bball", "vinyl",
        // Series of wrapping films in the RGL database.
        "cc", "cg", "chm", "cm", "vch", "aurora",
    ]),
    (Class::Wood, &[
        "cherry", "maple", "fruitwood", "pine", "natural", "oak", "walnut", "wood", "birch", "mahogany",
    ]),
    (Class::Mineral, &[
        "alumina", "aventurnine", "obsidian", "hematite", "jasper", "marble", "silicon", "stone", "granite", "glass",
        "ceramic", "porcelain", "slate",
    ]),
    (Class::Metal, &[
        "bronze", "aluminium", "aluminum", "brass", "chrome", "steel", "nickel", "ss440", "tungsten", "gold", "silver",
        "copper", "iron", "tin", "titanium", "zinc", "metal",
    ]),
];

impl Class {
    /// All of them, in the order of lists.
    pub const ALL: [Self; 9] = [
        Self::Metal,
        Self::Plastic,
        Self::Paint,
        Self::Fabric,
        Self::Wood,
        Self::Mineral,
        Self::Rubber,
        Self::Paper,
        Self::Other,
    ];

    /// The class of a material's name (`gold-paint`, `rgl/paper_white`).
    ///
    /// ```
    /// use nbrdf_core::class::Class;
    /// assert_eq!(Class::of("blue-metallic-paint2"), Class::Paint);
    /// assert_eq!(Class::of("rgl/acrylic_felt_green"), Class::Fabric);
    /// ```
    pub fn of(name: &str) -> Self {
        let name = name.to_lowercase();
        let words = || name.split(|c: char| !c.is_alphanumeric());
        // `fabric2` is fabric; `ss440` is a word of its own.
        let knows = |known: &[&str], word: &str| {
            known.contains(&word) || known.contains(&word.trim_end_matches(|c: char| c.is_ascii_digit()))
        };
        let found = WORDS.iter().find(|(_, known)| words().any(|word| knows(known, word)));
        found.map_or(Self::Other, |(class, _)| *class)
    }

    /// Its name for people.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Metal => "Metal",
            Self::Plastic => "Plastic",
            Self::Paint => "Paint",
            Self::Fabric => "Fabric",
            Self::Wood => "Wood",
            Self::Mineral => "Mineral",
            Self::Rubber => "Rubber",
            Self::Paper => "Paper",
            Self::Other => "Other",
        }
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.title())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::database::{MERL, RGL};

    #[test]
    fn every_standard_material_has_a_class_but_one_series_of_which_nothing_is_known() {
        let other = MERL.iter().chain(&RGL).filter(|name| Class::of(name) == Class::Other);
        let known = |name: &&&str| !name.starts_with("rgl/colodur_");
        assert_eq!(other.filter(known).collect::<Vec<_>>(), Vec::<&&str>::new());
    }

    #[test]
    fn every_class_has_a_standard_material() {
        for class in Class::ALL {
            assert!(MERL.iter().chain(&RGL).any(|name| Class::of(name) == class), "{class}");
        }
    }

    #[test]
    fn what_a_thing_is_counts_more_than_what_it_looks_like() {
        let classes = [
            ("gold-paint", Class::Paint),
            ("two-layer-silver", Class::Paint),
            ("rgl/satin_gold", Class::Fabric),
            ("dark-specular-fabric", Class::Fabric),
            ("specular-black-phenolic", Class::Plastic),
            ("neoprene-rubber", Class::Rubber),
            ("natural-209", Class::Wood),
            ("ss440", Class::Metal),
            ("black-oxidized-steel", Class::Metal),
            ("silicon-nitrade", Class::Mineral),
            ("rgl/chm_orange", Class::Plastic),
            ("my-sample", Class::Other),
        ];
        for (name, class) in classes {
            assert_eq!(Class::of(name), class, "{name}");
        }
    }
}
