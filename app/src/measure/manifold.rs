//! How well coordinates of materials keep to the manifold: distances, reconstructions, points in between.

use std::collections::BTreeMap;
use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::metric::{LogError, Metric as _, Spread, albedo_max, negative_share};
use nbrdf_core::representation::charting::distortion::{Distortion, geodesics};
use nbrdf_core::representation::charting::{Charting, Span};
use nbrdf_core::representation::log_table::{self, TABLE_LEN};
use nbrdf_core::{Brdf, Material};
use rayon::prelude::*;
use serde::Serialize;

use crate::progress;

/// Neighbours in the graph along which distances are measured.
pub const NEIGHBOURS: usize = 6;

/// Coordinates of points of the span.
pub enum Coordinates {
    /// The first so many principal components.
    Principal(usize),
    /// A chart's.
    Chart(Arc<Charting>),
}

impl Coordinates {
    /// Name in reports.
    pub fn name(&self) -> String {
        match self {
            Self::Principal(dim) => format!("pca_{dim}"),
            Self::Chart(charting) => format!("charting_{}", charting.atlas().dim()),
        }
    }

    /// Of a point of the span.
    pub fn forward(&self, place: &[f64]) -> Vec<f64> {
        match self {
            Self::Principal(dim) => place[..*dim].to_vec(),
            Self::Chart(charting) => charting.atlas().forward(place),
        }
    }

    /// A point of the span.
    fn backward(&self, coordinates: &[f64], length: usize) -> Vec<f64> {
        match self {
            Self::Principal(_) => {
                let mut place = coordinates.to_vec();
                place.resize(length, 0.0);
                place
            }
            Self::Chart(charting) => charting.atlas().backward(coordinates),
        }
    }
}

/// Figures of one kind of coordinates.
#[derive(Debug, Serialize)]
pub struct Row {
    /// `pca_2`, `charting_2`, ...
    pub name: String,
    /// Distances against distances along the manifold, pairs with a held-out material.
    pub distances: Distortion,
    /// The same between training materials.
    pub train_distances: Distortion,
    /// `log_error` of held-out materials, decoded from their coordinates.
    pub log_error: Option<Spread>,
    /// The same in the log table, root mean square over its numbers.
    pub table_error: Option<Spread>,
    /// Points halfway between the two materials of a pair, by the pairs' names.
    pub middles: Middles,
}

/// What the middles are like.
#[derive(Debug, Serialize)]
pub struct Middles {
    /// Share of directions where the reflectance before its clamp is below 0.
    pub negative_share: Option<Spread>,
    /// Largest directional albedo.
    pub albedo_max: Option<Spread>,
    /// Middles of which it is above 1.
    pub energy_violations: usize,
    /// Distance to the table of the nearest training material, root mean square over its numbers.
    pub nearest_training: Option<Spread>,
}

/// Materials and their places in the span.
pub struct Placed<'a> {
    /// The span of the training materials.
    pub span: Arc<Span>,
    /// The materials, in the order of their names.
    pub materials: Vec<&'a Material>,
    /// Coordinates in the span.
    pub places: Vec<Vec<f64>>,
    /// Whether nothing was learned from it.
    pub held_out: Vec<bool>,
    /// Ways along the manifold between all of them.
    along: Vec<Vec<f64>>,
}

impl<'a> Placed<'a> {
    /// Projects the materials.
    pub fn new(span: Arc<Span>, materials: Vec<&'a Material>) -> Result<Self> {
        let known: BTreeMap<&str, &Vec<f64>> = span.names().iter().map(String::as_str).zip(span.training()).collect();
        let place = |material: &&Material| match known.get(material.name.as_str()) {
            Some(place) => Ok((*place).clone()),
            None => span.project(material),
        };
        let places = materials.iter().map(place).collect::<Result<Vec<_>, _>>()?;
        let held_out = materials.iter().map(|material| !known.contains_key(material.name.as_str())).collect();
        let along = geodesics(&places, NEIGHBOURS);
        Ok(Self { span, materials, places, held_out, along })
    }

    /// Figures of these coordinates; `pairs` of places whose middles are judged.
    pub fn measure(&self, coordinates: &Coordinates, pairs: &[(usize, usize)]) -> Result<Row> {
        let found: Vec<Vec<f64>> = self.places.iter().map(|place| coordinates.forward(place)).collect();
        let back = |at: &[f64]| coordinates.backward(at, self.span.training().len() - 1);
        let decoded = |place: &[f64]| log_table::table(self.span.reconstruct(place));
        let errors = (0..found.len()).filter(|&i| self.held_out[i]).map(|i| {
            progress::check()?;
            let place = back(&found[i]);
            let brdf = self.materials[i].brdf.as_ref();
            // Against the material's own table: the part of it that lies outside the span is lost as well.
            let (own, table) = (log_table::tabulate(brdf), self.span.reconstruct(&place));
            let squares: f64 = own.iter().zip(&table).map(|(a, b)| f64::from(a - b).powi(2)).sum();
            let apart = (squares / TABLE_LEN as f64).sqrt();
            Ok((i, [LogError.distance(brdf, &log_table::table(table)), apart]))
        });
        let errors = errors.collect::<Result<Vec<_>>>()?;
        let middle = |&(a, b): &(usize, usize)| {
            progress::check()?;
            let halfway: Vec<f64> = found[a].iter().zip(&found[b]).map(|(a, b)| 0.5 * (a + b)).collect();
            let place = back(&halfway);
            let brdf: &dyn Brdf = &decoded(&place);
            let nearest = self.span.training().iter().map(|other| table_distance(&place, other));
            let name = format!("{} > {}", self.materials[a].name, self.materials[b].name);
            Ok((name, [negative_share(brdf), albedo_max(brdf), nearest.fold(f64::INFINITY, f64::min)]))
        };
        let middles = pairs.par_iter().map(middle).collect::<Result<Vec<_>>>()?;
        let of_errors = |k: usize| {
            Spread::new(errors.iter().map(|(i, figures)| (self.materials[*i].name.as_str(), figures[k])), false)
        };
        let of_middles =
            |k: usize| Spread::new(middles.iter().map(|(name, figures)| (name.as_str(), figures[k])), false);
        Ok(Row {
            name: coordinates.name(),
            distances: self.distortion(&found, |a, b| self.held_out[a] || self.held_out[b]),
            train_distances: self.distortion(&found, |a, b| !self.held_out[a] && !self.held_out[b]),
            log_error: of_errors(0),
            table_error: of_errors(1),
            middles: Middles {
                negative_share: of_middles(0),
                albedo_max: of_middles(1),
                energy_violations: middles
                    .iter()
                    .filter(|(_, [_, albedo, _])| albedo.is_nan() || *albedo > 1.0)
                    .count(),
                nearest_training: of_middles(2),
            },
        })
    }

    fn distortion(&self, found: &[Vec<f64>], counts: impl Fn(usize, usize) -> bool) -> Distortion {
        let pairs = (0..found.len()).flat_map(|a| (0..a).map(move |b| (a, b))).filter(|&(a, b)| counts(a, b));
        Distortion::of(&pairs.map(|(a, b)| (distance(&found[a], &found[b]), self.along[a][b])).collect::<Vec<_>>())
    }
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Root mean square over a table's numbers.
fn table_distance(a: &[f64], b: &[f64]) -> f64 {
    distance(a, b) / (TABLE_LEN as f64).sqrt()
}
