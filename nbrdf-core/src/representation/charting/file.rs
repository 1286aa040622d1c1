//! A chart as a file: the span of the training materials, and every local projection with its place among the others.

use std::sync::Arc;

use faer::Mat;

use super::Charting;
use super::atlas::Atlas;
use super::chart::Chart;
use super::connection::Affine;
use super::mapping::Mapping;
use super::span::Span;
use crate::representation::basis::{Basis, BasisFile};
use crate::representation::log_table::TABLE_LEN;
use crate::representation::pca::Pca;
use crate::tensor_file::{Numbers, TensorFileError};

impl Basis for Charting {
    fn to_file(&self) -> BasisFile {
        let details = serde_json::json!({"names": self.span.names(), "learned_from": self.span.learned_from()});
        let file = self.span.write_into(BasisFile::new(self, details));
        self.atlas.write_into(file)
    }

    fn of_file(name: &'static str, file: &BasisFile) -> Result<Self, TensorFileError> {
        let span = Arc::new(Span::of_file(file)?);
        let atlas = Atlas::of_file(file, span.training()[0].len())?;
        Ok(Self { name, span, atlas, checkpoint: file.checkpoint().to_owned() })
    }
}

impl Atlas {
    /// With the tensors of every chart, and those of their connection.
    fn write_into(&self, file: BasisFile) -> BasisFile {
        let Mapping { placed, temperatures, noise } = &self.mapping;
        let charts = || placed.iter().map(|placed| &placed.chart);
        let maps = || placed.iter().map(|placed| &placed.map);
        let (count, dim, length) = (placed.len(), self.dim, charts().next().map_or(0, |chart| chart.mean.len()));
        let f64s = |numbers: Vec<f64>| Numbers::F64(numbers);
        let rows = |matrix: &Mat<f64>| -> Vec<f64> {
            (0..dim).flat_map(|a| (0..dim).map(move |b| (a, b))).map(|(a, b)| matrix[(a, b)]).collect()
        };
        file.with("chart.mean", &[count, length], f64s(charts().flat_map(|c| c.mean.clone()).collect()))
            .with("chart.axes", &[count, dim, length], f64s(charts().flat_map(|c| c.axes.concat()).collect()))
            .with("chart.variances", &[count, dim], f64s(charts().flat_map(|c| c.variances.clone()).collect()))
            .with("chart.off", &[count], f64s(charts().map(|c| c.off).collect()))
            .with("map.linear", &[count, dim, dim], f64s(maps().flat_map(|map| rows(&map.linear)).collect()))
            .with("map.offset", &[count, dim], f64s(maps().flat_map(|map| map.offset.clone()).collect()))
            .with("temperatures", &[2], f64s(temperatures.to_vec()))
            .with("noise", &[1], f64s(vec![*noise]))
            .with("agreement", &[self.agreement.len()], f64s(self.agreement.clone()))
    }

    /// Of points of so many numbers.
    fn of_file(file: &BasisFile, length: usize) -> Result<Self, TensorFileError> {
        let (count, dim) = match file.shape("chart.axes")? {
            &[count, dim, numbers] if count > 0 && (1..=length).contains(&dim) && numbers == length => (count, dim),
            found => {
                return Err(file.lacks(format!("'chart.axes' of shape [charts, axes, {length}]"), format!("{found:?}")));
            }
        };
        let f64s = |name: &str, shape: &[usize]| file.tensor::<f64>(name, shape);
        let mean = f64s("chart.mean", &[count, length])?;
        let axes = f64s("chart.axes", &[count, dim, length])?;
        let variances = f64s("chart.variances", &[count, dim])?;
        let off = f64s("chart.off", &[count])?;
        let linear = f64s("map.linear", &[count, dim, dim])?;
        let offset = f64s("map.offset", &[count, dim])?;
        let temperatures = [f64s("temperatures", &[2])?[0], f64s("temperatures", &[2])?[1]];
        let noise = f64s("noise", &[1])?[0];
        let positive = variances.iter().chain(off).chain(&temperatures).chain([&noise]);
        if let Some(value) = positive.into_iter().find(|value| **value <= 0.0) {
            return Err(file.lacks("variances, temperatures and noise above 0", value));
        }
        let one = |k: usize| {
            let axes = axes[k * dim * length..].chunks_exact(length).take(dim).map(<[f64]>::to_vec).collect();
            let own = |numbers: &[f64], size: usize| numbers[k * size..][..size].to_vec();
            let map = Affine {
                linear: Mat::from_fn(dim, dim, |a, b| linear[(k * dim + a) * dim + b]),
                offset: own(offset, dim),
            };
            (Chart::of_axes(own(mean, length), axes, own(variances, dim), off[k]), map)
        };
        let (charts, maps) = (0..count).map(one).unzip();
        let mapping = Mapping::of_noise(charts, maps, noise, temperatures);
        let mapping = mapping.map_err(|error| file.lacks("charts that can be inverted", error))?;
        let agreement = file.tensor("agreement", file.shape("agreement")?)?.to_vec();
        Ok(Self { mapping, agreement, dim })
    }
}

impl Span {
    /// With mean and components, and `training` \[materials, components\].
    fn write_into(&self, file: BasisFile) -> BasisFile {
        let shape = [self.training.len(), self.training[0].len()];
        self.pca.write_into(file).with("training", &shape, Numbers::F64(self.training.concat()))
    }

    fn of_file(file: &BasisFile) -> Result<Self, TensorFileError> {
        #[derive(serde::Deserialize)]
        struct Details {
            names: Vec<String>,
            learned_from: String,
        }
        let Details { names, learned_from: checkpoint } = file.details()?;
        let pca = Pca::of_file(file, TABLE_LEN)?;
        let training: Vec<Vec<f64>> = file.rows("training", pca.components.len())?;
        if names.len() != training.len() {
            return Err(file.lacks(format!("{} names of training materials", training.len()), names.len()));
        }
        Ok(Self { pca, training, names, checkpoint })
    }
}
