//! All panes, and what passes between them and the worker.

mod act;
mod ask;

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use egui::{CentralPanel, Context, Frame, Key, Margin, Panel, Popup, Ui};

use super::action::Action;
use super::exports::{Exports, Wish};
use super::header::Header;
use super::history::History;
use super::notices::Notices;
use super::palette::{Choice, Palette};
use super::pane::{Desk, Pane, Wanted};
use super::shelf::{Errand, Opener};
use super::status::Status;
use super::store::{Saved, Store};
use super::{Gallery, Layout, Session, drag, help, look};
use crate::worker::export;
use crate::worker::scene::News;
use crate::worker::{Answer, Inquiry, Lighting, MapRequest, Probe, Question, Request, Shape, Stock, Worker};

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
    passing: Passing,
}

/// What nobody wants back after a restart.
#[derive(Default)]
struct Passing {
    palette: Option<Palette>,
    is_helping: bool,
    is_searching: bool,
    /// Whether a text had the focus in the last frame: Esc takes it away before anything else is asked.
    was_typing: bool,
    exports: Option<Exports>,
    opener: Opener,
    errands: Vec<Errand>,
}

impl Workbench {
    /// With these materials and methods; the worker starts at once.
    pub fn new(stock: Stock, session: Session) -> Self {
        let context: Arc<OnceLock<Context>> = Arc::default();
        let names = stock.materials.iter().map(|material| material.name.clone()).collect();
        let window = Arc::clone(&context);
        let wake = move || window.get().into_iter().for_each(Context::request_repaint);
        let worker = Worker::start(stock, wake);
        let mut gallery = Gallery::of(names, worker.plates());
        gallery.is_reopened = session.files.is_empty();
        if !gallery.is_reopened {
            worker.reopen(session.files.clone());
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
            Answer::Surround(_, map) => {
                self.session.look.scenery.lighting = Lighting::Around { map: *map, turn: 0.0 };
            }
            Answer::Solid(_, place) => self.session.look.show_on(Shape::Mesh(*place)),
            Answer::Kept(path, _) if !self.session.files.contains(path) => self.session.files.push(path.clone()),
            Answer::Lost(path) => self.session.files.retain(|file| file != path),
            Answer::Scene(News::Named(path)) => {
                self.session.scene.open_file(path.clone());
                self.bring(Pane::Scene);
            }
            Answer::Export(export::News::Code(code)) => context.copy_text(code.clone()),
            _ => {}
        }
        self.gallery.take(context, answer);
    }

    fn inputs(&mut self, ui: &Ui) {
        let (seconds, dropped) = ui.input(|input| {
            let dropped: Vec<PathBuf> = input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect();
            (input.stable_dt.min(0.1), dropped)
        });
        self.session.blend.advance(seconds);
        if self.session.blend.playing.is_some() {
            ui.ctx().request_repaint();
        }
        dropped.into_iter().for_each(|path| self.worker.open(path));
        let is_typing = ui.ctx().text_edit_focused() || self.passing.palette.is_some();
        if !is_typing && let Some(text) = pasted(ui) {
            self.worker.open_code(text);
        }
        // An open palette has the keyboard for itself.
        if self.passing.palette.is_none() {
            Action::pressed(ui.ctx()).into_iter().for_each(|action| self.act(action, ui.ctx()));
            self.escape(ui.ctx());
        }
    }

    /// Esc closes what is in front: popups and texts by themselves, then the help, then what is explored.
    fn escape(&mut self, context: &Context) {
        let is_others = self.passing.was_typing || self.passing.exports.is_some() || Popup::is_any_open(context);
        if is_others || !context.input(|input| input.key_pressed(Key::Escape)) {
            return;
        }
        if self.passing.is_helping {
            self.passing.is_helping = false;
        } else {
            self.act(Action::Leave, context);
        }
    }

    /// Brings a pane to the front of its stack.
    pub fn bring(&mut self, pane: Pane) {
        self.layout.iter_mut().for_each(|layout| layout.bring(pane));
    }

