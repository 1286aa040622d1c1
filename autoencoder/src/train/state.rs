//! The state of an unfinished training: parameters, moments, step and options.

use std::path::{Path, PathBuf};

use candle_core::{Device, Tensor};

use super::{TrainError, TrainOptions};
use crate::checkpoint::{self, Checkpoint, tensors_of};
use crate::model::Model;
use crate::optimizer::AdamW;
use crate::parameters::Parameter;

const KEY: &str = "training";

#[derive(serde::Serialize, serde::Deserialize)]
struct Header {
    step: usize,
    options: TrainOptions,
    /// Hash of the training data.
    data: String,
}

/// What a state belongs to.
#[derive(Clone, Copy)]
pub(super) struct Run<'a> {
    pub options: &'a TrainOptions,
    /// Hash of the training data.
    pub data: &'a str,
}

/// Where the state of a training to `out` lies.
pub fn state_of(out: &Path) -> PathBuf {
    let mut name = out.as_os_str().to_owned();
    name.push(".state");
    name.into()
}

/// Writes the state whole or not at all.
pub(super) fn save(path: &Path, run: Run, model: &dyn Model, optimizer: &AdamW) -> Result<(), TrainError> {
    let mut tensors = tensors_of(model);
    for (Parameter { name, var, .. }, moments) in model.parameters().iter().zip(&optimizer.moments) {
        let tensor = |values: &[f32]| Tensor::from_slice(values, var.shape(), &Device::Cpu);
        tensors.push((format!("mean.{name}"), tensor(&moments.mean)?));
        tensors.push((format!("square.{name}"), tensor(&moments.square)?));
    }
    let header = Header { step: optimizer.step, options: run.options.clone(), data: run.data.to_owned() };
    Ok(checkpoint::save(path, &tensors, (KEY, &serde_json::json!(header).to_string()))?)
}

/// The options that differ between two headers, and whether the data do, as `name value`, each for both.
fn differences(one: &Header, other: &Header) -> [String; 2] {
    let options = |header: &Header| match serde_json::json!(header.options) {
        serde_json::Value::Object(options) => options,
        _ => serde_json::Map::new(),
    };
    let (ours, theirs) = (options(one), options(other));
    let keys = ours.iter().filter(|(key, value)| theirs.get(*key) != Some(*value)).map(|(key, _)| key.as_str());
    let data = (one.data != other.data).then_some("data");
    let keys: Vec<&str> = keys.chain(data).collect();
    [(&ours, &one.data), (&theirs, &other.data)].map(|(options, data)| {
        let show = |key: &&str| match options.get(*key) {
            Some(value) => format!("{key} {value}"),
            None => format!("{key} {data}"),
        };
        keys.iter().map(show).collect::<Vec<_>>().join(", ")
    })
}

/// Puts a saved state into the model and the optimizer.
pub(super) fn load(path: &Path, run: Run, model: &dyn Model, optimizer: &mut AdamW) -> Result<(), TrainError> {
    let file = Checkpoint::load(path)?;
    let header = file.file.metadata(KEY).and_then(|json| serde_json::from_str::<Header>(json).ok());
    let Some(header) = header else {
        return Err(file.lacks("the state of a training", "another safetensors file").into());
    };
    let expected = Header { step: header.step, options: run.options.clone(), data: run.data.to_owned() };
    if header.options != expected.options || header.data != expected.data {
        let [expected, found] = differences(&expected, &header);
        return Err(TrainError::OtherRun { path: file.file.path().to_owned(), expected, found });
    }
    file.restore(model)?;
    for (Parameter { name, var, .. }, moments) in model.parameters().iter().zip(&mut optimizer.moments) {
        let moment = |kind: &str| file.tensor(&format!("{kind}.{name}"), var.dims());
        moments.mean.copy_from_slice(moment("mean")?);
        moments.square.copy_from_slice(moment("square")?);
    }
    optimizer.step = header.step;
    Ok(())
}
