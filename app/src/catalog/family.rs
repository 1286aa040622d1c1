//! Kinds of representations, as charts tell them apart.

use serde::{Deserialize, Serialize};

/// What a representation keeps of a material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Family {
    /// The parameters of a formula.
    Formula,
    /// One-dimensional factors of a microfacet lobe.
    Factored,
    /// The code of an autoencoder, decoded to a network.
    Code,
    /// A network of its own.
    Network,
    /// Weights of a linear basis of tables.
    Linear,
    /// Coordinates on a manifold of tables.
    Chart,
    /// A table.
    Table,
}

impl Family {
    /// All, in the order of legends.
    pub const ALL: [Self; 7] =
        [Self::Formula, Self::Factored, Self::Code, Self::Network, Self::Linear, Self::Chart, Self::Table];

    /// Name for people.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Formula => "formula",
            Self::Factored => "factored lobe",
            Self::Code => "code",
            Self::Network => "network",
            Self::Linear => "linear basis",
            Self::Chart => "chart",
            Self::Table => "table",
        }
    }
}
