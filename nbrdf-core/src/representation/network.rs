//! A network of its own for every material: the code is its flattened weights.
//!
//! A. Sztrajman et al., *Neural BRDF Representation and Importance Sampling* (2021), section 3: 6-21-21-3, 675 numbers.
//! Differs: other hidden widths and fewer bits, as further points between size and error.

use super::{Code, DecodeError, EncodeError, Representation};
use crate::nbrdf::fit::{FitOptions, fit, random_hidden};
use crate::nbrdf::precision::Precision;
use crate::nbrdf::weight_count;
use crate::{Brdf, Material, Nbrdf};

/// Steps of a fit where a material brings no network of these widths.
const STEPS: usize = 8000;

/// Networks of the same widths, stored in the same number of bits.
pub struct Network {
    name: &'static str,
    hidden: [usize; 2],
    precision: Precision,
}

impl Network {
    /// Under this name; hidden widths 1 to [`MAX_HIDDEN`](crate::nbrdf::MAX_HIDDEN).
    pub const fn new(name: &'static str, hidden: [usize; 2], precision: Precision) -> Self {
        Self { name, hidden, precision }
    }

    fn stored(&self, code: &Code) -> Result<Nbrdf, DecodeError> {
        let weights = code.checked(self.name, self.checkpoint(), self.dim())?;
        let network = Nbrdf::new(self.hidden, weights.to_vec());
        network.map(|network| self.precision.round(&network)).map_err(|error| DecodeError::Failed(error.to_string()))
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

    /// The material's own network where its widths are right, else one fitted to it from a seeded random start.
    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let own = target.network.as_ref().filter(|network| network.hidden() == self.hidden);
        let fitted = || {
            let options = FitOptions { steps: STEPS, ..FitOptions::default() };
            fit(&random_hidden(0, 0, self.hidden), target.brdf.as_ref(), options, &|| false)
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
