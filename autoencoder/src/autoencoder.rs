//! A trained autoencoder as a representation: materials in, 32 numbers, materials out.

use std::path::Path;
use std::sync::{Arc, OnceLock};

use candle_core::{Device, Tensor};
use nbrdf_core::nbrdf::PUBLISHED_WEIGHTS;
use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::representation::pca_weights::network_of;
use nbrdf_core::representation::{DecodeError, EncodeError};
use nbrdf_core::{Brdf, Code, Directions, Material, Nbrdf, Representation};
use serde::{Deserialize, Serialize};

use crate::checkpoint::{Checkpoint, CheckpointError, invalid};
use crate::model::{DIM, FEATURES, Model, PublishedModel, ZnbrdfModel};
use crate::probe::{features, probe, probe_directions};

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
    model: Box<dyn Model + Send + Sync>,
    probes: Vec<Directions>,
    hash: String,
}

impl Autoencoder {
    /// Reads a checkpoint file of either architecture.
    pub fn load(path: &Path) -> Result<Self, CheckpointError> {
        Self::restore(&Checkpoint::load(path)?)
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
        let found = file.metadata.get("model").map_or("no model's name", String::as_str);
        let Some(architecture) = Architecture::ALL.into_iter().find(|architecture| architecture.name() == found) else {
            return Err(invalid(&file.path, "a checkpoint of znbrdf or published_autoencoder".into(), found.into()));
        };
        let rng = &mut generator(0, 0);
        let shape = [PUBLISHED_WEIGHTS];
        let model: Box<dyn Model + Send + Sync> = match architecture {
            Architecture::Znbrdf => {
                file.check_probes()?;
                Box::new(ZnbrdfModel::new(file.tensor("start", &shape)?, file.tensor("spread", &shape)?, rng)?)
            }
            Architecture::Published => {
                Box::new(PublishedModel::new(file.tensor("mean", &shape)?, file.tensor("spread", &shape)?, rng)?)
            }
        };
        file.restore(model.as_ref())?;
        Ok(Self { hash: file.hash.clone(), ..Self::untrained(architecture, model) })
    }

    pub(crate) fn untrained(architecture: Architecture, model: Box<dyn Model + Send + Sync>) -> Self {
        Self { architecture, model, probes: probe_directions(), hash: "untrained".into() }
    }

    pub(crate) fn model(&self) -> &dyn Model {
        self.model.as_ref()
    }

    /// Which autoencoder this is.
    pub const fn architecture(&self) -> Architecture {
        self.architecture
    }

    /// Trainable numbers.
    pub fn parameters(&self) -> usize {
        self.model.parameters().count()
    }

    /// The network that a code stands for.
    pub fn decode_network(&self, code: &Code) -> Result<Nbrdf, DecodeError> {
        let numbers = code.checked(self.name(), &self.hash, DIM)?;
        let failed = |error: candle_core::Error| DecodeError::Failed(error.to_string());
        let code = Tensor::from_slice(numbers, (1, DIM), &Device::Cpu).map_err(failed)?;
        let weights = self.model.decode(&code).and_then(|w| w.flatten_all()?.to_vec1()).map_err(failed)?;
        Nbrdf::published(weights).map_err(|error| DecodeError::Failed(error.to_string()))
    }

    fn input(&self, target: &Material) -> Result<Tensor, EncodeError> {
        let (numbers, shape): (Vec<f32>, Vec<usize>) = match self.architecture {
            Architecture::Znbrdf => {
                let values = probe(&self.probes, target.brdf.as_ref());
                if values.iter().any(|value| !value.is_finite()) {
                    return Err(EncodeError::NotFinite { material: target.name.clone() });
                }
                (features(&self.probes, &values), vec![1, 3, FEATURES])
            }
            Architecture::Published => {
                (network_of(self.name(), target)?.weights().to_vec(), vec![1, PUBLISHED_WEIGHTS])
            }
        };
        Tensor::from_vec(numbers, shape, &Device::Cpu).map_err(tensor_failed)
    }
}

fn tensor_failed(error: candle_core::Error) -> EncodeError {
    DecodeError::Failed(error.to_string()).into()
}

impl Representation for Autoencoder {
    fn name(&self) -> &'static str {
        self.architecture.name()
    }

    fn dim(&self) -> usize {
        DIM
    }

    fn checkpoint(&self) -> &str {
        &self.hash
    }

    fn encode(&self, target: &Material) -> Result<Code, EncodeError> {
        let code = self.model.encode(&self.input(target)?).and_then(|code| code.flatten_all()?.to_vec1());
        Ok(self.code(code.map_err(tensor_failed)?))
    }

    fn decode(&self, code: &Code) -> Result<Box<dyn Brdf>, DecodeError> {
        Ok(Box::new(self.decode_network(code)?))
    }

    fn network(&self, code: &Code) -> Result<Option<Nbrdf>, DecodeError> {
        self.decode_network(code).map(Some)
    }
}

#[cfg(test)]
mod tests {
    use nbrdf_core::library::builtin;
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
