//! What the worker answered: textures and figures by what they show.

mod tableau;

use std::collections::{HashMap, HashSet};
use std::path::PathBuf;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

pub use tableau::Tableau;

use super::atlas::Atlas;
use super::curves::Curves;
use super::exports::Files;
use crate::worker::{
    Answer, BUILT_IN, Card, Difference, Figures, Job, Listed, Measured, Picture, Plates, Point, Property,
};

/// All pictures on the screen.
#[derive(Default)]
pub struct Gallery {
    /// Names of the materials, in the order of the list.
    pub names: Vec<String>,
    /// Notices not yet dismissed, oldest first.
    pub notices: Vec<String>,
    /// The path being prepared.
    pub preparing: Option<&'static str>,
    /// Number of the last request shown in full.
    pub done: u64,
    /// The environment maps that are there.
    pub maps: Vec<Listed>,
    pictures: u64,
    /// The newest difference of two cards.
    pub heat: Option<Heat>,
    /// What there is at the picked point.
    pub point: Option<Point>,
    /// Curves and other figures of the paths.
    pub curves: Curves,
    /// The latent map.
    pub atlas: Atlas,
    /// The scene that is planned.
    pub scene: Tableau,
    /// What is known of files that are written.
    pub files: Files,
    /// Fits that run or wait.
    pub jobs: Vec<Job>,
    /// Files of materials that were opened, by name.
    pub sources: HashMap<String, PathBuf>,
    /// Why the system's dialog for files cannot be shown.
    pub dialog: Option<String>,
    /// Whether the files of the last session were read.
    pub is_reopened: bool,
    qualities: HashMap<String, [f64; 3]>,
    errors: HashMap<String, f64>,
    /// The meshes that are there.
    pub meshes: Vec<Listed>,
    plates: Plates,
    thumbnails: HashMap<String, TextureHandle>,
    views: HashMap<Card, View>,
    measured: HashMap<Card, Measured>,
    frames: HashMap<(Card, usize), TextureHandle>,
}

/// What there is to see of one card.
#[derive(Default)]
pub struct View {
    /// The newest picture.
    pub texture: Option<TextureHandle>,
    /// Its figures.
    pub figures: Option<Figures>,
    /// Why the picture is not the one asked for.
    pub state: State,
}

/// How two cards differ.
pub struct Heat {
    /// Of which cards.
    pub cards: [Card; 2],
    /// The heat map.
    pub texture: TextureHandle,
    /// Where its colours end \[ΔE_ITP\].
    pub top: u16,
    /// Mean over the sphere \[ΔE_ITP\].
    pub mean: f32,
    /// Of the pixel that differs most \[ΔE_ITP\].
    pub largest: f32,
}

/// Whether a picture is the one asked for.
#[derive(Default, PartialEq, Eq, Debug)]
pub enum State {
    /// Its path is being prepared.
    #[default]
    Pending,
    /// It is.
    Shown,
    /// There is none, for this reason.
    Failed(String),
}

impl Gallery {
    /// Nothing to see yet of these materials.
    pub fn of(names: Vec<String>, plates: Plates) -> Self {
        let [maps, meshes] = BUILT_IN.map(|name| vec![Listed::built_in(name)]);
        Self { names, plates, maps, meshes, ..Self::default() }
    }

