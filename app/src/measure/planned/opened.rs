//! A scene with its materials and the ladder of their models.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Result, bail};
use nbrdf_core::Material;
use nbrdf_core::plan::{By, Options, Rung};
use nbrdf_core::sampler::lobe::Lobe;
use nbrdf_core::scene::{Gathering, Object, Scene, View};
use rayon::prelude::*;

use crate::catalog::{Catalog, NBRDF, Reference, ladder};
use crate::failure::Failure;
use crate::input;
use crate::material::{STDIN, Shelf};

/// Bytes of a table over the cells of MERL, as it is evaluated.
const TABLE: usize = 4 * 3 * 90 * 90 * 180;

/// A scene, ready to be planned.
pub struct Opened {
    /// Its file.
    pub path: PathBuf,
    /// What it says.
    pub scene: Scene,
    /// Its materials, each once.
    pub materials: Vec<Material>,
    /// Their files, where they are no names of a library.
    pub files: Vec<Option<PathBuf>>,
    /// The material of every object, by its place.
    pub material: Vec<usize>,
    /// The kinds of models.
    pub ladder: Vec<Rung>,
    /// How lights are drawn for every object.
    lobes: Vec<Lobe>,
    catalog: Arc<Catalog>,
    /// Catalogs of further checkpoints, by their files.
    others: Vec<(PathBuf, Catalog)>,
}

impl Opened {
    /// Reads a scene and what it names, and times the kinds of models, which learn from `catalog`: what that has learned
    /// before is used again.
    ///
    /// # Errors
    /// What is wrong with the scene, a material it names, the library or a checkpoint.
    pub fn load(path: &Path, library: Option<&Path>, checkpoints: &[PathBuf], catalog: &Arc<Catalog>) -> Result<Self> {
        if path.as_os_str() != STDIN {
            input::check_file(path, "a scene (.toml)")?;
        }
        let scene = Scene::load(path)?;
        let shelf = Shelf::new(library.map(input::library).transpose()?, Arc::clone(catalog));
        let plain = || Catalog::new(Arc::new(Reference::built_in()));
        let other = |path: &PathBuf| Ok((path.clone(), plain().with_checkpoint(path)?));
        let others = checkpoints.iter().map(other).collect::<Result<Vec<_>>>()?;
        others.iter().try_for_each(|(_, catalog)| catalog.check_used())?;
        let mut sources: Vec<Source> = Vec::new();
        let (mut materials, mut files, mut material) = (Vec::new(), Vec::new(), Vec::new());
        for object in &scene.objects {
            let named = |error: anyhow::Error| {
                let (file, name) = (path.display(), &object.name);
                anyhow::Error::from(Failure::InvalidFile(format!("{file}: object '{name}': {error:#}")))
            };
            let source = Source::of(&shelf, object).map_err(named)?;
            if let Some(place) = sources.iter().position(|known| *known == source) {
                material.push(place);
                continue;
            }
            let (own, file) = source.open(&shelf).map_err(named)?;
            material.push(sources.len());
            sources.push(source);
            materials.push(own);
            files.push(file);
        }
        let fitted: Vec<Lobe> = materials.par_iter().map(|material| Lobe::fit(material.brdf.as_ref())).collect();
        let lobes = material.iter().map(|&place| fitted[place]).collect();
        let path = path.to_owned();
        let (catalog, ladder) = (Arc::clone(catalog), Vec::new());
        let mut opened = Self { path, scene, materials, files, material, ladder, lobes, catalog, others };
        opened.ladder = opened.new_ladder()?;
        Ok(opened)
    }

    /// The kinds of models, of which none is made yet.
    ///
    /// # Errors
    /// If a kind cannot be made.
    pub fn new_ladder(&self) -> Result<Vec<Rung>> {
        let bytes = |file: &Option<PathBuf>| match file {
            Some(file) if file.extension().is_none_or(|extension| extension != "binary") => {
                std::fs::metadata(file).map_or(TABLE, |found| found.len() as usize)
            }
            _ => TABLE,
        };
        let own: Vec<_> = self.materials.iter().map(|m| m.brdf.clone()).zip(self.files.iter().map(bytes)).collect();
        let own_bytes = move |material: &Material| {
            let known = own.iter().find(|(brdf, _)| Arc::ptr_eq(brdf, &material.brdf));
            known.map_or(TABLE, |(_, bytes)| *bytes)
        };
        ladder(&self.catalog, &self.others, own_bytes)
    }

    /// What the picture asks for, from the camera of `scene`, which has the same objects; none when cancelled.
    pub fn view(&self, scene: &Scene, how: Gathering) -> Option<View> {
        View::gather(scene, &self.lobes, how)
    }

    /// Refuses objects that are not in the picture.
    ///
    /// # Errors
    /// Their names.
    pub fn refuse_unseen(&self, view: &View) -> Result<()> {
        let unseen: Vec<String> = view.unseen(&self.scene.objects).map(|object| format!("'{}'", object.name)).collect();
        if unseen.is_empty() {
            return Ok(());
        }
        let (file, unseen) = (self.path.display(), unseen.join(", "));
        let found = format!("{file}: expected every object in the picture, found {unseen} outside or hidden");
        Err(Failure::InvalidFile(format!("{found}: move the camera, or leave them out")).into())
    }

    /// How plans are made of it, within this tolerance: everything is compared with an NBRDF of every material.
    pub fn options(&self, tolerance: f64, by: By, most_bytes: usize) -> Options {
        let beside = self.ladder.iter().position(|rung| rung.name == NBRDF);
        Options { tolerance, by, exhaustive: false, most_bytes, beside }
    }
}

/// Where a material comes from.
#[derive(PartialEq, Eq)]
enum Source {
    /// A name of the library.
    Name(String),
    /// A file beside the scene's.
    File(PathBuf),
}

impl Source {
    /// A name of the library, else a path from where the scene's file is.
    fn of(shelf: &Shelf, object: &Object) -> Result<Self> {
        let unknown = match shelf.library().get(&object.material) {
            Ok(_) => return Ok(Self::Name(object.material.clone())),
            Err(unknown) => unknown,
        };
        let beside = object.folder.join(&object.material);
        match beside.is_file() {
            true => Ok(Self::File(beside.canonicalize().unwrap_or(beside))),
            false => bail!("{unknown} Nor is there a file {}", beside.display()),
        }
    }

    fn open(&self, shelf: &Shelf) -> Result<(Material, Option<PathBuf>)> {
        match self {
            Self::Name(name) => Ok((shelf.material(name)?.material, None)),
            Self::File(path) => {
                let Some(argument) = path.to_str() else { bail!("{}: expected a path in UTF-8", path.display()) };
                Ok((shelf.material(argument)?.material, Some(path.clone())))
            }
        }
    }
}
