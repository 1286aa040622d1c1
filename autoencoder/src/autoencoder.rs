//! A trained autoencoder as a representation: materials in, a few numbers (32 in the built-in ones), materials out.

use std::cell::Cell;
use std::path::Path;
use std::sync::{Arc, OnceLock};

use nbrdf_core::axis::Prior;
use nbrdf_core::nbrdf::{PUBLISHED_HIDDEN, PUBLISHED_WEIGHTS};
use nbrdf_core::representation::pca_weights::network_of;
use nbrdf_core::representation::{DecodeError, EncodeError, Linearized, check_numbers};
use nbrdf_core::sampler::lobe::Lobe;
use nbrdf_core::{Brdf, Code, Material, Nbrdf, Representation};
use serde::{Deserialize, Serialize};

use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::inference::{self, Inference};
use crate::known::Known;
use crate::lobe::LobeNetwork;
use crate::probe::Probes;

/// Which autoencoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Architecture {
    /// Ours: probe encoder, colour channels treated alike.
    Znbrdf,
    /// 675 → 675 → 32 → 100 → 675, as published.
    Published,
}

impl Architecture {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Znbrdf, Self::Published];

    /// Name in the catalog, in codes and in checkpoints.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Znbrdf => "znbrdf",
            Self::Published => "published_autoencoder",
        }
    }
}

/// An autoencoder and its checkpoint's hash.
pub struct Autoencoder {
    architecture: Architecture,
    inference: Box<dyn Inference>,
    lobe: Option<LobeNetwork>,
    known: Option<Known>,
    probes: Probes,
    parameters: usize,
    hash: String,
}

thread_local! {
    /// Each thread's decoded weights.
    static WEIGHTS: Cell<Vec<f32>> = const { Cell::new(Vec::new()) };
}

impl Autoencoder {
    /// Reads a checkpoint file of either architecture.
    pub fn load(path: &Path) -> Result<Self, CheckpointError> {
        Self::restore(&Checkpoint::load(path)?)
    }

    /// As [`load`](Self::load), from the bytes of a file.
    pub fn parse(path: &str, bytes: &[u8]) -> Result<Self, CheckpointError> {
        Self::restore(&Checkpoint::parse(path, bytes)?)
    }

    /// The built-in checkpoint.
    ///
    /// # Panics
    /// If the bytes compiled in are no checkpoint: a mistake of the build, caught by a test.
    pub fn built_in(architecture: Architecture) -> Arc<Self> {
        static MODELS: [OnceLock<Arc<Autoencoder>>; 2] = [const { OnceLock::new() }; 2];
        let bytes: &[u8] = match architecture {
            Architecture::Znbrdf => include_bytes!("../assets/znbrdf.safetensors"),
            Architecture::Published => include_bytes!("../assets/published_autoencoder.safetensors"),
        };
        let model = MODELS[architecture as usize].get_or_init(|| {
            let checkpoint = Checkpoint::parse(architecture.name(), bytes);
            let restored = checkpoint.and_then(|checkpoint| Self::restore(&checkpoint));
            Arc::new(restored.unwrap_or_else(|error| panic!("built-in checkpoint: {error}")))
        });
        Arc::clone(model)
    }

    fn restore(file: &Checkpoint) -> Result<Self, CheckpointError> {
        let found = file.file.metadata("model").unwrap_or("no model's name");
        let Some(architecture) = Architecture::ALL.into_iter().find(|architecture| architecture.name() == found) else {
            return Err(file.lacks("a checkpoint of znbrdf or published_autoencoder, or a basis", found));
        };
        let mut restored = Self::of(architecture, file)?;
        if architecture == Architecture::Znbrdf {
            file.check_probes()?;
            restored.lobe = Some(LobeNetwork::new(file, restored.dim())?);
            restored.known = Some(Known::new(file)?);
        }
        Ok(restored)
    }

    /// From the tensors of a file, or of a training under way.
    pub(crate) fn of(architecture: Architecture, file: &Checkpoint) -> Result<Self, CheckpointError> {
        Ok(Self {
            architecture,
            inference: inference::build(architecture, file)?,
            lobe: None,
            known: None,
            probes: Probes::new(),
            parameters: file.parameters(),
            hash: file.hash.clone(),
        })
    }

    /// Which autoencoder this is.
    pub const fn architecture(&self) -> Architecture {
        self.architecture
    }

    /// Trainable numbers.
    pub const fn parameters(&self) -> usize {
        self.parameters
    }

    /// The network that a code stands for.
    pub fn decode_network(&self, code: &Code) -> Result<Nbrdf, DecodeError> {
        let numbers = code.checked(self.name(), &self.hash, self.dim())?;
        let mut weights = vec![0.0; PUBLISHED_WEIGHTS];
        self.inference.decode(numbers, &mut weights);
        Nbrdf::published(weights).map_err(|error| DecodeError::Failed(error.to_string()))
    }

    /// The lobe to sample what a code stands for; none in an architecture that has not learned lobes.
    pub fn lobe(&self, code: &Code) -> Result<Option<Lobe>, DecodeError> {
        let numbers = code.checked(self.name(), &self.hash, self.dim())?;
        Ok(self.lobe.as_ref().map(|network| network.predict(numbers)))
    }

    /// Distance of a code to that of the nearest training material, whatever its colours; 1 is how far training
    /// materials are from each other (median of nearest neighbours). None in an architecture that remembers none,
    /// or of a code that is another model's.
    pub fn distance(&self, code: &Code) -> Result<Option<f64>, DecodeError> {
        if (code.model.as_str(), code.checkpoint.as_str()) != (self.name(), self.hash.as_str()) {
            return Ok(None);
        }
        let numbers = self.checked(&code.code)?;
        Ok(self.known.as_ref().map(|known| known.distance(numbers)))
    }

