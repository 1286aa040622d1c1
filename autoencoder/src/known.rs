//! How far a code is from those of the materials that training saw.

use candle_core::{Device, Tensor};
use nbrdf_core::axis::Prior;
use nbrdf_core::representation::EncodeError;
use nbrdf_core::representation::refined::{Effort, refine};
use nbrdf_core::{Material, Representation};
use rayon::prelude::*;

use crate::Autoencoder;
use crate::checkpoint::{Checkpoint, CheckpointError};
use crate::model::{CHANNEL_ORDERS, CodeLayout};

/// The tensor's name in a checkpoint.
const NAME: &str = "known";

/// The codes of the training materials. A material in other colours is the same: all orders of the channels count.
pub(crate) struct Known {
    codes: Vec<Vec<f32>>,
    /// Standard deviation of every number, the same for all channels.
    spread: Vec<f64>,
    /// Median distance of a known code to the nearest other one.
    unit: f64,
}

impl Known {
    /// From the tensors of a checkpoint.
    pub fn new(file: &Checkpoint) -> Result<Self, CheckpointError> {
        let layout = CodeLayout::of(file)?;
        let dim = layout.dim();
        let own: Vec<Vec<f32>> = file.file.rows(NAME, dim)?;
        if own.len() < 2 {
            return Err(file.lacks(format!("2 or more rows in tensor '{NAME}'"), own.len()));
        }
        let codes: Vec<Vec<f32>> =
            own.iter().flat_map(|code| CHANNEL_ORDERS.map(|order| reordered(layout, code, order))).collect();
        let deviation = |number: usize| {
            let values = || codes.iter().map(|code| f64::from(code[number]));
            let mean = values().sum::<f64>() / codes.len() as f64;
            (values().map(|v| (v - mean) * (v - mean)).sum::<f64>() / codes.len() as f64).sqrt().max(1e-6)
        };
        let spread = (0..dim).map(deviation).collect();
        let mut known = Self { codes, spread, unit: 1.0 };
        let mut nearest: Vec<f64> = own.iter().enumerate().map(|(i, code)| known.nearest(code, Some(i))).collect();
        nearest.sort_by(f64::total_cmp);
        known.unit = nearest[nearest.len() / 2].max(1e-9);
        Ok(known)
    }

    /// Distance of a code \[dim\] to the nearest known one; 1 is the median distance between neighbours among these.
    pub fn distance(&self, code: &[f32]) -> f64 {
        self.nearest(code, None) / self.unit
    }

    /// How the codes are spread, colours in any order.
    pub fn prior(&self) -> Prior {
        Prior::of(&self.codes)
    }

    fn nearest(&self, code: &[f32], but: Option<usize>) -> f64 {
        let distance = |known: &Vec<f32>| {
            let term = |((a, b), spread): ((&f32, &f32), &f64)| (f64::from(a - b) / spread).powi(2);
            (code.iter().zip(known).zip(&self.spread).map(term).sum::<f64>() / code.len() as f64).sqrt()
        };
        let others = self.codes.iter().enumerate().filter(|(i, _)| Some(i / CHANNEL_ORDERS.len()) != but);
        others.map(|(_, known)| distance(known)).fold(f64::INFINITY, f64::min)
    }
}

fn reordered(CodeLayout { shared, channel }: CodeLayout, code: &[f32], order: [usize; 3]) -> Vec<f32> {
    let channel = |c: usize| &code[shared + channel * c..shared + channel * (c + 1)];
    code[..shared].iter().chain(order.into_iter().flat_map(channel)).copied().collect()
}

/// The codes of training materials as encoding makes them, unrolled steps included.
pub(crate) fn codes(autoencoder: &Autoencoder, materials: &[Material]) -> Result<Vec<Vec<f32>>, EncodeError> {
    let code = |material: &Material| {
        let own = autoencoder.encode(material)?;
        Ok(refine(autoencoder, &own, material.brdf.as_ref(), Effort::BRIEF)?.code)
    };
    materials.par_iter().map(code).collect()
}

/// Such codes, for the checkpoint.
pub(crate) fn tensor(codes: &[Vec<f32>]) -> candle_core::Result<(String, Tensor)> {
    let dim = codes.first().map_or(0, Vec::len);
    Ok((NAME.into(), Tensor::from_vec(codes.concat(), (codes.len(), dim), &Device::Cpu)?))
}

#[cfg(test)]
mod tests {
    use nbrdf_core::Code;
    use nbrdf_core::library::builtin;

    use super::*;
    use crate::Architecture;

    #[test]
    fn training_materials_are_near_in_any_colours_and_wild_codes_are_far() {
        let model = Autoencoder::built_in(Architecture::Znbrdf);
        let distance = |code: &Code| model.distance(code).unwrap().unwrap();
        let code = model.encode(&builtin::shared().get("gold-paint").unwrap().material()).unwrap();
        assert!(distance(&code) < 0.5, "{}", distance(&code));
        let turned = Code { code: reordered(CodeLayout::new(code.code.len()), &code.code, [2, 0, 1]), ..code.clone() };
        assert!((distance(&turned) - distance(&code)).abs() < 1e-6);
        let wild = Code { code: code.code.iter().map(|v| 4.0 * v).collect(), ..code.clone() };
        assert!(distance(&wild) > 2.0, "{}", distance(&wild));
        let foreign = Code { model: "pca_tables".into(), ..code };
        assert!(model.distance(&foreign).unwrap().is_none());
    }
}