    /// Takes an answer in.
    pub fn take(&mut self, context: &Context, answer: Answer) {
        match answer {
            Answer::Picture(card, picture) => {
                let view = self.views.entry(card).or_default();
                show(context, &self.plates, &mut view.texture, picture);
                view.state = State::Shown;
                self.pictures += u64::from(matches!(card, Card::Method(_)));
            }
            Answer::Figures(card, figures) => self.views.entry(card).or_default().figures = figures,
            Answer::Measured(card, None) => drop(self.measured.remove(&card)),
            Answer::Measured(card, Some(measured)) => drop(self.measured.insert(card, measured)),
            Answer::Pending(card) => self.fail(card, State::Pending),
            Answer::Failed(card, why) => self.fail(card, State::Failed(why)),
            Answer::Frame(card, step, picture) => {
                let mut texture = self.frames.remove(&(card, step));
                show(context, &self.plates, &mut texture, picture);
                self.frames.extend(texture.map(|texture| ((card, step), texture)));
            }
            Answer::Done(number) => self.done = number,
            Answer::Preparing(what) => self.preparing = what,
            Answer::Thumbnail(name, picture) => {
                let mut texture = None;
                show(context, &self.plates, &mut texture, picture);
                self.thumbnails.extend(texture.map(|texture| (name, texture)));
            }
            Answer::Opened(names) => self.list(names),
            Answer::Difference(Difference { cards, picture, top, mean, largest }) => {
                let mut texture = self.heat.take().map(|heat| heat.texture);
                show(context, &self.plates, &mut texture, picture);
                self.heat = texture.map(|texture| Heat { cards, texture, top, mean, largest });
            }
            Answer::Point(point) => self.point = Some(point),
            Answer::Findings(findings) => self.curves.take(context, *findings),
            Answer::Chart(news) => self.curves.chart = Some(*news),
            Answer::Map(answer) => self.atlas.take(answer),
            Answer::Scene(news) => self.scene.take(context, news),
            Answer::Export(news) => self.files.take(news).into_iter().for_each(|text| self.notify(text)),
            Answer::Kept(path, names) => {
                self.sources.retain(|_, source| *source != path);
                self.sources.extend(names.into_iter().map(|name| (name, path.clone())));
            }
            // The session's.
            Answer::Lost(_) | Answer::Pasted(_) => {}
            Answer::Reopened => self.is_reopened = true,
            Answer::Jobs(jobs) => self.jobs = jobs,
            Answer::Property(name, Property::Qualities(found)) => drop(self.qualities.insert(name, found)),
            Answer::Property(name, Property::Error(found)) => drop(self.errors.insert(name, found)),
            Answer::Dialog(why) => self.dialog = why,
            Answer::Maps(maps, _) => self.maps = maps,
            Answer::Meshes(meshes, _) => self.meshes = meshes,
            Answer::Notice(text) => self.notify(text),
        }
    }

    /// Tells the user something, once.
    pub fn notify(&mut self, text: String) {
        if !self.notices.contains(&text) {
            self.notices.push(text);
        }
    }

    /// Lightness, gloss and roughness of a material, once they were asked for.
    pub fn qualities(&self, name: &str) -> Option<[f64; 3]> {
        self.qualities.get(name).copied()
    }

    /// The error to expect of a material's code, once it was asked for.
    pub fn error(&self, name: &str) -> Option<f64> {
        self.errors.get(name).copied()
    }

    /// The picture of a material in the list.
    pub fn thumbnail(&self, name: &str) -> Option<&TextureHandle> {
        self.thumbnails.get(name)
    }

    /// Whether every material has its picture, and the scene its plan if one was asked for.
    pub fn is_complete(&self) -> bool {
        self.thumbnails.len() >= self.names.len() && !self.scene.is_busy() && !self.curves.is_waiting()
    }

    /// How many pictures of methods came since the start.
    pub const fn pictures(&self) -> u64 {
        self.pictures
    }

    /// Side of the largest picture \[px\].
    pub fn largest_side(&self) -> usize {
        self.views.values().filter_map(|view| view.texture.as_ref()).flat_map(TextureHandle::size).max().unwrap_or(0)
    }

    /// What there is to see of a card.
    pub fn view(&self, card: Card) -> Option<&View> {
        self.views.get(&card)
    }

    /// Qualities of the point a card shows, where they are known.
    pub fn measured(&self, card: Card) -> Option<&Measured> {
        self.measured.get(&card)
    }

    /// One point of a film strip.
    pub fn frame(&self, card: Card, step: usize) -> Option<&TextureHandle> {
        self.frames.get(&(card, step))
    }

    /// These materials are there now; what is known of a name that is gone is forgotten.
    fn list(&mut self, names: Vec<String>) {
        let there: HashSet<&String> = names.iter().collect();
        self.thumbnails.retain(|name, _| there.contains(name));
        self.qualities.retain(|name, _| there.contains(name));
        self.errors.retain(|name, _| there.contains(name));
        self.names = names;
    }

    fn fail(&mut self, card: Card, state: State) {
        let view = self.views.entry(card).or_default();
        view.state = state;
        view.figures = None;
        self.measured.remove(&card);
        // A strip of other ends would be taken for one of these.
        self.frames.retain(|(other, _), _| *other != card);
    }
}

fn show(context: &Context, plates: &Plates, texture: &mut Option<TextureHandle>, picture: Picture) {
    let image = ColorImage::from_rgba_premultiplied([picture.size; 2], &picture.rgba);
    plates.give_back(picture.rgba);
    match texture {
        Some(texture) => texture.set(image, TextureOptions::LINEAR),
        None => *texture = Some(context.load_texture("sphere", image, TextureOptions::LINEAR)),
    }
}
