//! The methods that learn.

use std::ops::ControlFlow;
use std::sync::Arc;

use anyhow::Result;
use autoencoder::{Architecture, TrainError, TrainOptions, TrainingData, train};
use nbrdf_core::library::builtin;
use nbrdf_core::representation::refined::Refined;
use nbrdf_core::{Material, Nbrdf, Representation};

use super::super::Setup;
use crate::families;

/// Analytic materials and walks of a short training: half of a whole one's.
const ANALYTIC: usize = 128;
const WALKS: usize = 256;

/// A method that learns.
pub(super) struct Student {
    /// Name of the representation.
    pub name: &'static str,
    /// Whether what it learns depends on a seed.
    pub is_random: bool,
}

pub(super) const STUDENTS: [Student; 7] = [
    Student { name: "znbrdf", is_random: true },
    Student { name: "pca_tables", is_random: false },
    Student { name: "pca_45", is_random: false },
    Student { name: "pca_weights", is_random: false },
    Student { name: "charting_15", is_random: false },
    Student { name: "linear_combination", is_random: false },
    Student { name: "optimal_sampling_20", is_random: false },
];

impl Student {
    /// What is learned from these, or why it cannot be: they may be too few for the method.
    pub fn learn(
        &self,
        setup: &Setup,
        materials: &[Material],
        seed: u64,
        done: &(dyn Fn(&str) -> Result<()> + Sync),
    ) -> Result<Result<Arc<dyn Representation>, String>> {
        match self.name {
            "znbrdf" => trained(setup, materials, seed, done),
            name => {
                let catalog = setup.catalog.learning_from(materials.to_vec());
                Ok(catalog.representation(name, false).map_err(|error| format!("{error:#}")))
            }
        }
    }
}

/// ZNBRDF after few steps.
fn trained(
    setup: &Setup,
    materials: &[Material],
    seed: u64,
    done: &(dyn Fn(&str) -> Result<()> + Sync),
) -> Result<Result<Arc<dyn Representation>, String>> {
    let shared = builtin::shared();
    let own = |material: &Material| Some(shared.get(&material.name).ok()?.network.clone());
    let networks: Vec<Nbrdf> = materials.iter().filter_map(own).collect();
    let analytic = families::random_materials(seed, ANALYTIC);
    let walks = families::random_walks(seed, WALKS);
    let data = TrainingData {
        measured: materials,
        analytic: &analytic,
        walks: &walks,
        networks: &networks,
        start: shared.shared_start(),
    };
    let options = TrainOptions { steps: setup.extent.steps, seed, ..TrainOptions::new(Architecture::Znbrdf) };
    let folder = tempfile::tempdir()?;
    let checkpoint = folder.path().join("znbrdf.safetensors");
    let mut stopped = None;
    let trained = train(&data, &options, &checkpoint, false, &mut |now, _| match done(&format!(
        "znbrdf, step {} of {}",
        now.step, options.steps
    )) {
        Ok(()) => ControlFlow::Continue(()),
        Err(error) => {
            stopped = Some(error);
            ControlFlow::Break(())
        }
    });
    match (trained, stopped) {
        (Err(TrainError::Stopped { .. }), Some(error)) => Err(error),
        (Err(few @ TrainError::TooFew { .. }), _) => Ok(Err(few.to_string())),
        (trained, _) => Ok(Ok(Arc::new(Refined::briefly(Arc::new(trained?))))),
    }
}
