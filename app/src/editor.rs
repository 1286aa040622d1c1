//! Qualities of a material moved one after the other, along codes of likely materials.

use std::sync::Arc;

use anyhow::{Context, Result};
use autoencoder::Autoencoder;
use nbrdf_core::axis::{Axis, GREY, Prior, edit};
use nbrdf_core::quality::Qualities;
use nbrdf_core::{Code, Representation as _};

use crate::catalog::Catalog;

/// Qualities are moved by so much at most, either way.
pub const MOST: f32 = 1.0;
/// Smallest share of an edit that is not worth a warning.
const REACHED: f64 = 0.8;

/// Moves qualities of ZNBRDF's codes.
pub struct Editor {
    model: Arc<Autoencoder>,
    prior: Prior,
}

/// What became of a code.
#[derive(Clone, Debug, PartialEq)]
pub struct Edited {
    /// The numbers of the edited code.
    pub code: Vec<f32>,
    /// Qualities of the material as it was.
    pub before: Qualities,
    /// Qualities of the edited material.
    pub after: Qualities,
    /// Which edits went less far than asked for, and why, for people.
    pub shortfalls: Vec<String>,
}

impl Editor {
    /// With the catalog's model.
    ///
    /// # Errors
    /// If that model remembers no materials.
    pub fn of(catalog: &Catalog) -> Result<Self> {
        let model = catalog.autoencoder();
        let prior = model.prior().context("this model remembers no materials to learn axes from")?;
        Ok(Self { model, prior })
    }

    /// The model whose codes are edited.
    pub fn model(&self) -> &Autoencoder {
        &self.model
    }

    /// Whether a code is one of the model's.
    pub fn knows(&self, code: &Code) -> bool {
        code.model == self.model.name() && code.checkpoint == self.model.checkpoint()
    }

    /// Makes edits, in order; amounts as in [`edit`].
    ///
    /// # Errors
    /// If the code does not decode.
    pub fn edit(&self, start: &Code, edits: impl IntoIterator<Item = (Axis, f64)>) -> Result<Edited> {
        let before = Qualities::of(self.model.decode(start)?.as_ref());
        let mut edited = Edited { code: start.code.clone(), before, after: before, shortfalls: Vec::new() };
        for (axis, amount) in edits.into_iter().filter(|(_, amount)| *amount != 0.0) {
            let from = edited.after;
            (edited.code, edited.after) = edit(self.model.as_ref(), &self.prior, &edited.code, axis, amount)?;
            edited.shortfalls.extend(shortfall(axis, amount, [&from, &edited.after]));
        }
        Ok(edited)
    }
}

/// What is to be said of an edit that went less far than asked for.
fn shortfall(axis: Axis, amount: f64, [from, to]: [&Qualities; 2]) -> Option<String> {
    let missed = axis.missed(from, to, amount) / amount;
    // NaN is short, too.
    if missed <= 1.0 - REACHED {
        return None;
    }
    if axis == Axis::Hue && Axis::Chroma.value(from) < GREY {
        return Some("grey has no hue to turn: move chroma first, as in chroma+0.2".to_owned());
    }
    let moved = axis.difference(from, to);
    Some(format!(
        "{} moved by {moved:+.3}, not by {amount:+.3}: no code of a likely material goes further",
        axis.name()
    ))
}
