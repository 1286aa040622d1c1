//! All panes, and what passes between them and the worker.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use egui::{CentralPanel, Context, Frame, Margin, Panel, ThemePreference, Ui};

use super::action::Action;
use super::header::Header;
use super::help;
use super::history::History;
use super::notices::Notices;
use super::palette::{Choice, Palette};
use super::pane::{Desk, Wanted};
use super::session::MAX_EXPOSURE;
use super::status::Status;
use super::store::{Saved, Store};
use super::{Gallery, Layout, Session, look};
use crate::worker::{Answer, Lighting, Request, Stock, Timing, Worker};

/// Largest picture of a sphere in pixels; beyond, it is enlarged.
const MOST_PIXELS: usize = 640;

/// The whole app but its window.
pub struct Workbench {
    /// What the user chose.
    pub session: Session,
    /// Where the panes are.
    pub layout: Layout,
    /// What the worker answered.
    pub gallery: Gallery,
    history: History,
    store: Option<Store>,
    worker: Worker,
    context: Arc<OnceLock<Context>>,
    asked: Option<(u64, Request)>,
    passing: Passing,
}

/// What nobody wants back after a restart.
#[derive(Default)]
struct Passing {
    palette: Option<Palette>,
    is_helping: bool,
    is_searching: bool,
}

impl Workbench {
    /// With these materials and methods; the worker starts at once.
    pub fn new(stock: Stock, session: Session) -> Self {
        let context: Arc<OnceLock<Context>> = Arc::default();
        let names = stock.materials.iter().map(|material| material.name.clone()).collect();
        let window = Arc::clone(&context);
        let wake = move || window.get().into_iter().for_each(Context::request_repaint);
        let worker = Worker::start(stock, wake);
        Self {
            history: History::new(&session),
            gallery: Gallery::of(names, worker.plates()),
            layout: Layout::default(),
            store: None,
            passing: Passing::default(),
            asked: None,
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

    /// Adds the materials of a file.
    pub fn open(&self, path: PathBuf) {
        self.worker.open(path);
    }

    /// Whether everything asked for is on the screen.
    pub fn is_settled(&self) -> bool {
        self.asked.as_ref().is_some_and(|(number, _)| *number == self.gallery.done)
    }

    /// Writes the session a last time, where it is kept.
    pub fn finish(&mut self, window: Option<[f32; 2]>) {
        if let Some(mut store) = self.store.take() {
            store.finish(Saved::new(&self.session, &self.layout, window));
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
        for answer in self.worker.answers() {
            // Whoever opens a map wants to see it.
            if let Answer::Surround(_, map) = &answer {
                self.session.look.scenery.lighting = Lighting::Around { map: *map, turn: 0.0 };
            }
            self.gallery.take(ui.ctx(), answer);
        }
        self.inputs(ui);
        let theme = self.session.theme;
        let wanted = self.panels(ui);
        self.overlays(ui.ctx());
        if self.session.theme != theme {
            ui.ctx().set_theme(self.session.theme);
        }
        self.ask(wanted, ui.pixels_per_point());
        self.remember(ui.ctx());
    }

    fn inputs(&mut self, ui: &Ui) {
        let (seconds, dropped) = ui.input(|input| {
            let dropped: Vec<PathBuf> = input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect();
            (input.stable_dt.min(0.1), dropped)
        });
        self.session.blend.advance(seconds);
        dropped.into_iter().for_each(|path| self.worker.open(path));
        // An open palette has the keyboard for itself.
        if self.passing.palette.is_none() {
            Action::pressed(ui.ctx()).into_iter().for_each(|action| self.act(action, ui.ctx()));
        }
    }

    /// Does something that was asked for by key, by button or by name.
    pub fn act(&mut self, action: Action, context: &Context) {
        let Session { blend, look, .. } = &mut self.session;
        match action {
            Action::Palette => self.passing.palette = Some(Palette::default()),
            Action::Help => self.passing.is_helping = !self.passing.is_helping,
            Action::Undo => self.history.undo(&mut self.session),
            Action::Redo => self.history.redo(&mut self.session),
            Action::Search => {
                self.layout.bring(super::pane::Pane::Library);
                self.passing.is_searching = true;
            }
            Action::Play => blend.toggle_play(),
            Action::Swap => blend.swap(),
            Action::Beyond => {
                blend.is_beyond = !blend.is_beyond;
                blend.go_to(blend.t);
            }
            Action::Timing if blend.timing == Timing::Even => blend.timing = Timing::Straight,
            Action::Timing => blend.timing = Timing::Even,
            Action::Reset => self.session.reset(),
            Action::Brighter => look.exposure = (look.exposure + 0.5).min(MAX_EXPOSURE),
            Action::Darker => look.exposure = (look.exposure - 0.5).max(-MAX_EXPOSURE),
            Action::Light => look.next_light(self.gallery.maps.len()),
            Action::Strips => self.session.strips = !self.session.strips,
            Action::Theme => {
                let is_dark = context.theme() == egui::Theme::Dark;
                self.session.theme = if is_dark { ThemePreference::Light } else { ThemePreference::Dark };
            }
            Action::Arrange => self.layout = Layout::default(),
        }
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
        let is_searching = &mut self.passing.is_searching;
        let mut desk = Desk { session: &mut self.session, gallery, is_searching, wanted: Wanted::default() };
        CentralPanel::default().frame(Frame::new().fill(fill)).show(ui, |ui| self.layout.show(ui, &mut desk));
        desk.wanted
    }

    fn overlays(&mut self, context: &Context) {
        if let Some(palette) = &mut self.passing.palette {
            let (stays, choice) = palette.show(context, &self.session, &self.gallery.names);
            if !stays {
                self.passing.palette = None;
            }
            match choice {
                Some(Choice::Do(action)) => self.act(action, context),
                Some(Choice::Go(pane)) => self.layout.bring(pane),
                Some(Choice::Put(end, name)) => self.session.blend.choose(end, &name),
                None => {}
            }
        }
        if self.passing.is_helping {
            self.passing.is_helping = help::show(context);
        }
    }

    /// Asks for what is now to be seen, if that is news.
    fn ask(&mut self, wanted: Wanted, pixels_per_point: f32) {
        let pixels = |points: f32| (points * pixels_per_point).round() as usize;
        let Session { blend, look, methods, .. } = &self.session;
        let request = Request {
            // The same list as before costs nothing to compare and to share.
            ends: match &self.asked {
                Some((_, before)) if *before.ends == *blend.ends => Arc::clone(&before.ends),
                _ => blend.ends.as_slice().into(),
            },
            weights: blend.weights(),
            timing: blend.timing,
            methods: methods.0.clone(),
            scenery: look.scenery,
            exposure: look.exposure,
            size: pixels(wanted.side).clamp(16, MOST_PIXELS),
            strip: pixels(wanted.frame).min(128),
        };
        if self.asked.as_ref().is_none_or(|(_, before)| *before != request) {
            let number = self.worker.show(request.clone());
            self.asked = Some((number, request));
        }
    }

    /// For undo, and for the next start.
    fn remember(&mut self, context: &Context) {
        let is_busy = context.input(|input| input.pointer.any_down()) || context.text_edit_focused();
        self.history.watch(&self.session, !is_busy);
        if let Some(store) = &mut self.store {
            let size = context.content_rect().size();
            store.keep(&self.session, &self.layout, Some([size.x, size.y]));
        }
    }
}