    fn panels(&mut self, ui: &mut Ui) -> Wanted {
        let fill = ui.visuals().panel_fill;
        let frame = |x: i8, y: i8| Frame::new().fill(fill).inner_margin(Margin::symmetric(x, y));
        let (is_settled, is_around, ways) = (self.is_settled(), self.session.look.is_around(), self.history.ways());
        let asked = Panel::top("header")
            .exact_size(44.0)
            .frame(frame(14, 0))
            .show(ui, |ui| Header { session: &mut self.session, ways }.show(ui));
        asked.inner.into_iter().for_each(|action| self.act(action, ui.ctx()));
        let gallery = &mut self.gallery;
        Panel::bottom("status")
            .exact_size(24.0)
            .frame(frame(14, 0))
            .show(ui, |ui| Status { gallery, is_settled, is_around }.show(ui));
        if !gallery.notices.is_empty() {
            Panel::top("notices").frame(frame(12, 6)).show(ui, |ui| Notices { gallery }.show(ui));
        }
        let Passing { is_searching, opener, errands, .. } = &mut self.passing;
        let session = &mut self.session;
        let mut desk = Desk { session, gallery, is_searching, opener, errands, wanted: Wanted::default() };
        CentralPanel::default().frame(Frame::new().fill(fill)).show(ui, |ui| {
            let layout = self.layout.get_or_insert_with(|| Layout::of(ui.available_width()));
            layout.show(ui, &mut desk);
        });
        let wanted = desk.wanted;
        self.run_errands();
        wanted
    }

    /// What the library asked for.
    fn run_errands(&mut self) {
        for errand in self.passing.errands.drain(..) {
            match errand {
                Errand::Choose => self.worker.choose(),
                Errand::Open(path) => self.worker.open(path),
                Errand::Cancel(job) => self.worker.cancel(job),
            }
        }
    }

    fn overlays(&mut self, context: &Context) {
        if let Some(palette) = &mut self.passing.palette {
            let (stays, choice) = palette.show(context, &self.session, &self.gallery.names);
            if !stays {
                self.passing.palette = None;
            }
            match choice {
                Some(Choice::Do(action)) => self.act(action, context),
                Some(Choice::Go(pane)) => self.bring(pane),
                Some(Choice::Load(place)) => self.session.load_blend(place),
                Some(Choice::Put(end, name)) => self.session.blend.choose(end, &name),
                None => {}
            }
        }
        if let Some(exports) = &mut self.passing.exports {
            let (stays, wish) = exports.show(context, &mut self.session, &self.gallery);
            if !stays {
                self.passing.exports = None;
            }
            match wish {
                Some(Wish::Look(files)) => self.worker.look_for(files),
                Some(Wish::Write(job)) => {
                    self.gallery.files.progress = Some(0.0);
                    self.worker.write(*job);
                }
                Some(Wish::Stop) => self.worker.stop_writing(),
                None => {}
            }
        }
        if self.passing.is_helping {
            self.passing.is_helping = help::show(context);
        }
        drag::show(context, &self.gallery);
    }

    /// For undo, and for the next start.
    fn remember(&mut self, context: &Context) {
        // A turn of the wheel, a pinch and a key that is held are one step each, too.
        let is_moving = context.input(|input| {
            let is_turned = input.is_scrolling() || input.zoom_delta() != 1.0;
            input.pointer.any_down() || is_turned || !input.keys_down.is_empty()
        });
        self.passing.was_typing = context.text_edit_focused();
        let is_busy = is_moving || self.passing.was_typing;
        self.history.watch(&self.session, !is_busy);
        if let Some(store) = &mut self.store {
            let size = context.content_rect().size();
            let rest = store.keep(&self.session, self.layout.as_ref(), Some([size.x, size.y]));
            rest.into_iter().for_each(|rest| context.request_repaint_after(rest));
        }
    }
}

/// Text that was pasted in this frame.
fn pasted(ui: &Ui) -> Option<String> {
    let text = |event: &egui::Event| if let egui::Event::Paste(text) = event { Some(text.clone()) } else { None };
    ui.input(|input| input.events.iter().find_map(text))
}
