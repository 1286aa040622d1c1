//! The thread that reads files of every kind: networks, libraries, codes and maps at once; measurements are handed on to
//! be fitted.

mod list;

use std::path::{Path, PathBuf};
use std::sync::{Arc, mpsc};

use nbrdf_core::library::is_name;
use nbrdf_core::measured::{self, is_measured};
use nbrdf_core::nbrdf::file::read_anisotropic;
use nbrdf_core::render::Environment;
use nbrdf_core::scene::Mesh;
use nbrdf_core::{Library, Material, bounded};

use super::cache::{self, Kind};
use super::fits::Fits;
use super::office::Office;
use super::opened::Opened;
use super::{Answer, PastedCode, guarded};
use crate::fitted::Fitted;
use crate::input;
use crate::material::{decoded, read_code};

/// Measurements beyond this size \[bytes\] are fitted anew at every start.
const MOST_BYTES: u64 = 1 << 30;

/// What is to be opened.
pub(super) enum Letter {
    /// A file that the user wants to see.
    Open(PathBuf),
    /// Those of the last session, and its codes.
    Reopen(Vec<PathBuf>, Vec<PastedCode>),
    /// A code as text, which came from no file.
    Paste(String),
}

/// Where files go.
#[derive(Clone)]
pub(super) struct Desk {
    pub office: Office,
    pub fits: Arc<Fits>,
    pub opened: Opened,
    pub thumbnails: mpsc::Sender<Vec<Material>>,
}

/// Reads files as they come.
pub(super) fn run(desk: &Desk, letters: &mpsc::Receiver<Letter>) {
    for letter in letters.iter().take_while(|_| !desk.office.activity.is_over()) {
        let _busy = desk.office.activity.begin();
        match letter {
            Letter::Open(path) => desk.open(path, false),
            Letter::Reopen(paths, codes) => {
                // First: their names in the list are known, and are still free.
                codes.into_iter().for_each(|code| desk.paste_again(code));
                let wanted = paths.into_iter().take_while(|_| !desk.office.activity.is_over());
                wanted.for_each(|path| desk.reopen(path));
                desk.office.say(Answer::Reopened);
            }
            Letter::Paste(text) => desk.paste(text),
        }
    }
}

impl Desk {
    /// A file of the last session. One that is missing stays with it: its disk may be plugged in at the next start.
    fn reopen(&self, path: PathBuf) {
        if path.exists() {
            return self.open(path, true);
        }
        let why = "it was open when the last session ended, and is missing now";
        let advice = "It is looked for at the next start again, unless it is opened once while it is missing";
        self.office.say(Answer::Notice(format!("{}: {why}. {advice}", path.display())));
    }

    fn open(&self, path: PathBuf, is_again: bool) {
        let path = self.opened.path(path);
        match guarded("Reading the file", || self.read(&path, is_again)) {
            Ok(Ok(())) => {}
            Ok(Err(why)) | Err(why) if is_again => {
                // It may be on its way: half a copy, a disk that is not ready.
                self.office.say(Answer::Notice(format!("{why}. It is looked for at the next start again")));
            }
            Ok(Err(why)) | Err(why) => self.lose(path, why),
        }
    }

    /// A file that gives no material, and why.
    pub fn lose(&self, path: PathBuf, why: String) {
        self.office.say(Answer::Notice(why));
        self.office.say(Answer::Lost(path));
    }

    fn read(&self, path: &Path, is_again: bool) -> Result<(), String> {
        let is = |form: &str| path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(form));
        if !path.exists() {
            return Err(input::missing(path.display(), "a file or a folder", "").to_string());
        }
        if is("hdr") || is("exr") {
            return self.map(path, is_again);
        }
        if Mesh::ENDINGS.iter().any(|ending| is(ending)) {
            return self.mesh(path, is_again);
        }
        if is_measured(path) {
            return self.measured(path);
        }
        // The text of a library of ours lies beside its networks.
        let is_code = is("json") && path.file_name().is_some_and(|name| name != "manifest.json");
        let materials = if is_code { self.decode(path) } else { network(path) };
        self.add(path, materials?);
        Ok(())
    }

    fn map(&self, path: &Path, is_again: bool) -> Result<(), String> {
        let environment = Environment::load(path).map_err(|error| error.to_string())?;
        let map = self.office.maps.put(path, environment);
        self.office.say(Answer::Maps(self.office.maps.listed(), (!is_again).then_some(map)));
        // The same request may now be for another picture.
        self.office.arrive();
        self.office.requests.again();
        self.office.say(Answer::Kept(path.to_owned(), Vec::new()));
        Ok(())
    }

    fn mesh(&self, path: &Path, is_again: bool) -> Result<(), String> {
        let mesh = Mesh::load(path).map_err(|error| error.to_string())?;
        let mesh = self.office.meshes.put(path, mesh);
        self.office.say(Answer::Meshes(self.office.meshes.listed(), (!is_again).then_some(mesh)));
        // As of maps; and other surfaces are at a point.
        self.office.arrive();
        self.office.requests.again();
        self.office.points.again();
        self.office.say(Answer::Kept(path.to_owned(), Vec::new()));
        Ok(())
    }

    fn decode(&self, path: &Path) -> Result<Vec<Material>, String> {
        let (argument, catalog) = (path.to_string_lossy(), &self.office.stock.catalog);
        let item = read_code(&argument).and_then(|code| decoded(catalog, code, &argument));
        let item = item.map_err(|error| format!("{error:#}"))?;
        let is_named = item.code.is_some_and(|code| code.material.is_some());
        let name = if is_named { item.material.name } else { name_of(path)? };
        Ok(vec![Material { name, ..item.material }])
    }

    /// A measurement: fitted before, or to be fitted.
    fn measured(&self, path: &Path) -> Result<(), String> {
        let name = name_of(path)?;
        let key = self.key_of(path)?;
        let kept = key.as_deref().and_then(|key| self.office.stock.cache.get(Kind::Network, key));
        match kept.and_then(|bytes| Fitted::from_bytes(&bytes).ok()) {
            Some(fitted) => self.add(path, vec![fitted.into_material(name)]),
            None => {
                self.fits.put(path.to_owned(), name, key);
                self.office.say(Answer::Jobs(self.fits.shown()));
            }
        }
        Ok(())
    }

    /// What the fit of a measurement is kept under; none of one that is too large.
    pub fn key_of(&self, path: &Path) -> Result<Option<String>, String> {
        let told = |error: std::io::Error| format!("{}: {error}", path.display());
        let steps = self.office.stock.fit_steps.to_le_bytes();
        let form = path.extension().unwrap_or_default().as_encoded_bytes();
        let bytes = bounded::read(path, MOST_BYTES).map_err(told)?;
        Ok(bytes.map(|bytes| cache::key(&[&bytes, form, &steps])))
    }
}

/// A network that reads the azimuth, or whatever a library is read from.
fn network(path: &Path) -> Result<Vec<Material>, String> {
    if let Some(network) = read_anisotropic(path).map_err(|error| error.to_string())? {
        return Ok(vec![Material::new(name_of(path)?, Arc::new(network))]);
    }
    Library::load(path).map(|library| library.materials()).map_err(|error| error.to_string())
}

/// The name that a file gives its material.
fn name_of(path: &Path) -> Result<String, String> {
    let name = measured::name_of(path);
    let refused = || format!("{}: expected a printable name: rename the file", path.display());
    is_name(&name).then_some(name).ok_or_else(refused)
}
