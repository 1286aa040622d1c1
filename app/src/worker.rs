//! Long work off the UI thread: prepares paths, renders spheres, compares them.
//!
//! Three threads. *Paths* encodes materials and learns bases; *studio* renders the newest request, coarse first and
//! fine when nothing newer came; *shelf* renders thumbnails and reads files. Each has a mailbox in which the newest
//! request replaces older ones. Nothing here knows a window: answers wait in a channel, and `wake` says that they do.

mod figures;
mod films;
mod mailbox;
mod paths;
mod picture;
mod plates;
mod request;
mod shelf;
mod spheres;
mod stock;
mod strips;
mod studio;
mod surround;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::{Arc, PoisonError, RwLock, mpsc};

use nbrdf_core::Material;
use nbrdf_core::render::Environment;

pub use figures::Figures;
pub(crate) use mailbox::Mailbox;
pub use picture::Picture;
pub use plates::Plates;
pub use request::{Lighting, Request, Scenery, Timing};
pub use stock::Stock;

use paths::Paths;

/// Points of a film strip, ends included.
pub const STRIP_STEPS: usize = 9;

/// One sphere of the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Card {
    /// The material at this end.
    End(usize),
    /// What an interpolation, by catalog name, makes of the ends.
    Method(&'static str),
}

/// What the threads have to say.
#[derive(Debug)]
pub enum Answer {
    /// A sphere, coarse or fine.
    Picture(Card, Picture),
    /// How a sphere compares with the linear mix; none where the light is too noisy to tell.
    Figures(Card, Option<Figures>),
    /// A sphere has to wait for its path.
    Pending(Card),
    /// There is no such sphere.
    Failed(Card, String),
    /// One point of a film strip.
    Frame(Card, usize, Picture),
    /// The request of this number is shown in full.
    Done(u64),
    /// Which path is being prepared, if any.
    Preparing(Option<&'static str>),
    /// A small picture of a material.
    Thumbnail(String, Picture),
    /// Names of materials read from a file.
    Opened(Vec<String>),
    /// A map was read: all maps by name, and which of them it is.
    Surround(Vec<String>, usize),
    /// Something to tell the user.
    Notice(String),
}

/// The threads.
pub struct Worker {
    requests: Arc<Mailbox<(u64, Request)>>,
    wants: Arc<Mailbox<Vec<paths::Key>>>,
    files: mpsc::Sender<PathBuf>,
    answers: mpsc::Receiver<Answer>,
    office: Office,
    number: u64,
}

/// A map that spheres can stand in.
struct Map {
    name: String,
    /// Its file; none for the built-in one.
    file: Option<PathBuf>,
    environment: Environment,
}

/// What all threads share.
#[derive(Clone)]
struct Office {
    stock: Arc<Stock>,
    materials: Arc<RwLock<Vec<Material>>>,
    maps: Arc<RwLock<Vec<Map>>>,
    plates: Plates,
    paths: Arc<Paths>,
    requests: Arc<Mailbox<(u64, Request)>>,
    wants: Arc<Mailbox<Vec<paths::Key>>>,
    answers: mpsc::Sender<Answer>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl Worker {
    /// Starts the threads; `wake` is called from them whenever an answer waits.
    pub fn start(stock: Stock, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let (sender, answers) = mpsc::channel();
        let (files, opened) = mpsc::channel();
        let office = Office {
            materials: Arc::new(RwLock::new(stock.materials.clone())),
            maps: Arc::new(RwLock::new(vec![Map {
                name: "Soft boxes".to_owned(),
                file: None,
                environment: Environment::softboxes(),
            }])),
            plates: Plates::default(),
            stock: Arc::new(stock),
            paths: Arc::default(),
            requests: Arc::default(),
            wants: Arc::default(),
            answers: sender,
            wake: Arc::new(wake),
        };
        let (requests, wants) = (Arc::clone(&office.requests), Arc::clone(&office.wants));
        let [for_paths, for_studio, for_shelf] = [office.clone(), office.clone(), office.clone()];
        std::thread::spawn(move || paths::run(&for_paths));
        std::thread::spawn(move || studio::run(for_studio));
        std::thread::spawn(move || shelf::run(&for_shelf, &opened));
        Self { requests, wants, files, answers, office, number: 0 }
    }

    /// Asks for spheres; replaces what was asked before. The number comes back in [`Answer::Done`].
    pub fn show(&mut self, request: Request) -> u64 {
        self.number += 1;
        self.requests.put((self.number, request));
        self.number
    }

    /// Where buffers of pictures go back to once they are shown.
    pub fn plates(&self) -> Plates {
        self.office.plates.clone()
    }

    /// What to do with something that went wrong elsewhere: it becomes a notice.
    pub fn complaints(&self) -> impl Fn(String) + Send + 'static {
        let office = self.office.clone();
        move |why| office.say(Answer::Notice(why))
    }

    /// Asks to read the materials of a file, a folder or an archive, or an environment map.
    pub fn open(&self, path: PathBuf) {
        // The thread outlives the sender, unless the process is about to end.
        let _ = self.files.send(path);
    }

    /// What the threads said since the last call.
    pub fn answers(&self) -> impl Iterator<Item = Answer> {
        self.answers.try_iter()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.requests.close();
        self.wants.close();
    }
}

impl Office {
    fn say(&self, answer: Answer) {
        // Nobody listens once the window is closed.
        let _ = self.answers.send(answer);
        (self.wake)();
    }

    /// Adds a map, or puts it in the place of an earlier one of the same file: maps are large. The names of all, and its
    /// place.
    fn surround_with(&self, map: Map) -> (Vec<String>, usize) {
        let mut maps = self.maps.write().unwrap_or_else(PoisonError::into_inner);
        let place = maps.iter().position(|known| known.file == map.file).unwrap_or(maps.len());
        match maps.get_mut(place) {
            Some(known) => *known = map,
            None => maps.push(map),
        }
        (maps.iter().map(|map| map.name.clone()).collect(), place)
    }

    /// The map in this place; the built-in one where there is none.
    fn map(&self, place: usize) -> Environment {
        let maps = self.maps.read().unwrap_or_else(PoisonError::into_inner);
        maps.get(place).map_or_else(Environment::softboxes, |map| map.environment.clone())
    }

    fn material(&self, name: &str) -> Option<Material> {
        let materials = self.materials.read().unwrap_or_else(PoisonError::into_inner);
        materials.iter().find(|material| material.name == name).cloned()
    }
}

/// Runs a job; a panic becomes a message, so that it does not take the window down.
fn guarded<T>(what: &str, job: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(job)).map_err(|panic| {
        let said = panic.downcast_ref::<String>().map(String::as_str);
        let said = said.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        format!("{what} failed unexpectedly: {said}")
    })
}
