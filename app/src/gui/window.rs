//! The window around the workbench.

use std::path::PathBuf;
use std::sync::mpsc;
use std::time::Instant;

use eframe::NativeOptions;
use egui::{ColorImage, Ui, ViewportBuilder, ViewportCommand};
use nbrdf_core::{Image, Rgb, image::DISPLAY_GAMMA};

use super::{App, Layout, Session, Workbench};
use crate::worker::Stock;

/// What the window opens with.
#[derive(Default)]
pub struct Opening {
    pub session: Session,
    pub layout: Layout,
    /// Size \[points\].
    pub size: Option<[f32; 2]>,
    /// Where the session is kept.
    pub file: Option<PathBuf>,
    /// Something to tell at once.
    pub notice: Option<String>,
}

/// Opens the window; returns when it is closed.
pub fn open(app: App, opening: Opening) -> eframe::Result {
    let start = Instant::now();
    let [width, height] = opening.size.unwrap_or([1280.0, 800.0]).map(|side| side.max(480.0));
    let viewport = ViewportBuilder::default()
        .with_title("nbrdf")
        .with_app_id("nbrdf")
        .with_inner_size([width, height])
        .with_min_inner_size([640.0, 480.0]);
    let options =
        NativeOptions { viewport, centered: true, dithering: app.screenshot.is_none(), ..NativeOptions::default() };
    let create = move |_: &eframe::CreationContext| {
        let mut workbench = Workbench::new(Stock::built_in(), opening.session);
        workbench.layout = opening.layout;
        opening.notice.into_iter().for_each(|notice| workbench.gallery.notify(notice));
        let workbench = match opening.file {
            Some(file) => workbench.keeping(file),
            None => workbench,
        };
        app.files.iter().for_each(|file| workbench.open(file.clone()));
        let camera = app.screenshot.map(Camera::new);
        Ok(Box::new(Window { workbench, camera, start, frames: 0, size: None }) as Box<dyn eframe::App>)
    };
    eframe::run_native("nbrdf", options, Box::new(create))
}

struct Window {
    workbench: Workbench,
    camera: Option<Camera>,
    start: Instant,
    frames: u32,
    /// Of what is within the window \[points\].
    size: Option<[f32; 2]>,
}

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        // The second frame begins when the first is on the screen.
        if self.frames == 1 && self.camera.is_some() {
            eprintln!("first frame after {} ms", self.start.elapsed().as_millis());
        }
        self.frames = self.frames.saturating_add(1);
        self.workbench.ui(ui);
        if let Some(camera) = &mut self.camera {
            camera.watch(ui, &self.workbench, self.start);
        }
        let size = ui.ctx().content_rect().size();
        self.size = Some([size.x, size.y]);
    }

    fn on_exit(&mut self, _: Option<&eframe::glow::Context>) {
        self.workbench.finish(self.size);
    }
}

/// Takes one picture of the window once everything is shown.
struct Camera {
    file: PathBuf,
    film: Option<mpsc::Receiver<std::sync::Arc<ColorImage>>>,
    settled: u32,
}

impl Camera {
    fn new(file: PathBuf) -> Self {
        Self { file, film: None, settled: 0 }
    }

    fn watch(&mut self, ui: &Ui, workbench: &Workbench, start: Instant) {
        if let Some(film) = &self.film {
            let Ok(image) = film.try_recv() else { return ui.ctx().request_repaint() };
            eprintln!("everything shown after {} ms", start.elapsed().as_millis());
            if let Err(error) = linear(&image).write_png(&self.file) {
                eprintln!("error: {error}");
            }
            ui.ctx().send_viewport_cmd(ViewportCommand::Close);
            return;
        }
        let is_complete = workbench.is_settled() && workbench.gallery.is_complete();
        // A few frames more, so that nothing is caught fading in.
        self.settled = if is_complete { self.settled + 1 } else { 0 };
        if self.settled > 20 {
            let (sender, film) = mpsc::channel();
            ui.ctx().request_screenshot(move |image| drop(sender.send(image)));
            self.film = Some(film);
        }
        ui.ctx().request_repaint();
    }
}

/// Display bytes as the linear picture that is displayed as them.
fn linear(image: &ColorImage) -> Image {
    let value = |byte: u8| (f32::from(byte) / 255.0).powf(DISPLAY_GAMMA);
    let pixels = image.pixels.iter().map(|pixel| Rgb([pixel.r(), pixel.g(), pixel.b()].map(value)));
    Image::new(image.width(), image.height(), pixels.collect())
}
