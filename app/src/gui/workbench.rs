//! All panes, and what passes between them and the worker.

mod act;
mod ask;
mod input;
mod overlays;
mod panels;
mod passing;
mod remember;

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use egui::{Context, Ui};

use super::history::History;
use super::pane::Pane;
use super::store::{Saved, Store};
use super::{Gallery, Layout, Session, look};
use crate::worker::export;
use crate::worker::scene::News;
use crate::worker::{Answer, Inquiry, Lighting, MapRequest, Probe, Question, Request, Shape, Stock, Worker};
use passing::Passing;

/// The whole app but its window.
pub struct Workbench {
    /// What the user chose.
    pub session: Session,
    /// Where the panes are; made to the window's size where nothing is known.
    pub layout: Option<Layout>,
    /// What the worker answered.
    pub gallery: Gallery,
    history: History,
    store: Option<Store>,
    worker: Worker,
    context: Arc<OnceLock<Context>>,
    asked: Option<(u64, Request)>,
    probed: Option<Probe>,
    questioned: Option<Question>,
    asked_map: Option<MapRequest>,
    inquired: Option<Inquiry>,
    is_measured: bool,
    passing: Passing,
}

impl Workbench {
    /// With these materials and methods; the worker starts at once.
    pub fn new(stock: Stock, mut session: Session) -> Self {
        let context: Arc<OnceLock<Context>> = Arc::default();
        let names = stock.materials.iter().map(|material| material.name.clone()).collect();
        let window = Arc::clone(&context);
        let wake = move || window.get().into_iter().for_each(Context::request_repaint);
        let worker = Worker::start(stock, wake);
        let mut gallery = Gallery::of(names, worker.plates());
        let (pasted, lost) = std::mem::take(&mut session.pasted).within_bounds();
        session.pasted = pasted;
        lost.into_iter().for_each(|why| gallery.notify(why));
        let codes = session.pasted.codes();
        gallery.is_reopened = session.files.is_empty() && codes.is_empty();
        if !gallery.is_reopened {
            worker.reopen(session.files.clone(), session.origins.clone(), codes.to_vec());
        }
        Self {
            history: History::new(&session),
            layout: None,
            store: None,
            passing: Passing::default(),
            asked: None,
            probed: None,
            questioned: None,
            asked_map: None,
            inquired: None,
            is_measured: false,
            gallery,
            session,
            worker,
            context,
        }
    }

    /// Keeps the session in this file from now on.
    #[must_use]
    pub fn keeping(mut self, file: PathBuf) -> Self {
        let complain = self.worker.complaints();
        self.store = Some(Store::new(file, complain));
        self
    }

    /// Adds the materials of a file, unless it is one of the last session's, or plans the scene in it.
    pub fn open(&self, path: PathBuf) {
        let is_known = std::path::absolute(&path).is_ok_and(|path| self.session.files.contains(&path));
        if !is_known {
            self.worker.open(path);
        }
    }

    /// Whether everything asked for is on the screen.
    pub fn is_settled(&self) -> bool {
        self.asked.as_ref().is_some_and(|(number, _)| *number == self.gallery.done)
    }

    /// Writes the session a last time, where it is kept.
    pub fn finish(&mut self, window: Option<[f32; 2]>) {
        if let Some(mut store) = self.store.take() {
            store.finish(Saved::new(&self.session, self.layout.as_ref(), window));
        }
    }

    /// One frame.
    pub fn ui(&mut self, ui: &mut Ui) {
        if self.context.set(ui.ctx().clone()).is_ok() {
            look::install(ui.ctx());
            ui.ctx().set_theme(self.session.theme);
            // What was answered before there was anything to wake.
            ui.ctx().request_repaint();
        }
        let answers: Vec<Answer> = self.worker.answers().collect();
        answers.into_iter().for_each(|answer| self.take(ui.ctx(), answer));
        let theme = self.session.theme;
        self.inputs(ui);
        let had_point = self.session.pick.at.is_some();
        let wanted = self.panels(ui);
        if self.session.pick.at.is_some() && !had_point {
            self.bring(Pane::Point);
        }
        self.overlays(ui.ctx());
        if self.session.theme != theme {
            ui.ctx().set_theme(self.session.theme);
        }
        self.question(&wanted);
        self.ask(&wanted, ui.pixels_per_point());
        self.remember(ui.ctx());
    }

    /// What an answer changes of the session, and what it shows.
    fn take(&mut self, context: &Context, answer: Answer) {
        match &answer {
            // Whoever opens a map wants to see it.
            Answer::Maps(_, Some(map)) => {
                self.session.look.scenery.lighting = Lighting::Around { map: *map, turn: 0.0 };
            }
            Answer::Meshes(_, Some(mesh)) => self.session.look.show_on(Shape::Mesh(*mesh)),
            Answer::Kept(path, names) => self.session.keep_file(path, names),
            Answer::Lost(path) => self.session.lose_file(path),
            Answer::Pasted(code) => {
                let kept = self.session.pasted.keep(code.clone());
                kept.err().into_iter().for_each(|why| self.gallery.notify(why));
            }
            Answer::Scene(News::Named(path)) => {
                self.session.scene.open_file(path.clone());
                self.bring(Pane::Scene);
            }
            Answer::Export(export::News::Code(code)) => context.copy_text(code.clone()),
            _ => {}
        }
        self.gallery.take(context, answer);
    }

    /// Brings a pane to the front of its stack.
    pub fn bring(&mut self, pane: Pane) {
        self.layout.iter_mut().for_each(|layout| layout.bring(pane));
    }
    /// Brings a pane to the front, and gives it the focus: Tab leads on from there.
    fn enter(&mut self, pane: Pane) {
        self.bring(pane);
        (self.passing.entered, self.passing.is_entering) = (Some(pane), true);
    }

    /// The same of the pane that lies so many after the last.
    fn enter_next(&mut self, by: usize) {
        let place = |pane: Pane| Pane::ALL.iter().position(|known| *known == pane).unwrap_or_default();
        let next = self.passing.entered.map_or(0, |pane| (place(pane) + by) % Pane::ALL.len());
        self.enter(Pane::ALL[next]);
    }
}
