//! Batches for the published autoencoder: networks with permuted colour channels, judged on spheres under one light.

use std::sync::Arc;

use nbrdf_core::nbrdf::fit::generator;
use nbrdf_core::nbrdf::objective::features;
use nbrdf_core::nbrdf::samples::Samples;
use nbrdf_core::nbrdf::{Layout, PUBLISHED_HIDDEN};
use nbrdf_core::{Nbrdf, Rgb, Vec3};
use rand::RngExt;
use rayon::prelude::*;

use super::{BATCH, Batch, Batches};
use crate::loss::{Target, Wanted};
use crate::model::CHANNEL_ORDERS;

/// Side of the rendered spheres in pixels.
const SIZE: usize = 64;

/// Networks and their spheres.
pub(crate) struct Spheres {
    samples: Arc<Samples>,
    networks: Vec<(Vec<f32>, Vec<Rgb>)>,
}

impl Spheres {
    /// Renders every network once.
    pub fn new(networks: &[Nbrdf]) -> Self {
        let samples = Arc::new(Samples::sphere(SIZE, Vec3::new(1.0, 0.0, 1.0).normalize()));
        let render = |network: &Nbrdf| (network.weights().to_vec(), samples.values(network));
        let networks = networks.par_iter().map(render).collect();
        Self { samples, networks }
    }
}

impl Batches for Spheres {
    fn batch(&self, seed: u64, step: usize) -> Batch {
        let row = |row: usize| {
            let rng = &mut generator(seed, (1 << 32) + (step * BATCH + row) as u64);
            let (weights, values) = &self.networks[rng.random_range(0..self.networks.len())];
            let order = CHANNEL_ORDERS[rng.random_range(0..CHANNEL_ORDERS.len())];
            let values: Vec<Rgb> = values.iter().map(|f| Rgb(order.map(|c| f[c]))).collect();
            let features = features(&self.samples, &values);
            let samples = Arc::clone(&self.samples);
            (permuted(weights, order), Target { samples, wanted: Wanted::Features(features), weight: 1.0 })
        };
        let (inputs, targets): (Vec<_>, Vec<_>) = (0..BATCH).into_par_iter().map(row).unzip();
        Batch { input: inputs.concat(), places: Vec::new(), targets }
    }
}

/// Reorders the colours of a network's output layer.
fn permuted(weights: &[f32], order: [usize; 3]) -> Vec<f32> {
    let mut weights = weights.to_vec();
    let output = Layout::new(PUBLISHED_HIDDEN).layers[2].0.start;
    for channels in weights[output..].chunks_exact_mut(3) {
        let old = [channels[0], channels[1], channels[2]];
        channels.copy_from_slice(&order.map(|c| old[c]));
    }
    weights
}
