//! The same material as another network: from the built-in sets, or fitted on the spot.

use nbrdf_core::library::{Entry, Library, builtin};
use nbrdf_core::metric::{LogError, Metric};
use nbrdf_core::nbrdf::fit::{FitOptions, fit};
use nbrdf_core::nbrdf::precision::Precision;
use nbrdf_core::representation::{DecodeError, EncodeError, Linearized};
use nbrdf_core::{Brdf, Code, Material, Nbrdf, Representation};

/// A twin may be this many times as far away as its own fit is from what it was fitted to.
const SAME: f64 = 1.25;

/// The material of the same name in a library, if it is the same material and not only the same name: the network
/// itself, or the one it was fitted to, recognised by the error that the library's manifest states.
fn twin<'a>(library: &'a Library, material: &Material) -> Option<&'a Entry> {
    let entry = library.get(&material.name).ok()?;
    if material.network.as_ref() == Some(&entry.network) {
        return Some(entry);
    }
    let fitted = entry.error.get(LogError.name())?;
    (LogError.distance(material.brdf.as_ref(), &entry.network) <= SAME * fitted).then_some(entry)
}

/// For a built-in material, its independently started network: that is how networks occur in the wild. Others keep theirs.
pub fn independent_network(material: &Material) -> Option<Nbrdf> {
    let shared = builtin::shared().get(&material.name).ok()?;
    if material.network.as_ref() != Some(&shared.network) {
        return None;
    }
    let independent = builtin::independent().get(&material.name).ok()?;
    Some(independent.network.clone())
}

/// The material as a network fitted from the shared start: the built-in one, or a fit of a second or so.
pub fn shared_start_network(material: &Material) -> Option<Nbrdf> {
    if let Some(entry) = twin(builtin::shared(), material) {
        return Some(entry.network.clone());
    }
    let start = builtin::shared().shared_start()?;
    fit(start, material.brdf.as_ref(), FitOptions::shared_start(0), &|| false)
}

/// A representation of weights that is handed the kind of network it was learned from, whatever the material comes with.
pub struct WithNetwork<R> {
    /// The representation.
    pub inner: R,
    /// Where its networks come from; where it gives none, the material's own is used.
    pub source: fn(&Material) -> Option<Nbrdf>,
}

impl<R: Representation> Representation for WithNetwork<R> {
    fn name(&self) -> &'static str {
        self.inner.name()
    }

    fn dim(&self) -> usize {
        self.inner.dim()
    }

    fn checkpoint(&self) -> &str {
        self.inner.checkpoint()
    }

    fn code_bytes(&self) -> usize {
        self.inner.code_bytes()
    }

    fn precision(&self) -> Precision {
        self.inner.precision()
    }

    fn bytes_of(&self, code: &Code) -> usize {
        self.inner.bytes_of(code)
    }

    fn shared_bytes(&self) -> usize {
        self.inner.shared_bytes()
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let network = (self.source)(target).or_else(|| target.network.clone());
        self.inner.encode(&Material { network, ..target.clone() })
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        self.inner.decode(code)
    }

    fn network(&self, code: &Code) -> Result<Option<Nbrdf>, DecodeError> {
        self.inner.network(code)
    }

    fn decode_into(&self, numbers: &[f32], place: &mut Box<dyn Brdf>) -> Result<(), DecodeError> {
        self.inner.decode_into(numbers, place)
    }

    fn linearize(&self, numbers: &[f32]) -> Result<Option<Linearized>, DecodeError> {
        self.inner.linearize(numbers)
    }
}
