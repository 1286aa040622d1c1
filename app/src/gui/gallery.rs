//! What the worker answered: textures and figures by what they show.

use std::collections::HashMap;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

use crate::worker::{Answer, Card, Figures, Picture, Plates};

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
    /// Names of the environment maps.
    pub maps: Vec<String>,
    plates: Plates,
    thumbnails: HashMap<String, TextureHandle>,
    views: HashMap<Card, View>,
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
        Self { names, plates, maps: vec!["Soft boxes".to_owned()], ..Self::default() }
    }

    /// Takes an answer in.
    pub fn take(&mut self, context: &Context, answer: Answer) {
        match answer {
            Answer::Picture(card, picture) => {
                let view = self.views.entry(card).or_default();
                show(context, &self.plates, &mut view.texture, picture);
                view.state = State::Shown;
            }
            Answer::Figures(card, figures) => self.views.entry(card).or_default().figures = figures,
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
            Answer::Opened(names) => self.names.extend(names),
            Answer::Surround(names, _) => self.maps = names,
            Answer::Notice(text) => self.notify(text),
        }
    }

    /// Tells the user something, once.
    pub fn notify(&mut self, text: String) {
        if !self.notices.contains(&text) {
            self.notices.push(text);
        }
    }

    /// The picture of a material in the list.
    pub fn thumbnail(&self, name: &str) -> Option<&TextureHandle> {
        self.thumbnails.get(name)
    }

    /// Whether every material has its picture.
    pub fn is_complete(&self) -> bool {
        self.thumbnails.len() >= self.names.len()
    }

    /// What there is to see of a card.
    pub fn view(&self, card: Card) -> Option<&View> {
        self.views.get(&card)
    }

    /// One point of a film strip.
    pub fn frame(&self, card: Card, step: usize) -> Option<&TextureHandle> {
        self.frames.get(&(card, step))
    }

    fn fail(&mut self, card: Card, state: State) {
        let view = self.views.entry(card).or_default();
        view.state = state;
        view.figures = None;
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
