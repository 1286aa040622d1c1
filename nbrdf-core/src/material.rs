//! What the tools pass around.

use std::sync::Arc;

use crate::{Brdf, Nbrdf};

/// A name, a reflectance, and the network when there is one.
#[derive(Clone)]
pub struct Material {
    /// Name as published (`chrome`, `rgl/paper_white`).
    pub name: String,
    /// The reflectance.
    pub brdf: Arc<dyn Brdf>,
    /// The network behind the reflectance, where it is one.
    pub network: Option<Nbrdf>,
}

impl Material {
    /// A material without a network: a formula, a table, a mix.
    pub fn new(name: impl Into<String>, brdf: Arc<dyn Brdf>) -> Self {
        Self { name: name.into(), brdf, network: None }
    }

    /// A material that is a network.
    pub fn from_network(name: impl Into<String>, network: Nbrdf) -> Self {
        Self { name: name.into(), brdf: Arc::new(network.clone()), network: Some(network) }
    }
}
