//! The window around the workbench.

mod camera;
mod failures;
mod stopwatch;

use std::path::PathBuf;
use std::time::Instant;

use eframe::NativeOptions;
use egui::{Ui, ViewportBuilder};

use super::{App, Layout, Session, Workbench};
use crate::worker::{self, Cache, Stock};
use camera::Camera;
pub use failures::Failures;
use stopwatch::Stopwatch;

/// What the window opens with.
#[derive(Default)]
pub struct Opening {
    pub session: Session,
    pub layout: Option<Layout>,
    /// Size \[points\].
    pub size: Option<[f32; 2]>,
    /// Where the session is kept.
    pub file: Option<PathBuf>,
    /// Something to tell at once.
    pub notices: Vec<String>,
}

/// Opens the window; returns when it is closed. What could not be written goes into `failures`.
pub fn open(app: App, opening: Opening, failures: &Failures) -> eframe::Result {
    let start = Instant::now();
    worker::prepare();
    let [width, height] = opening.size.unwrap_or([1280.0, 800.0]).map(|side| side.max(480.0));
    let viewport = ViewportBuilder::default()
        .with_title("nbrdf")
        .with_app_id("nbrdf")
        .with_inner_size([width, height])
        .with_min_inner_size([640.0, 480.0]);
    let options = NativeOptions {
        viewport,
        centered: true,
        // Displayed values are those that the pointer tells, and software draws faster without.
        dithering: false,
        renderer: app.renderer.drawn_by(app.instead.is_some()),
        ..NativeOptions::default()
    };
    let failures = failures.clone();
    let create = move |creation: &eframe::CreationContext| {
        if app.is_filmed() {
            // Wherever the pointer happens to be.
            creation.egui_ctx.all_styles_mut(|style| style.interaction.tooltip_delay = f32::INFINITY);
        }
        // Pictures of the window leave no trace.
        let cache = if app.is_filmed() { Cache::default() } else { Cache::of_system() };
        let stock = Stock { cache, ..Stock::built_in() };
        let mut workbench = Workbench::new(stock, opening.session);
        workbench.layout = opening.layout;
        opening.notices.into_iter().for_each(|notice| workbench.gallery.notify(notice));
        let workbench = match opening.file {
            Some(file) => workbench.keeping(file),
            None => workbench,
        };
        let mut workbench = workbench;
        if let Some(pane) = app.pane {
            workbench.layout.get_or_insert_with(|| Layout::of(width)).bring(pane);
        }
        app.files.iter().for_each(|file| workbench.open(file.clone()));
        let film = app.film.as_deref().map(|folder| Camera::film(folder, app.frames, failures.clone()));
        let camera = app.screenshot.map(|file| Camera::still(file, failures.clone())).or(film);
        let stopwatch = app.report.map(|file| Stopwatch::new(file, app.drive, start));
        Ok(Box::new(Window { workbench, camera, stopwatch, failures, size: None }) as Box<dyn eframe::App>)
    };
    eframe::run_native("nbrdf", options, Box::new(create))
}

struct Window {
    workbench: Workbench,
    camera: Option<Camera>,
    stopwatch: Option<Stopwatch>,
    failures: Failures,
    /// Of what is within the window \[points\].
    size: Option<[f32; 2]>,
}

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        if let Some(stopwatch) = &mut self.stopwatch {
            stopwatch.watch(ui.ctx(), &mut self.workbench, frame.info().cpu_usage);
        }
        self.workbench.ui(ui);
        if let Some(camera) = &mut self.camera {
            camera.watch(ui, &mut self.workbench);
        }
        let size = ui.ctx().content_rect().size();
        self.size = Some([size.x, size.y]);
    }

    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn on_exit(&mut self, _: Option<&eframe::glow::Context>) {
        if let Some(stopwatch) = &self.stopwatch {
            stopwatch.finish(&self.workbench, &self.failures);
        }
        self.workbench.finish(self.size);
    }
}
