//! Pictures of the window, each taken once everything in it is shown.

use std::path::{Path, PathBuf};
use std::sync::{Arc, mpsc};

use egui::{ColorImage, Ui, ViewportCommand};
use nbrdf_core::{Image, Rgb, image::DISPLAY_GAMMA};

use super::failures::Failures;
use crate::gui::Workbench;

/// Frames to wait once everything is there, so that nothing is caught fading in.
const PATIENCE: u32 = 20;

/// Takes pictures one after the other, then closes the window.
pub struct Camera {
    shots: std::vec::IntoIter<Shot>,
    next: Option<Shot>,
    film: Option<mpsc::Receiver<Arc<ColorImage>>>,
    settled: u32,
    failures: Failures,
}

/// A picture to take: its file, and where on the path, if that is to change.
struct Shot {
    file: PathBuf,
    t: Option<f32>,
}

impl Camera {
    /// One picture of the window as it is.
    pub fn still(file: PathBuf, failures: Failures) -> Self {
        Self::of(vec![Shot { file, t: None }], failures)
    }

    /// So many pictures of a walk from the first material to the last and back, as 000.png, 001.png, ... in a folder.
    pub fn film(folder: &Path, count: u16, failures: Failures) -> Self {
        let shot = |step: u16| {
            let turn = std::f32::consts::TAU * f32::from(step) / f32::from(count);
            Shot { file: folder.join(format!("{step:03}.png")), t: Some(0.5 - 0.5 * turn.cos()) }
        };
        Self::of((0..count).map(shot).collect(), failures)
    }

    fn of(shots: Vec<Shot>, failures: Failures) -> Self {
        Self { shots: shots.into_iter(), next: None, film: None, settled: 0, failures }
    }

    /// After each frame.
    pub fn watch(&mut self, ui: &Ui, workbench: &mut Workbench) {
        ui.ctx().request_repaint();
        if let Some(film) = &self.film {
            let Ok(image) = film.try_recv() else { return };
            if let Some(shot) = &self.next
                && let Err(error) = linear(&image).write_png(&shot.file)
            {
                self.failures.add(error.to_string());
            }
            (self.film, self.next, self.settled) = (None, None, 0);
        }
        if self.next.is_none() {
            self.next = self.shots.next();
            match &self.next {
                Some(shot) => shot.t.into_iter().for_each(|t| workbench.session.blend.go_to(t)),
                None => ui.ctx().send_viewport_cmd(ViewportCommand::Close),
            }
            return;
        }
        let is_complete = workbench.is_settled() && workbench.gallery.is_complete();
        self.settled = if is_complete { self.settled + 1 } else { 0 };
        if self.settled > PATIENCE {
            let (sender, film) = mpsc::channel();
            ui.ctx().request_screenshot(move |image| drop(sender.send(image)));
            self.film = Some(film);
        }
    }
}

/// Display bytes as the linear picture that is displayed as them.
fn linear(image: &ColorImage) -> Image {
    let value = |byte: u8| (f32::from(byte) / 255.0).powf(DISPLAY_GAMMA);
    let pixels = image.pixels.iter().map(|pixel| Rgb([pixel.r(), pixel.g(), pixel.b()].map(value)));
    Image::new(image.width(), image.height(), pixels.collect())
}
