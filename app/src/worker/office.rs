//! What all threads share.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, OnceLock, mpsc};

use nbrdf_core::Material;
use nbrdf_core::render::{Environment, Model};
use nbrdf_core::scene::Mesh;

use super::activity::Activity;
use super::assets::Assets;
use super::materials::{Added, Materials};
use super::paths::{self, Paths};
use super::{
    Answer, Asset, Inquiry, Mailbox, MapRequest, Plates, Question, Request, Shape, Stock, edits, guarded, map, point,
};
use crate::editor::Editor;

/// Names of the built-in map and the built-in mesh.
pub const BUILT_IN: [&str; 2] = ["Soft boxes", "Knot"];

/// What all threads share.
#[derive(Clone)]
pub(super) struct Office {
    pub stock: Arc<Stock>,
    pub materials: Arc<Materials>,
    pub maps: Arc<Assets<Environment>>,
    pub meshes: Arc<Assets<Arc<Mesh>>>,
    /// How often something that was known came to be something else.
    arrived: Arc<AtomicU64>,
    pub activity: Activity,
    pub plates: Plates,
    pub paths: Arc<Paths>,
    pub points: Arc<point::Points>,
    pub requests: Arc<Mailbox<(u64, Request)>>,
    pub wants: Arc<Mailbox<Vec<paths::Key>>>,
    pub questions: Arc<Mailbox<Question>>,
    pub charts: Arc<Mailbox<Option<Arc<[String]>>>>,
    pub map_requests: Arc<Mailbox<MapRequest>>,
    pub sheets: Arc<map::Sheets>,
    pub changes: Arc<Mailbox<Vec<edits::Want>>>,
    /// Whether qualities are asked for where nothing is edited, too.
    pub is_measured: Arc<AtomicBool>,
    /// What was edited last.
    pub found: Arc<edits::Found>,
    /// Made when first asked for; none where it cannot be.
    editor: Arc<OnceLock<Option<Editor>>>,
    pub inquiries: Arc<Mailbox<Inquiry>>,
    answers: mpsc::Sender<Answer>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl Office {
    /// Nothing is asked for yet; `wake` is called whenever an answer waits.
    pub fn new(stock: Stock, answers: mpsc::Sender<Answer>, wake: impl Fn() + Send + Sync + 'static) -> Self {
        let [map, mesh] = BUILT_IN;
        Self {
            materials: Arc::new(Materials::new(stock.materials.clone())),
            maps: Arc::new(Assets::new(map, Environment::softboxes())),
            meshes: Arc::new(Assets::new(mesh, Arc::new(Mesh::knot()))),
            arrived: Arc::default(),
            activity: Activity::default(),
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
            is_measured: Arc::default(),
            found: Arc::default(),
            editor: Arc::default(),
            inquiries: Arc::default(),
            answers,
            wake: Arc::new(wake),
        }
    }

    /// Tells the window something.
    pub fn say(&self, answer: Answer) {
        // Nobody listens once the window is closed.
        let _ = self.answers.send(answer);
        (self.wake)();
    }

    /// Ends all threads as soon as each can.
    pub fn close(&self) {
        self.activity.end();
        self.requests.close();
        self.wants.close();
        self.points.close();
        self.questions.close();
        self.charts.close();
        self.map_requests.close();
        self.changes.close();
        self.inquiries.close();
    }

    /// Changes whenever a map, a mesh or a material that was known becomes another: whatever was kept by its name or file is
    /// out of date then.
    pub fn arrivals(&self) -> u64 {
        self.arrived.load(Ordering::Acquire)
    }

    /// A map or a mesh has come.
    pub fn arrive(&self) {
        self.arrived.fetch_add(1, Ordering::Release);
    }

    /// Adds the materials of a file, in place of those it gave before.
    pub fn put(&self, file: &Path, materials: Vec<Material>) -> Vec<Material> {
        let Added { materials, changed } = self.materials.put(file, materials);
        if !changed.is_empty() {
            // Before, so that paths that are being prepared are not kept; after, so that nothing that was made of an old path
            // counts as new.
            self.arrive();
            self.paths.forget(&changed);
            self.arrive();
        }
        materials
    }

    /// What edits qualities, if it can be made.
    pub fn editor(&self) -> Option<&Editor> {
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

    /// A map; the built-in one while its file is missing.
    pub fn map(&self, asset: Asset) -> Environment {
        self.maps.get(asset).1
    }

    /// What is seen of a shape; the built-in mesh while its file is missing.
    pub fn model(&self, shape: Shape) -> Model {
        match shape {
            Shape::Sphere => Model::Sphere,
            Shape::Plane => Model::Plane,
            Shape::Mesh(asset) => Model::Mesh(self.meshes.get(asset).1),
        }
    }

    /// The material of this name.
    pub fn material(&self, name: &str) -> Option<Material> {
        self.materials.get(name)
    }
}

/// A path that means the same wherever the next session is started from.
pub(super) fn whole(path: PathBuf) -> PathBuf {
    std::path::absolute(&path).unwrap_or(path)
}
