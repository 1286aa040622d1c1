//! Materials as methods give them back; errors become text, which is what reports keep.

use std::sync::Arc;

use autoencoder::Autoencoder;
use nbrdf_core::{Brdf, Code, Material, Representation, Warning};

use crate::measure::guard;

/// A code, and what it decodes to.
pub(super) struct Returned {
    code: Code,
    pub brdf: Arc<dyn Brdf>,
}

impl Returned {
    /// Encoded and decoded, or why not.
    pub fn by(representation: &dyn Representation, material: &Material) -> Result<Self, String> {
        let code = representation.encode(material).map_err(|error| error.to_string())?;
        let brdf = representation.decode(&code).map_err(|error| error.to_string())?;
        Ok(Self { code, brdf: Arc::from(brdf) })
    }

    /// What is said of it, and of the material it came from.
    pub fn warnings(&self, material: &Material, known: &Autoencoder) -> Result<Vec<Warning>, String> {
        guard::of_encoded(material, &self.code, self.brdf.as_ref(), known).map_err(|error| error.to_string())
    }
}
