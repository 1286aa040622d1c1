//! The thread that reads files of every kind: networks, libraries, codes and maps at once; measurements are handed on to
//! be fitted.

use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError, mpsc};

use nbrdf_core::library::is_name;
use nbrdf_core::measured::{self, is_measured};
use nbrdf_core::nbrdf::file::read_anisotropic;
use nbrdf_core::render::Environment;
use nbrdf_core::scene::Mesh;
use nbrdf_core::{Library, Material, bounded};

use super::cache::{self, Kind};
use super::fits::Fits;
use super::{Answer, Map, Office, Solid, guarded};
use crate::fitted::Fitted;
use crate::material::{decoded, parse_code, read_code};
use crate::measure::guard;

/// Measurements beyond this size \[bytes\] are fitted anew at every start.
const MOST_BYTES: u64 = 1 << 30;

/// What is to be opened.
pub(super) enum Letter {
    /// A file that the user wants to see.
    Open(PathBuf),
    /// Those of the last session.
    Reopen(Vec<PathBuf>),
    /// A code as text, which came from no file.
    Paste(String),
}

/// Where files go.
#[derive(Clone)]
pub(super) struct Desk {
    pub office: Office,
    pub fits: Arc<Fits>,
    pub thumbnails: mpsc::Sender<Vec<Material>>,
}

/// Reads files as they come.
pub(super) fn run(desk: &Desk, letters: &mpsc::Receiver<Letter>) {
    for letter in letters {
        match letter {
            Letter::Open(path) => desk.open(path, false),
            Letter::Reopen(paths) => {
                paths.into_iter().for_each(|path| desk.open(path, true));
                desk.office.say(Answer::Reopened);
            }
            Letter::Paste(text) => match guarded("Reading the code", || desk.paste(&text)) {
                Ok(Ok(())) => {}
                Ok(Err(why)) | Err(why) => desk.office.say(Answer::Notice(why)),
            },
        }
    }
}

impl Desk {
    fn open(&self, path: PathBuf, is_again: bool) {
        match guarded("Reading the file", || self.read(&path, is_again)) {
            Ok(Ok(())) => {}
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
            return Err(format!("{}: expected a file or a folder, found none: check the path", path.display()));
        }
        if is("hdr") || is("exr") {
            return self.surround(path, is_again);
        }
        if Mesh::ENDINGS.iter().any(|ending| is(ending)) {
            return self.solid(path, is_again);
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

    fn surround(&self, path: &Path, is_again: bool) -> Result<(), String> {
        let environment = Environment::load(path).map_err(|error| error.to_string())?;
        let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let (names, place) = self.office.surround_with(Map { name, file: Some(path.to_owned()), environment });
        self.office.say(if is_again { Answer::Maps(names) } else { Answer::Surround(names, place) });
        // Where it was read before, the same request is now for another picture.
        self.office.requests.again();
        self.office.say(Answer::Kept(path.to_owned(), Vec::new()));
        Ok(())
    }

    fn solid(&self, path: &Path, is_again: bool) -> Result<(), String> {
        let mesh = Mesh::load(path).map_err(|error| error.to_string())?;
        let name = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let (names, place) = self.office.show_on(Solid { name, file: Some(path.to_owned()), mesh });
        self.office.say(if is_again { Answer::Solids(names) } else { Answer::Solid(names, place) });
        // As of maps; and other surfaces are at a point.
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

    /// The material of a code on the clipboard.
    fn paste(&self, text: &str) -> Result<(), String> {
        let code = parse_code("clipboard", text.as_bytes()).map_err(|error| format!("{error:#}"))?;
        let item = decoded(&self.office.stock.catalog, code, "clipboard").map_err(|error| format!("{error:#}"))?;
        self.list("pasted", vec![item.material]);
        Ok(())
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

    /// Puts materials of a file into the list.
    pub fn add(&self, path: &Path, materials: Vec<Material>) {
        let names = self.list(&measured::name_of(path), materials);
        self.office.say(Answer::Kept(path.to_owned(), names));
    }

    /// Puts materials into the list; the names they have there.
    fn list(&self, origin: &str, mut materials: Vec<Material>) -> Vec<String> {
        let office = &self.office;
        let mut shelf = office.materials.write().unwrap_or_else(PoisonError::into_inner);
        for material in &mut materials {
            // Two files may hold a material of one name; both stay.
            let (name, mut copy) = (material.name.clone(), 1);
            while shelf.iter().any(|known| known.name == material.name) {
                material.name =
                    if copy == 1 { format!("{name} ({origin})") } else { format!("{name} ({origin} {copy})") };
                copy += 1;
            }
            shelf.push(material.clone());
        }
        drop(shelf);
        let names: Vec<String> = materials.iter().map(|material| material.name.clone()).collect();
        office.say(Answer::Opened(names.clone()));
        // Spheres may have waited for it since the start.
        if office.requests.newest().is_some_and(|(_, request)| request.ends.iter().any(|end| names.contains(end))) {
            office.requests.again();
            office.points.again();
            office.questions.again();
        }
        office.inquiries.again();
        office.map_requests.again();
        // The thread ends only with the process.
        let _ = self.thumbnails.send(materials.clone());
        self.warn(&materials);
        names
    }

    /// What is odd about materials that were opened.
    fn warn(&self, materials: &[Material]) {
        for Material { name, brdf, .. } in materials {
            let brdf = brdf.as_ref();
            let said = || guard::of_result(brdf).chain(guard::of_source(brdf)).collect();
            let warnings: Vec<_> = guarded(name, said).unwrap_or_default();
            warnings.into_iter().for_each(|warning| self.office.say(Answer::Notice(format!("{name}: {warning}"))));
        }
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