    /// How the codes of training materials are spread; none in an architecture that remembers none.
    pub fn prior(&self) -> Option<Prior> {
        self.known.as_ref().map(Known::prior)
    }

    fn checked<'a>(&self, numbers: &'a [f32]) -> Result<&'a [f32], DecodeError> {
        check_numbers(self.name(), numbers, self.dim())
    }
}

impl Representation for Autoencoder {
    fn name(&self) -> &'static str {
        self.architecture.name()
    }

    fn dim(&self) -> usize {
        self.inference.dim()
    }

    fn checkpoint(&self) -> &str {
        &self.hash
    }

    fn shared_bytes(&self) -> usize {
        self.inference.decoder_bytes()
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let mut code = vec![0.0; self.dim()];
        match self.architecture {
            Architecture::Znbrdf => {
                let values = self.probes.probe(target.brdf.as_ref());
                if values.iter().any(|value| !value.is_finite()) {
                    return Err(EncodeError::NotFinite { material: target.name.clone() });
                }
                self.inference.encode(&self.probes.features(&values), &mut code);
            }
            Architecture::Published => {
                self.inference.encode(network_of(self.name(), target)?.weights(), &mut code);
            }
        }
        Ok(self.code(code))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        Ok(Box::new(self.decode_network(code)?))
    }

    fn network(&self, code: &Code) -> Result<Option<Nbrdf>, DecodeError> {
        self.decode_network(code).map(Some)
    }

    fn decode_into(&self, numbers: &[f32], place: &mut Box<dyn Brdf>) -> Result<(), DecodeError> {
        let numbers = self.checked(numbers)?;
        let mut weights = WEIGHTS.take();
        weights.resize(PUBLISHED_WEIGHTS, 0.0);
        self.inference.decode(numbers, &mut weights);
        let done =
            Nbrdf::put(PUBLISHED_HIDDEN, &weights, place).map_err(|error| DecodeError::Failed(error.to_string()));
        WEIGHTS.set(weights);
        done
    }

    fn linearize(&self, numbers: &[f32]) -> Result<Option<Linearized>, DecodeError> {
        let numbers = self.checked(numbers)?;
        let (mut weights, mut by_number) = (vec![0.0; PUBLISHED_WEIGHTS], vec![0.0; self.dim() * PUBLISHED_WEIGHTS]);
        self.inference.linearize(numbers, &mut weights, &mut by_number);
        Ok(Some(Linearized { hidden: PUBLISHED_HIDDEN, weights, by_number }))
    }
}

#[cfg(test)]
mod tests {
    use nbrdf_core::library::builtin;
    use nbrdf_core::nbrdf::fit::generator;
    use nbrdf_core::nbrdf::symmetry::{permute, rescale};
    use rand::RngExt;
    use rand::seq::SliceRandom;

    use super::*;

    #[test]
    fn codes_do_not_depend_on_the_order_and_scale_of_hidden_units() {
        let model = Autoencoder::built_in(Architecture::Znbrdf);
        let rng = &mut generator(6, 0);
        let library = builtin::shared();
        let mut worst = 0.0f32;
        for round in 0..1000 {
            let entry = library.iter().nth(round % library.len()).unwrap();
            let mut order: [Vec<usize>; 2] = std::array::from_fn(|_| (0..21).collect());
            order.iter_mut().for_each(|order| order.shuffle(rng));
            let mut factors = || -> Vec<f32> { (0..21).map(|_| rng.random_range(-1.5..1.5f32).exp()).collect() };
            let factors = [factors(), factors()];
            let disguised = permute(&entry.network, [&order[0], &order[1]]);
            let disguised = rescale(&disguised, [&factors[0], &factors[1]]);
            let code = |network: &Nbrdf| model.encode(&Material::from_network("m", network.clone())).unwrap().code;
            let (own, other) = (code(&entry.network), code(&disguised));
            let norm = |v: &mut dyn Iterator<Item = f32>| v.map(|v| v * v).sum::<f32>().sqrt();
            let moved = norm(&mut own.iter().zip(&other).map(|(a, b)| a - b)) / norm(&mut own.iter().copied());
            worst = worst.max(moved);
        }
        println!("largest relative move of a code: {worst:.1e}");
        assert!(worst < 1e-4, "{worst:e}");
    }

    #[test]
    fn permuting_colours_permutes_the_code() {
        let model = Autoencoder::built_in(Architecture::Znbrdf);
        let network = &builtin::shared().get("blue-fabric").unwrap().network;
        let mut turned = network.weights().to_vec();
        for channels in turned[609..].as_chunks_mut::<3>().0 {
            channels.rotate_left(1);
        }
        let code = |weights: Vec<f32>| {
            let network = Nbrdf::published(weights).unwrap();
            model.encode(&Material::from_network("m", network)).unwrap().code
        };
        let (own, other) = (code(network.weights().to_vec()), code(turned));
        let close = |a: &[f32], b: &[f32]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-4 * (1.0 + a.abs()));
        assert!(close(&own[..20], &other[..20]));
        let mut channels = own[20..].to_vec();
        channels.rotate_left(4);
        assert!(close(&channels, &other[20..]), "{own:?} {other:?}");
    }

    #[test]
    fn both_built_in_checkpoints_load() {
        for architecture in Architecture::ALL {
            assert_eq!(Autoencoder::built_in(architecture).architecture(), architecture);
        }
    }
}
