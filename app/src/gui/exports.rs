//! The window in which files are asked for.

use std::path::PathBuf;

use egui::{Align2, ComboBox, Context, DragValue, Key, ProgressBar, RichText, TextEdit, Ui, Window, vec2};

use super::Gallery;
use super::session::{SIZES, STEPS, Session, What, export_name_of};
use crate::catalog::EXPORTERS;
use crate::worker::Card;
use crate::worker::export::{Job, News, PictureForm};

/// What is asked of the worker.
pub enum Wish {
    /// Which of these files are there?
    Look(Vec<PathBuf>),
    /// Write files.
    Write(Box<Job>),
    /// Give up.
    Stop,
}

/// What the worker said of files.
#[derive(Debug, Default)]
pub struct Files {
    /// The files last asked about, and those of them that are there.
    pub there: Option<[Vec<PathBuf>; 2]>,
    /// How much of what is being written is done, 0..1; none where nothing is.
    pub progress: Option<f32>,
    /// How many exports have ended, well or not.
    pub ended: u64,
}

impl Files {
    /// Takes an answer in; what the user is to be told of it.
    pub fn take(&mut self, news: News) -> Option<String> {
        match news {
            News::Present { asked, there } => {
                self.there = Some([asked, there]);
                None
            }
            News::Progress(share) => {
                self.progress = Some(share);
                None
            }
            News::Written(files) => {
                self.end();
                Some(written(&files))
            }
            News::Failed(why) => {
                self.end();
                Some(why)
            }
            // Of a code nothing is written: what is being written goes on.
            News::NoCode(why) => Some(why),
            News::Code(_) => Some("The code of this point is on the clipboard.".to_owned()),
        }
    }

    fn end(&mut self) {
        self.progress = None;
        self.there = None;
        self.ended += 1;
    }
}

/// Names a few files in a sentence.
fn written(files: &[PathBuf]) -> String {
    let folder = files.first().and_then(|file| file.parent()).unwrap_or(std::path::Path::new("")).display();
    format!("Written to {folder}: {}", listed(files))
}

fn listed(files: &[PathBuf]) -> String {
    const MOST: usize = 4;
    let name = |file: &PathBuf| file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut names: Vec<String> = files.iter().take(MOST).map(name).collect();
    if files.len() > MOST {
        names.push(format!("and {} more", files.len() - MOST));
    }
    names.join(", ")
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
            what(ui, session);
            ui.separator();
            if session.export.what.is_of_a_card() {
                card(ui, session);
            }
            form(ui, session);
            place(ui, session);
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

fn what(ui: &mut Ui, session: &mut Session) {
    ui.horizontal_wrapped(|ui| {
        for what in What::ALL {
            let [title, about] = what.about();
            ui.selectable_value(&mut session.export.what, what, title).on_hover_text(about);
        }
    });
    ui.label(RichText::new(session.export.what.about()[1]).small().weak());
}

fn card(ui: &mut Ui, session: &mut Session) {
    let title = |card: Card| session.title(card);
    let cards: Vec<(String, String)> =
        session.export_cards().into_iter().map(|card| (export_name_of(card), title(card))).collect();
    let chosen = session.export_card();
    let shown = chosen.map_or_else(|| "none".to_owned(), title);
    let chosen = chosen.map(export_name_of);
    let choice = ComboBox::from_label("Card").selected_text(shown).show_ui(ui, |ui| {
        for (name, title) in cards {
            if ui.selectable_label(chosen.as_ref() == Some(&name), title).clicked() {
                session.export.card = name;
            }
        }
    });
    choice.response.on_hover_text("Whose material: an end, or the present point of a method");
}

fn form(ui: &mut Ui, session: &mut Session) {
    let export = &mut session.export;
    ui.horizontal_wrapped(|ui| match export.what {
        What::Material | What::Steps => {
            for entry in EXPORTERS {
                let is_chosen = export.exporter().name == entry.name;
                if ui.selectable_label(is_chosen, entry.name).on_hover_text(entry.about).clicked() {
                    entry.name.clone_into(&mut export.form);
                }
            }
        }
        What::Picture | What::Strip => {
            for (form, about) in PictureForm::ALL.into_iter().zip(["as it is displayed", "linear values"]) {
                let name = form.extension().to_uppercase();
                ui.selectable_value(&mut export.picture, form, name).on_hover_text(about);
            }
            let size = DragValue::new(&mut export.size).range(SIZES[0]..=SIZES[1]).suffix(" pixels");
            ui.add(size).on_hover_text("Side of a sphere [pixels]");
        }
        What::Curve => {
            ui.label("CSV");
        }
    });
    if matches!(export.what, What::Strip | What::Curve | What::Steps) {
        let steps = DragValue::new(&mut export.steps).range(STEPS[0]..=STEPS[1]).suffix(" points");
        ui.add(steps).on_hover_text("Points of the path, ends included");
    }
}

fn place(ui: &mut Ui, session: &mut Session) {
    let (folder, name) = (session.export.folder().display().to_string(), session.export_name());
    let fields = [
        ("Folder", folder, &mut session.export.folder, "Where the files go; it must be there"),
        ("Name", name, &mut session.export.name, "What the names of all files begin with"),
    ];
    for (title, hint, text, about) in fields {
        ui.horizontal(|ui| {
            let label = ui.add_sized(vec2(48.0, 20.0), egui::Label::new(title));
            let field = TextEdit::singleline(text).hint_text(hint).desired_width(f32::INFINITY);
            ui.add(field).labelled_by(label.id).on_hover_text(about);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_that_fails_leaves_what_is_being_written_alone() {
        let mut files = Files { progress: Some(0.5), ..Files::default() };
        assert_eq!(files.take(News::NoCode("none".to_owned())), Some("none".to_owned()));
        assert_eq!((files.progress, files.ended), (Some(0.5), 0));
        assert_eq!(files.take(News::Failed("full".to_owned())), Some("full".to_owned()));
        assert_eq!((files.progress, files.ended), (None, 1));
    }
}
