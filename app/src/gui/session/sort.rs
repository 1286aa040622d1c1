//! What the library is sorted by.

use serde::{Deserialize, Serialize};

/// What materials are sorted by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sort {
    /// Database, then name.
    #[default]
    Database,
    /// Name.
    Name,
    /// L* of the albedo seen from the front.
    Lightness,
    /// Strength of the highlight.
    Gloss,
    /// Width of the highlight.
    Roughness,
    /// Expected error of the ZNBRDF code.
    Error,
}

impl Sort {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Database, Self::Name, Self::Lightness, Self::Gloss, Self::Roughness, Self::Error];

    /// Its name.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Database => "Database",
            Self::Name => "Name",
            Self::Lightness => "Lightness",
            Self::Gloss => "Gloss",
            Self::Roughness => "Roughness",
            Self::Error => "Error",
        }
    }

    /// What it means.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Database => "As in the libraries: MERL, RGL, then files",
            Self::Name => "From A to Z",
            Self::Lightness => "L* of the albedo seen from the front, 0 to 100",
            Self::Gloss => "Cube root of the share of light in the highlight: 0 for none, 1 for all of it",
            Self::Roughness => "Square root of the highlight's RMS half angle, in √rad: 0 for a mirror, 1.07 at most",
            Self::Error => {
                "Expected log_error of the material's ZNBRDF code: mean |Δ ln| over directions; lower is closer"
            }
        }
    }

    /// A value as it is shown in the list.
    pub fn shown(self, value: f64) -> String {
        match self {
            Self::Database | Self::Name => String::new(),
            Self::Lightness => format!("L* {value:.0}"),
            Self::Gloss => format!("gloss {value:.2}"),
            Self::Roughness => format!("rough {value:.2} √rad"),
            Self::Error => format!("error {value:.4}"),
        }
    }
}
