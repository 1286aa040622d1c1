//! Straight paths between the weights of networks: as they come, aligned unit by unit, or from a shared start.

use super::{Interpolation, Path, PathError, Weights, at_least_two, with_weighted_sum};
use crate::nbrdf::symmetry::{align, balance};
use crate::representation::pca_weights::network_of;
use crate::{Brdf, Material, Nbrdf};

/// Where the networks of the ends come from.
pub type NetworkSource = Box<dyn Fn(&Material) -> Option<Nbrdf> + Send + Sync>;

/// Mixes weights; `aligned` first matches the hidden units of all ends with those of the first.
pub struct WeightInterpolation {
    name: &'static str,
    aligned: bool,
    source: NetworkSource,
}

impl WeightInterpolation {
    /// Weights as they come. `source` may put another network in a material's place (an independently started one,
    /// one from a shared start); where it gives none, the material's own network is used.
    pub fn new(name: &'static str, source: NetworkSource) -> Self {
        Self { name, aligned: false, source }
    }

    /// The same, hidden units matched first.
    pub fn aligned(name: &'static str, source: NetworkSource) -> Self {
        Self { name, aligned: true, source }
    }
}

struct WeightPath {
    hidden: [usize; 2],
    weights: Vec<Vec<f32>>,
}

impl Interpolation for WeightInterpolation {
    fn name(&self) -> &'static str {
        self.name
    }

    fn between(&self, ends: &[Material]) -> Result<Box<dyn Path>, PathError> {
        at_least_two(ends)?;
        let network = |end| match (self.source)(end) {
            Some(network) => Ok(network),
            None => network_of(self.name, end).cloned(),
        };
        let mut networks = ends.iter().map(network).collect::<Result<Vec<_>, _>>()?;
        if self.aligned {
            // Balanced like the others: the same material twice must be the same weights twice.
            networks[0] = balance(&networks[0]);
            let (first, others) = networks.split_at_mut(1);
            others.iter_mut().for_each(|other| *other = align(other, &first[0]));
        }
        let hidden = networks[0].hidden();
        Ok(Box::new(WeightPath { hidden, weights: networks.into_iter().map(Nbrdf::into_weights).collect() }))
    }
}

impl Path for WeightPath {
    fn at(&self, weights: &Weights) -> Result<Box<dyn Brdf>, PathError> {
        with_weighted_sum(weights, &self.weights, |mixed| Ok(Box::new(Nbrdf::new(self.hidden, mixed.to_vec())?) as _))
    }

    fn move_to(&self, weights: &Weights, point: &mut Box<dyn Brdf>) -> Result<(), PathError> {
        with_weighted_sum(weights, &self.weights, |mixed| Ok(Nbrdf::put(self.hidden, mixed, point)?))
    }
}
