//! What can be written.

use serde::{Deserialize, Serialize};

use crate::catalog::ExporterEntry;
use crate::worker::Card;

/// Form of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum PictureForm {
    /// As it is displayed, 8 bits per channel.
    #[default]
    Png,
    /// Linear values, 32-bit floats.
    Exr,
}

impl PictureForm {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Png, Self::Exr];

    /// Extension of its files, without the dot.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }
}

/// What is written.
#[derive(Clone, Copy)]
pub enum Goods {
    /// What a card shows.
    Material {
        /// The card.
        card: Card,
        /// The form of the file.
        form: &'static ExporterEntry,
    },
    /// Materials along a path, from end to end.
    Steps {
        /// Catalog name of the method.
        method: &'static str,
        /// The form of the files.
        form: &'static ExporterEntry,
        /// Points, ends included.
        steps: u16,
    },
    /// A picture, as the window shows it.
    Picture {
        /// Of which card.
        card: Card,
        /// The form of the file.
        form: PictureForm,
        /// Pixels per side.
        size: u16,
    },
    /// Pictures of the whole shape along the path, one row per method.
    Strip {
        /// The form of the file.
        form: PictureForm,
        /// Pixels per side of a picture of it.
        size: u16,
        /// Points, ends included.
        steps: u16,
    },
    /// Figures along the path of every method.
    Curve {
        /// Points, ends included.
        steps: u16,
    },
}

impl Goods {
    /// Its name in manifests.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Material { .. } => "material",
            Self::Steps { .. } => "materials_along_the_path",
            Self::Picture { .. } => "picture",
            Self::Strip { .. } => "strip",
            Self::Curve { .. } => "curve",
        }
    }

    /// Name of the form of its files.
    pub const fn form(&self) -> &'static str {
        match self {
            Self::Material { form, .. } | Self::Steps { form, .. } => form.name,
            Self::Picture { form, .. } | Self::Strip { form, .. } => form.extension(),
            Self::Curve { .. } => "csv",
        }
    }

    /// Points of the path, where it is about all of it.
    pub const fn steps(&self) -> Option<u16> {
        match self {
            Self::Steps { steps, .. } | Self::Strip { steps, .. } | Self::Curve { steps } => Some(*steps),
            Self::Material { .. } | Self::Picture { .. } => None,
        }
    }

    /// Pixels per side of a picture, where there are some.
    pub const fn size(&self) -> Option<u16> {
        match self {
            Self::Picture { size, .. } | Self::Strip { size, .. } => Some(*size),
            Self::Material { .. } | Self::Steps { .. } | Self::Curve { .. } => None,
        }
    }
}
