//! All panels, and what passes between them and the worker.

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use egui::{CentralPanel, Context, Frame, Key, Margin, Panel, Ui};

use super::cards::Cards;
use super::controls::Controls;
use super::header::Header;
use super::notices::Notices;
use super::shelf::Shelf;
use super::status::Status;
use super::{Gallery, Session, look};
use crate::worker::{Answer, Lighting, Request, Stock, Worker};

/// Largest picture of a sphere in pixels; beyond, it is enlarged.
const MOST_PIXELS: usize = 640;

/// The whole app but its window.
pub struct Workbench {
    /// What the user chose.
    pub session: Session,
    /// What the worker answered.
    pub gallery: Gallery,
    worker: Worker,
    context: Arc<OnceLock<Context>>,
    asked: Option<(u64, Request)>,
}

impl Workbench {
    /// With these materials and methods; the worker starts at once.
    pub fn new(stock: Stock, session: Session) -> Self {
        let context: Arc<OnceLock<Context>> = Arc::default();
        let names = stock.materials.iter().map(|material| material.name.clone()).collect();
        let window = Arc::clone(&context);
        let wake = move || window.get().into_iter().for_each(Context::request_repaint);
        let worker = Worker::start(stock, wake);
        Self { session, gallery: Gallery::of(names, worker.plates()), worker, context, asked: None }
    }

    /// Adds the materials of a file.
    pub fn open(&self, path: PathBuf) {
        self.worker.open(path);
    }

    /// Whether everything asked for is on the screen.
    pub fn is_settled(&self) -> bool {
        self.asked.as_ref().is_some_and(|(number, _)| *number == self.gallery.done)
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
                self.session.lighting = Lighting::Around { map: *map, turn: 0.0 };
            }
            self.gallery.take(ui.ctx(), answer);
        }
        self.inputs(ui);
        let theme = self.session.theme;
        let [side, frame] = self.panels(ui);
        if self.session.theme != theme {
            ui.ctx().set_theme(self.session.theme);
        }
        self.ask([side, frame].map(|points| (points * ui.pixels_per_point()).round() as usize));
    }

    fn inputs(&mut self, ui: &Ui) {
        let (seconds, dropped, swap) = ui.input(|input| {
            let dropped: Vec<PathBuf> = input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect();
            (input.stable_dt.min(0.1), dropped, input.key_pressed(Key::X))
        });
        self.session.advance(seconds);
        dropped.into_iter().for_each(|path| self.worker.open(path));
        if swap && ui.memory(|memory| memory.focused().is_none()) {
            self.session.swap();
        }
    }

    fn panels(&mut self, ui: &mut Ui) -> [f32; 2] {
        let (is_settled, session, gallery) = (self.is_settled(), &mut self.session, &mut self.gallery);
        let fill = ui.visuals().panel_fill;
        let frame = |x: i8, y: i8| Frame::new().fill(fill).inner_margin(Margin::symmetric(x, y));
        let narrow = ui.available_width() < 1100.0;
        let is_around = matches!(session.lighting, Lighting::Around { .. });
        Panel::top("header").exact_size(44.0).frame(frame(14, 0)).show(ui, |ui| Header { session }.show(ui));
        Panel::bottom("status")
            .exact_size(24.0)
            .frame(frame(14, 0))
            .show(ui, |ui| Status { gallery, is_settled, is_around }.show(ui));
        Panel::left("shelf")
            .exact_size(if narrow { 228.0 } else { 264.0 })
            .resizable(false)
            .frame(frame(10, 10))
            .show(ui, |ui| Shelf { session, gallery }.show(ui));
        Panel::bottom("controls").frame(frame(14, 4)).show(ui, |ui| Controls { session, maps: &gallery.maps }.show(ui));
        let middle = CentralPanel::default().frame(frame(12, 12)).show(ui, |ui| {
            Notices { gallery }.show(ui);
            Cards { session, gallery }.show(ui)
        });
        middle.inner
    }

    /// Asks for what is now to be seen, if that is news.
    fn ask(&mut self, [size, strip]: [usize; 2]) {
        let Session { ends, methods, t, exposure, lighting, .. } = self.session.clone();
        let request =
            Request { ends, methods, t, exposure, lighting, size: size.clamp(16, MOST_PIXELS), strip: strip.min(128) };
        if self.asked.as_ref().is_none_or(|(_, before)| *before != request) {
            let number = self.worker.show(request.clone());
            self.asked = Some((number, request));
        }
    }
}
