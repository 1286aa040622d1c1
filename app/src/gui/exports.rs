//! The window in which files are asked for.

mod fields;
mod files;

use std::path::PathBuf;

use egui::{Align2, Context, Key, ProgressBar, RichText, Ui, Window, vec2};

pub use files::Files;

use super::{Gallery, Session};
use crate::worker::export::Job;
use files::listed;

/// What is asked of the worker.
pub enum Wish {
    /// Which of these files are there?
    Look(Vec<PathBuf>),
    /// Write files.
    Write(Box<Job>),
    /// Give up.
    Stop,
}

/// The window, while it is open.
#[derive(Default)]
pub struct Exports {
    is_replacing: bool,
    asked: Vec<PathBuf>,
    ended: u64,
}

impl Exports {
    /// One frame; whether it stays open, and what it asks for.
    pub fn show(&mut self, context: &Context, session: &mut Session, gallery: &Gallery) -> (bool, Option<Wish>) {
        let (mut is_open, mut wish) = (true, None);
        let window = Window::new("Export to files").collapsible(false).resizable(false).open(&mut is_open);
        let width = 440.0_f32.min(context.content_rect().width() - 60.0);
        window.default_width(width).pivot(Align2::CENTER_TOP).default_pos(top(context)).show(context, |ui| {
            ui.set_max_width(width);
            fields::show(ui, session);
            ui.separator();
            wish = self.end(ui, session, &gallery.files);
        });
        (is_open && !context.input(|input| input.key_pressed(Key::Escape)), wish)
    }

    /// The files to be, those that are there, and the button.
    fn end(&mut self, ui: &mut Ui, session: &Session, files: &Files) -> Option<Wish> {
        let job = match session.job(self.is_replacing) {
            Ok(job) => job,
            Err(why) => {
                ui.label(RichText::new(why).color(ui.visuals().warn_fg_color));
                return None;
            }
        };
        let paths = job.paths();
        ui.label(RichText::new(listed(&paths)).small().weak())
            .on_hover_text("The first file tells what the others are");
        let there = match &files.there {
            Some([asked, there]) if *asked == paths => Some(there),
            _ => None,
        };
        if let Some(there) = there.filter(|there| !there.is_empty()) {
            let text = RichText::new(format!("There already: {}", listed(there))).color(ui.visuals().warn_fg_color);
            ui.label(text);
            ui.checkbox(&mut self.is_replacing, "Replace").on_hover_text("Write over the files that are there");
        }
        let may_write = files.progress.is_none() && there.is_some_and(|there| there.is_empty() || self.is_replacing);
        let mut wish = None;
        ui.horizontal(|ui| {
            let button = ui.add_enabled(may_write, egui::Button::new("Write files"));
            if button.on_hover_text("Write all of them, or none").clicked() {
                wish = Some(Wish::Write(Box::new(job)));
            }
            if let Some(share) = files.progress {
                if ui.button("Stop").on_hover_text("Give up; nothing is written then").clicked() {
                    wish = Some(Wish::Stop);
                }
                ui.add(ProgressBar::new(share).desired_width(ui.available_width()).show_percentage());
            }
        });
        if self.asked != paths || self.ended != files.ended {
            // Leave to replace is given for the files that are named, once.
            self.is_replacing = false;
            self.ended = files.ended;
            self.asked.clone_from(&paths);
            wish = wish.or(Some(Wish::Look(paths)));
        }
        wish
    }
}

fn top(context: &Context) -> egui::Pos2 {
    context.content_rect().center_top() + vec2(0.0, 64.0)
}
