//! What can be written to files.

use serde::{Deserialize, Serialize};

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
