//! A scene with its materials and the ladder of their models.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Result, bail};
use nbrdf_core::plan::Rung;
use nbrdf_core::sampler::lobe::Lobe;
use nbrdf_core::scene::{Gathering, Object, Scene, View};
use nbrdf_core::{Library, Material};
use rayon::prelude::*;

use crate::catalog::{Catalog, Ladder, Reference};
use crate::command::Global;
use crate::failure::Failure;
use crate::material::Shelf;
use crate::progress;

/// Bytes of a material that is no network, where its file's are not known.
const TABLE: usize = 4 * 3 * 90 * 90 * 180;

/// A scene, ready to be planned.
pub struct Opened {
    /// Its file.
    pub path: PathBuf,
    /// What it says.
    pub scene: Scene,
    /// Its materials, each once.
    pub materials: Vec<Material>,
    /// The material of every object, by its place.
    pub material: Vec<usize>,
    /// The kinds of models.
    pub ladder: Vec<Rung>,
    /// How lights are drawn for every object.
    lobes: Vec<Lobe>,
}

impl Opened {
    /// Reads a scene and what it names.
    pub fn load(path: &Path, library: Option<&Path>, checkpoints: &[PathBuf]) -> Result<Self> {
        let scene = Scene::load(path)?;
        let catalog = || Catalog::new(Arc::new(Reference::built_in()));
        let shelf = Shelf::new(library.map(Library::load).transpose()?, catalog());
        let others = checkpoints.iter().map(|path| catalog().with_checkpoint(path)).collect::<Result<Vec<_>>>()?;
        others.iter().try_for_each(Catalog::check_used)?;
        let mut places: BTreeMap<String, usize> = BTreeMap::new();
        let (mut materials, mut material, mut bytes) = (Vec::new(), Vec::new(), BTreeMap::new());
        for object in &scene.objects {
            let argument = argument(&shelf, object);
            let place = match places.get(&argument) {
                Some(place) => *place,
                None => {
                    let item = shelf.material(&argument).map_err(|error| {
                        let (file, name) = (path.display(), &object.name);
                        Failure::InvalidFile(format!("{file}: object '{name}': {error:#}"))
                    })?;
                    let length = std::fs::metadata(&argument).map_or(TABLE, |found| found.len() as usize);
                    bytes.insert(item.material.name.clone(), length);
                    places.insert(argument, materials.len());
                    materials.push(item.material);
                    materials.len() - 1
                }
            };
            material.push(place);
        }
        let own_bytes = move |material: &Material| bytes.get(&material.name).copied().unwrap_or(TABLE);
        let ladder = Ladder::rungs(&catalog(), &others, own_bytes)?;
        let fitted: Vec<Lobe> = materials.par_iter().map(|material| Lobe::fit(material.brdf.as_ref())).collect();
        let lobes = material.iter().map(|&place| fitted[place]).collect();
        Ok(Self { path: path.to_owned(), scene, materials, material, ladder, lobes })
    }

    /// What the picture asks for, from the camera of `scene`, which has the same objects.
    pub fn view(&self, scene: &Scene, global: &Global) -> Result<View> {
        let bar = progress::bar(scene.picture.height as u64, "looking", global.quiet);
        let done = || bar.inc(1);
        let how = Gathering { seed: global.seed(), done: &done, cancelled: &progress::cancelled };
        let Some(view) = View::gather(scene, &self.lobes, how) else { bail!("cancelled: nothing was written") };
        bar.finish_and_clear();
        let unseen: Vec<String> = view.unseen(&scene.objects).map(|object| format!("'{}'", object.name)).collect();
        match unseen.is_empty() {
            true => Ok(view),
            false => {
                let (file, unseen) = (self.path.display(), unseen.join(", "));
                let found = format!("{file}: expected every object in the picture, found {unseen} outside or hidden");
                Err(Failure::InvalidFile(format!("{found}: move the camera, or leave them out")).into())
            }
        }
    }

    /// The place of the object of this name; of the only one where there is no name.
    pub fn object(&self, name: Option<&str>) -> Result<usize> {
        let names = || self.scene.objects.iter().map(|object| object.name.as_str());
        let found = match name {
            Some(name) => names().position(|own| own == name),
            None => (self.scene.objects.len() == 1).then_some(0),
        };
        found.ok_or_else(|| {
            let all = names().collect::<Vec<_>>().join("', '");
            let asked = name.map_or_else(|| "no name".to_owned(), |name| format!("'{name}'"));
            Failure::Usage(format!("--object: expected one of '{all}', found {asked}")).into()
        })
    }
}

/// A name of the library, else a path from where the scene's file is.
fn argument(shelf: &Shelf, object: &Object) -> String {
    let beside = object.folder.join(&object.material);
    match shelf.library().get(&object.material).is_err() && beside.exists() {
        true => beside.display().to_string(),
        false => object.material.clone(),
    }
}
