//! Long work off the UI thread: prepares paths, renders spheres, compares them, reads and writes files.
//!
//! A thread for each kind of work. Where only the newest request matters, it waits in a mailbox and replaces older ones:
//! *paths* encodes materials and learns bases; *edits* moves qualities of points on them; *studio* renders, coarse first and
//! fine when nothing newer came; *point* evaluates at one place; *curves* works out figures; *chart* measures all
//! representations; *map* lays codes out in a plane; *properties* measures what lists are sorted by; *scene* plans scenes.
//! In order: *files* reads what is opened, *fitting* fits networks to measurements, *thumbnails* makes small pictures,
//! *export* writes. Nothing here knows a window: answers wait in a channel, and `wake` says that they do.

mod background;
mod cache;
mod chart;
mod curves;
mod dialog;
mod difference;
mod edits;
pub mod export;
mod figures;
mod files;
mod films;
mod fits;
mod fitting;
mod here;
mod mailbox;
mod map;
mod paths;
mod picture;
mod plates;
mod point;
mod properties;
mod request;
pub mod scene;
mod sets;
mod spheres;
mod stock;
mod strips;
mod studio;
mod surround;
mod thumbnails;
mod walk;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, OnceLock, PoisonError, RwLock, mpsc};

use nbrdf_core::Material;
use nbrdf_core::render::{Environment, Model};
use nbrdf_core::scene::Mesh;

pub use background::prepare;
pub use cache::Cache;
pub use chart::{ChartNews, Rival};
pub use curves::{Along, Findings, Found, Place, Price, Profile, Question, Told, Topic};
pub use difference::Difference;
pub use edits::Measured;
pub use figures::Figures;
pub use fits::Job;
pub(crate) use mailbox::Mailbox;
pub use map::{Course, Explored, MapAnswer, MapRequest, Projection, Spot, Track};
pub use picture::Picture;
pub use plates::Plates;
pub use point::{Incidence, Point, Probe, Reading};
pub use properties::{Inquiry, Property};
pub use request::{Closeup, Lighting, Request, Scale, Scenery, Shape, Timing};
pub use stock::Stock;
pub use walk::{Edits, Tour, Walk};

use files::{Desk, Letter};
use fits::Fits;
use paths::Paths;

use crate::editor::Editor;

/// One sphere of the comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Card {
    /// The material at this end.
    End(usize),
    /// What an interpolation, by catalog name, makes of the ends.
    Method(&'static str),
    /// What is at a place of the latent map.
    Explored,
}

/// What the threads have to say.
#[derive(Debug)]
pub enum Answer {
    /// A sphere, coarse or fine.
    Picture(Card, Picture),
    /// How a sphere compares with the linear mix; none where the light is too noisy to tell.
    Figures(Card, Option<Figures>),
    /// Qualities of the point a sphere shows; none where they cannot be told.
    Measured(Card, Option<Measured>),
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
    /// A file was read, and gave these materials; a map or a mesh gives none.
    Kept(PathBuf, Vec<String>),
    /// A file gave nothing, or its fit was cancelled.
    Lost(PathBuf),
    /// All files of the last session were read, or wait to be fitted.
    Reopened,
    /// A map of the last session was read: all maps by name.
    Maps(Vec<String>),
    /// All fits that run or wait.
    Jobs(Vec<Job>),
    /// Something that a list can be sorted by.
    Property(String, Property),
    /// The system's dialog for files was closed, or cannot be shown, for this reason.
    Dialog(Option<String>),
    /// A map was read: all maps by name, and which of them it is.
    Surround(Vec<String>, usize),
    /// How two spheres differ, pixel by pixel.
    Difference(Difference),
    /// Directions and values at one place of the spheres.
    Point(Point),
    /// A figure, coarse or fine.
    Findings(Box<Findings>),
    /// How far the chart of all representations has come.
    Chart(Box<ChartNews>),
    /// The latent map.
    Map(MapAnswer),
    /// Something about the scene that is planned.
    Scene(scene::News),
    /// Of files that are written.
    Export(export::News),
    /// A mesh was read: all meshes by name, and which of them it is.
    Solid(Vec<String>, usize),
    /// A mesh of the last session was read: all meshes by name.
    Solids(Vec<String>),
    /// Something to tell the user.
    Notice(String),
}

