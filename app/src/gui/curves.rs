//! What the worker found out for figures: the newest answer of each sort.

use std::collections::HashMap;
use std::mem::{Discriminant, discriminant};

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

use crate::worker::{Card, ChartNews, Findings, Found, Topic};

/// The newest answer of each sort.
#[derive(Default)]
pub struct Curves {
    findings: HashMap<Discriminant<Topic>, Findings>,
    slices: HashMap<Card, TextureHandle>,
    /// The chart of all representations, as far as it is.
    pub chart: Option<ChartNews>,
}

impl Curves {
    /// Takes an answer in.
    pub fn take(&mut self, context: &Context, mut findings: Findings) {
        if let Found::Slices(pictures) = &mut findings.found {
            self.slices.clear();
            for (card, picture) in pictures {
                let image = ColorImage::from_rgba_premultiplied([picture.size; 2], &picture.rgba);
                self.slices.insert(*card, context.load_texture("slice", image, TextureOptions::LINEAR));
                picture.rgba = Vec::new();
            }
        }
        self.findings.insert(discriminant(&findings.question.topic), findings);
    }

    /// The newest answer to a question of this sort, of whatever ends and point.
    pub fn of(&self, topic: &Topic) -> Option<&Findings> {
        self.findings.get(&discriminant(topic))
    }

    /// Whether a finer answer is to come.
    pub fn is_waiting(&self) -> bool {
        self.findings.values().any(|findings| !findings.is_fine)
    }

    /// The slice of a card.
    pub fn slice(&self, card: Card) -> Option<&TextureHandle> {
        self.slices.get(&card)
    }
}
