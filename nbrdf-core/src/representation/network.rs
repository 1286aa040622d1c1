//! A network of its own for every material: the code is its flattened weights.
//!
//! A. Sztrajman et al., *Neural BRDF Representation and Importance Sampling* (2021), section 3: 6-21-21-3, 675 numbers.
//! Differs: other hidden widths, fewer bits, and no units that can never fire, as further points between size, time and
//! error.

use super::{Code, DecodeError, EncodeError, Representation};
use crate::nbrdf::fit::{FitOptions, fit, random_hidden};
use crate::nbrdf::precision::Precision;
use crate::nbrdf::weight_count;
use crate::{Brdf, Material, Nbrdf};

/// Steps of a fit from random weights.
const STEPS: usize = 8000;
/// Steps from a wider network of the same material, which lead closer.
const NEAR_STEPS: usize = 4000;

/// Networks of the same widths, stored in the same number of bits.
pub struct Network {
    name: &'static str,
    hidden: [usize; 2],
    precision: Precision,
    is_pruned: bool,
}

impl Network {
    /// Under this name; hidden widths 1 to [`MAX_HIDDEN`](crate::nbrdf::MAX_HIDDEN).
    pub const fn new(name: &'static str, hidden: [usize; 2], precision: Precision) -> Self {
        Self { name, hidden, precision, is_pruned: false }
    }

    /// Units that can never fire are left out of what is kept and evaluated. Codes stay whole: which units these are is
    /// proved when a code is decoded, which takes some milliseconds.
    #[must_use]
    pub const fn pruned(self) -> Self {
        Self { is_pruned: true, ..self }
    }

    fn stored(&self, code: &Code) -> Result<Nbrdf, DecodeError> {
        let weights = code.checked(self.name, self.checkpoint(), self.dim())?;
        let network = Nbrdf::new(self.hidden, weights.to_vec());
        let network = network.map_err(|error| DecodeError::Failed(error.to_string()))?;
        let network = self.precision.round(&network);
        Ok(if self.is_pruned { network.pruned() } else { network })
    }
}

impl Representation for Network {
    fn name(&self) -> &'static str {
        self.name
    }

    fn dim(&self) -> usize {
        weight_count(self.hidden)
    }

    /// Nothing is learned beforehand.
    fn checkpoint(&self) -> &str {
        "none"
    }

    fn shared_bytes(&self) -> usize {
        0
    }

    fn code_bytes(&self) -> usize {
        self.precision.bytes(self.hidden)
    }

    fn precision(&self) -> Precision {
        self.precision
    }

    /// Those of the units that are left; what is no code is kept whole.
    fn bytes_of(&self, code: &Code) -> usize {
        match self.stored(code) {
            Ok(network) if self.is_pruned => self.precision.bytes(network.compact().hidden()),
            _ => self.code_bytes(),
        }
    }

    /// The material's own network where its widths are right; else one fitted to it, from its own network with fewer units
    /// or, where it has none that is wide enough, from a seeded random start.
    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let own = target.network.as_ref().filter(|network| network.hidden() == self.hidden);
        let fitted = || {
            let near = target.network.as_ref().and_then(|network| network.shrunk(self.hidden));
            let (start, steps) =
                near.map_or_else(|| (random_hidden(0, 0, self.hidden), STEPS), |near| (near, NEAR_STEPS));
            fit(&start, target.brdf.as_ref(), FitOptions { steps, ..FitOptions::default() }, &|| false)
        };
        let network = own.cloned().or_else(fitted);
        let network = network.ok_or_else(|| EncodeError::NotFinite { material: target.name.clone() })?;
        Ok(self.code(self.precision.round(&network).into_weights()))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        Ok(Box::new(self.stored(code)?))
    }

    fn network(&self, code: &Code) -> Result<Option<Nbrdf>, DecodeError> {
        self.stored(code).map(Some)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::library::builtin;
    use crate::nbrdf::PUBLISHED_HIDDEN;
    use crate::sampling::{evaluate, rus32k};

    #[test]
    fn a_pruned_network_has_the_same_bits_and_fewer_bytes() {
        let whole = Network::new("whole", PUBLISHED_HIDDEN, Precision::Single);
        let pruned = Network::new("pruned", PUBLISHED_HIDDEN, Precision::Single).pruned();
        let material = builtin::shared().get("chrome").unwrap().material();
        let [own, code] = [&whole, &pruned].map(|network| network.encode(&material).unwrap());
        assert_eq!(own.code, code.code);
        let [own_values, values] =
            [whole.decode(&own), pruned.decode(&code)].map(|decoded| evaluate(decoded.unwrap().as_ref(), rus32k()));
        assert_eq!(own_values, values);
        assert_eq!((whole.bytes_of(&own), pruned.code_bytes()), (2700, 2700));
        let bytes = pruned.bytes_of(&code);
        assert_eq!(bytes, 4 * material.network.unwrap().compact().weights().len());
        assert!(bytes < 2700, "{bytes}");
        assert_eq!(pruned.bytes_of(&own), 2700, "a code of another representation");
    }
}