/// The threads.
pub struct Worker {
    files: mpsc::Sender<Letter>,
    orders: mpsc::Sender<export::Order>,
    /// Whether writing is to end.
    stop: Arc<AtomicBool>,
    fits: Arc<Fits>,
    is_choosing: Arc<AtomicBool>,
    answers: mpsc::Receiver<Answer>,
    scenes: scene::Scenes,
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

/// A mesh that materials can be seen on.
struct Solid {
    name: String,
    /// Its file; none for the built-in one.
    file: Option<PathBuf>,
    mesh: Arc<Mesh>,
}

/// What all threads share.
#[derive(Clone)]
struct Office {
    stock: Arc<Stock>,
    materials: Arc<RwLock<Vec<Material>>>,
    maps: Arc<RwLock<Vec<Map>>>,
    solids: Arc<RwLock<Vec<Solid>>>,
    /// How many maps and meshes were read, so that their places show something else than before.
    arrived: Arc<AtomicU64>,
    plates: Plates,
    paths: Arc<Paths>,
    points: Arc<point::Points>,
    requests: Arc<Mailbox<(u64, Request)>>,
    wants: Arc<Mailbox<Vec<paths::Key>>>,
    questions: Arc<Mailbox<Question>>,
    charts: Arc<Mailbox<Option<Arc<[String]>>>>,
    map_requests: Arc<Mailbox<MapRequest>>,
    sheets: Arc<map::Sheets>,
    changes: Arc<Mailbox<Vec<edits::Want>>>,
    /// What was edited last.
    found: Arc<edits::Found>,
    /// Made when first asked for; none where it cannot be.
    editor: Arc<OnceLock<Option<Editor>>>,
    inquiries: Arc<Mailbox<Inquiry>>,
    answers: mpsc::Sender<Answer>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl Worker {
    /// Starts the threads; `wake` is called from them whenever an answer waits.
    pub fn start(stock: Stock, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let (sender, answers) = mpsc::channel();
        let (orders, ordered) = mpsc::channel();
        let stop: Arc<AtomicBool> = Arc::default();
        let (files, letters) = mpsc::channel();
        let (thumbnails, materials) = mpsc::channel();
        let office = Office {
            materials: Arc::new(RwLock::new(stock.materials.clone())),
            maps: Arc::new(RwLock::new(vec![Map {
                name: "Soft boxes".to_owned(),
                file: None,
                environment: Environment::softboxes(),
            }])),
            solids: Arc::new(RwLock::new(vec![Solid {
                name: "Knot".to_owned(),
                file: None,
                mesh: Arc::new(Mesh::knot()),
            }])),
            arrived: Arc::default(),
            plates: Plates::default(),
            stock: Arc::new(stock),
            paths: Arc::default(),
            points: Arc::default(),
            requests: Arc::default(),
            wants: Arc::default(),
            questions: Arc::default(),
            charts: Arc::default(),
            map_requests: Arc::default(),
            sheets: Arc::default(),
            changes: Arc::default(),
            found: Arc::default(),
            editor: Arc::default(),
            inquiries: Arc::default(),
            answers: sender,
            wake: Arc::new(wake),
        };
        let works: [fn(&Office); 8] =
            [paths::run, edits::run, studio::run, point::run, curves::run, chart::run, map::run, properties::run];
        for work in works {
            let office = office.clone();
            background::spawn(move || work(&office));
        }
        // The receiver is here still.
        let _ = thumbnails.send(office.stock.materials.clone());
        let fits: Arc<Fits> = Arc::default();
        let desk = Desk { office: office.clone(), fits: Arc::clone(&fits), thumbnails };
        let for_fitting = desk.clone();
        let [for_thumbnails, for_scenes, for_export] = std::array::from_fn(|_| office.clone());
        let (scenes, may_stop) = (scene::Scenes::default(), Arc::clone(&stop));
        let wishes = Arc::clone(&scenes.letters);
        background::spawn(move || files::run(&desk, &letters));
        background::spawn(move || fitting::run(&for_fitting));
        background::spawn(move || thumbnails::run(&for_thumbnails, &materials));
        background::spawn(move || scene::run(&for_scenes, &wishes));
        background::spawn(move || export::run(for_export, may_stop, &ordered));
        Self { files, orders, stop, fits, is_choosing: Arc::default(), answers, scenes, office, number: 0 }
    }

    /// Asks for spheres; replaces what was asked before. The number comes back in [`Answer::Done`].
    pub fn show(&mut self, request: Request) -> u64 {
        self.number += 1;
        self.office.requests.put((self.number, request));
        self.number
    }

    /// Asks for directions and values at a place; replaces what was asked before, none asks for nothing more.
    pub fn probe(&self, probe: Option<Probe>) {
        self.office.points.put(probe);
    }

    /// Asks for a figure; replaces what was asked before.
    pub fn ask(&self, question: Question) {
        self.office.questions.put(question);
    }

    /// Asks for the chart of all representations with these materials on it, or stops the one that is being made.
    pub fn chart(&self, materials: Option<Arc<[String]>>) {
        self.office.charts.put(materials);
    }

    /// Asks for the latent map; replaces what was asked before.
    pub fn map(&self, request: MapRequest) {
        self.office.map_requests.put(request);
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

    /// Asks something about a scene; where that is news, its number, which comes back in [`scene::News::Done`].
    pub fn plan(&mut self, ask: scene::Ask, wish: Option<scene::Wish>) -> Option<u64> {
        self.scenes.ask(ask, wish)
    }

    /// Asks to read the materials of a file, a folder or an archive, an environment map, or a mesh; of a scene it only says
    /// that there is one.
    pub fn open(&self, path: PathBuf) {
        open(&self.office, &self.files, path);
    }

    /// The same of what was open when the last session ended; [`Answer::Reopened`] follows.
    pub fn reopen(&self, paths: Vec<PathBuf>) {
        let _ = self.files.send(Letter::Reopen(paths));
    }

    /// Shows the system's dialog and opens what is chosen; [`Answer::Dialog`] follows. Nothing while one is shown.
    pub fn choose(&self) {
        if self.is_choosing.swap(true, Ordering::Relaxed) {
            return;
        }
        let (office, files, is_choosing) = (self.office.clone(), self.files.clone(), Arc::clone(&self.is_choosing));
        std::thread::spawn(move || {
            let chosen = guarded("The dialog for files", || (office.stock.dialog)()).flatten();
            is_choosing.store(false, Ordering::Relaxed);
            let why = chosen.map(|paths| paths.into_iter().for_each(|path| open(&office, &files, path)));
            office.say(Answer::Dialog(why.err()));
        });
    }

    /// Ends a fit, or takes it out of the queue.
    pub fn cancel(&self, job: u64) {
        let Some(path) = self.fits.remove(job) else { return };
        self.office.say(Answer::Jobs(self.fits.shown()));
        self.office.say(Answer::Lost(path));
    }

    /// Asks for something of every material; replaces what was asked before. [`Answer::Property`] follows for each.
    pub fn inquire(&self, inquiry: Inquiry) {
        self.office.inquiries.put(inquiry);
    }

    /// Asks which of these files are there.
    pub fn look_for(&self, files: Vec<PathBuf>) {
        let _ = self.orders.send(export::Order::Look(files));
    }

    /// Asks to write files.
    pub fn write(&self, job: export::Job) {
        self.stop.store(false, Ordering::Relaxed);
        let _ = self.orders.send(export::Order::Write(Box::new(job)));
    }

    /// Asks to give up what is being written.
    pub fn stop_writing(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Asks for the code of the point that a request shows.
    pub fn code(&self, request: Request) {
        let _ = self.orders.send(export::Order::Code(Box::new(request)));
    }

    /// Asks to read a code as a material.
    pub fn open_code(&self, text: String) {
        let _ = self.files.send(Letter::Paste(text));
    }

    /// What the threads said since the last call.
    pub fn answers(&self) -> impl Iterator<Item = Answer> {
        self.answers.try_iter()
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.office.requests.close();
        self.office.wants.close();
        self.office.points.close();
        self.office.questions.close();
        self.office.charts.close();
        self.office.map_requests.close();
        self.office.changes.close();
        self.stop_writing();
        self.office.inquiries.close();
        self.fits.close();
    }
}

/// Sends a file to who reads it.
fn open(office: &Office, files: &mpsc::Sender<Letter>, path: PathBuf) {
    let path = whole(path);
    if scene::is_scene(&path) {
        return office.say(Answer::Scene(scene::News::Named(path)));
    }
    // The thread outlives the sender, unless the process is about to end.
    let _ = files.send(Letter::Open(path));
}

/// A path that means the same wherever the next session is started from.
fn whole(path: PathBuf) -> PathBuf {
    std::path::absolute(&path).unwrap_or(path)
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
        self.arrived.fetch_add(1, Ordering::Release);
        (maps.iter().map(|map| map.name.clone()).collect(), place)
    }

    /// The map in this place; the built-in one where there is none.
    fn map(&self, place: usize) -> Environment {
        let maps = self.maps.read().unwrap_or_else(PoisonError::into_inner);
        maps.get(place).map_or_else(Environment::softboxes, |map| map.environment.clone())
    }

    /// What edits qualities, if it can be made.
    fn editor(&self) -> Option<&Editor> {
        let made = self.editor.get_or_init(|| match guarded("Editing", || (self.stock.editor)()) {
            Ok(Ok(editor)) => Some(editor),
            Ok(Err(error)) => {
                self.say(Answer::Notice(format!("{error:#}")));
                None
            }
            Err(why) => {
                self.say(Answer::Notice(why));
                None
            }
        });
        made.as_ref()
    }

    /// Adds a mesh, or puts it in the place of an earlier one of the same file. The names of all, and its place.
    fn show_on(&self, solid: Solid) -> (Vec<String>, usize) {
        let mut solids = self.solids.write().unwrap_or_else(PoisonError::into_inner);
        let place = solids.iter().position(|known| known.file == solid.file).unwrap_or(solids.len());
        match solids.get_mut(place) {
            Some(known) => *known = solid,
            None => solids.push(solid),
        }
        self.arrived.fetch_add(1, Ordering::Release);
        (solids.iter().map(|solid| solid.name.clone()).collect(), place)
    }

    /// What is seen of a shape; the built-in mesh where there is none in its place.
    fn model(&self, shape: Shape) -> Model {
        let place = match shape {
            Shape::Sphere => return Model::Sphere,
            Shape::Plane => return Model::Plane,
            Shape::Mesh(place) => place,
        };
        let solids = self.solids.read().unwrap_or_else(PoisonError::into_inner);
        let solid = solids.get(place).or_else(|| solids.first());
        solid.map_or(Model::Sphere, |solid| Model::Mesh(Arc::clone(&solid.mesh)))
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
