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

/// Largest number of a chart: tables are logarithms, and there are half a million of them.
const LARGEST: f64 = 1e9;
/// Smallest variance.
const SMALLEST: f64 = 1e-30;

impl Basis for Charting {
    fn to_file(&self) -> BasisFile {
        let details = serde_json::json!({"names": self.span.names(), "learned_from": self.span.learned_from()});
        let file = self.span.write_into(BasisFile::new(self, details));
        self.atlas.write_into(file)
    }

    fn of_file(name: &'static str, file: &BasisFile) -> Result<Self, TensorFileError> {
        let span = Arc::new(Span::of_file(file)?);
        let atlas = Atlas::of_file(file, span.training())?;
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

    /// Learned from these points.
    fn of_file(file: &BasisFile, training: &[Vec<f64>]) -> Result<Self, TensorFileError> {
        let (points, length) = (training.len(), training[0].len());
        let (count, dim) = match file.shape("chart.axes")? {
            &[count, dim, numbers]
                if (1..=points).contains(&count) && (1..=length).contains(&dim) && numbers == length =>
            {
                (count, dim)
            }
            found => {
                let expected = format!("'chart.axes' of shape [up to {points} charts, axes, {length}]");
                return Err(file.lacks(expected, format!("{found:?}")));
            }
        };
        let f64s = |name: &str, shape: &[usize]| file.tensor::<f64>(name, shape, LARGEST);
        let mean = f64s("chart.mean", &[count, length])?;
        let axes = f64s("chart.axes", &[count, dim, length])?;
        let variances = f64s("chart.variances", &[count, dim])?;
        let off = f64s("chart.off", &[count])?;
        let linear = f64s("map.linear", &[count, dim, dim])?;
        let offset = f64s("map.offset", &[count, dim])?;
        let temperatures = [f64s("temperatures", &[2])?[0], f64s("temperatures", &[2])?[1]];
        let noise = f64s("noise", &[1])?[0];
        let positive = variances.iter().chain(off).chain(&temperatures).chain([&noise]);
        if let Some(value) = positive.into_iter().find(|value| **value < SMALLEST) {
            return Err(file.lacks(format!("variances, temperatures and noise of {SMALLEST:e} and more"), value));
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
        Ok(Self { mapping, agreement: f64s("agreement", &[dim])?.to_vec(), dim })
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
        let training: Vec<Vec<f64>> = file.rows("training", pca.components.len(), LARGEST)?;
        if names.len() != training.len() {
            return Err(file.lacks(format!("{} names of training materials", training.len()), names.len()));
        }
        Ok(Self { pca, training, names, checkpoint })
    }
}

#[cfg(test)]
mod tests {
    use super::super::Options;
    use super::*;
    use crate::representation::measured_tables::tests::glossy;

    #[test]
    fn charts_that_no_writer_makes_are_refused() {
        let span = Arc::new(Span::learn(&glossy(12)).unwrap());
        let options = Options { dim: 2, charts: usize::MAX, neighbours: 6, shared: 4.0, ridge: 1e-3 };
        let charting = Charting::learn("charting_2", span, options).unwrap();
        let changed = |name: &str, shape: &[usize], value: f64| {
            let numbers = vec![value; shape.iter().product()];
            let file = charting.to_file().with(name, shape, Numbers::F64(numbers));
            Charting::of_file("charting_2", &file).err().map_or("nothing wrong".to_owned(), |error| error.to_string())
        };
        let charts = charting.atlas().charts();
        assert_eq!(changed("noise", &[1], 1e-4), "nothing wrong");
        for (name, shape, value, says) in [
            ("noise", &[1][..], 0.0, "of 1e-30 and more"),
            ("chart.variances", &[charts, 2], -1.0, "of 1e-30 and more"),
            ("chart.mean", &[charts, 11], 1e300, "numbers within ±1e9"),
            ("chart.axes", &[13, 2, 11], 0.1, "up to 12 charts"),
            ("agreement", &[3], 0.5, "shape [2]"),
            ("training", &[5, 11], 0.5, "5 names"),
        ] {
            let said = changed(name, shape, value);
            assert!(said.contains(says), "{name}: {said}");
        }
    }
}
