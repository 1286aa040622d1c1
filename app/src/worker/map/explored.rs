//! A place of the map as a material of its own.

use std::sync::Arc;

use nbrdf_core::hash::short_hash;
use nbrdf_core::{Brdf, Representation as _};
use serde::{Deserialize, Serialize};

use super::{Projection, Sheet};
use crate::worker::films::Subject;
use crate::worker::studio::Studio;
use crate::worker::{Answer, Card, Office, Request, guarded};

/// A place of a map that is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Explored {
    /// Of which map.
    pub projection: Projection,
    /// Where, in units of the map.
    pub place: [f32; 2],
}

impl Explored {
    /// A name that no other place has, nor this one on a map of other materials, which puts another code there.
    fn name(self, code: &[f32]) -> String {
        let [x, y] = self.place;
        format!("{} at {x}, {y}, code {}", self.projection.title(), short_hash(code.iter().copied()))
    }
}

impl Studio {
    /// The material at the place that is explored, if there is one, and whether it has to wait for the map.
    pub fn explore(&mut self, request: &Request) -> (Option<Subject>, bool) {
        let card = Card::Explored;
        let Some(explored) = request.explored else { return (None, false) };
        let Some(sheet) = self.office.sheets.get(explored.projection) else {
            self.withdraw(card, Answer::Pending(card));
            return (None, true);
        };
        match sheet.and_then(|sheet| self.office.decode(explored, &sheet)) {
            Ok((point, code)) => {
                self.put(card, point);
                let ends = Arc::new([explored.name(&code)]);
                (Some(Subject { card, ends, point: None, edited: None }), false)
            }
            Err(why) => {
                self.withdraw(card, Answer::Failed(card, why));
                (None, false)
            }
        }
    }
}

impl Office {
    /// The material at a place that is explored.
    pub fn explored(&self, explored: Explored) -> Result<Box<dyn Brdf>, String> {
        let sheet = self.sheets.get(explored.projection).ok_or("drawing the map")??;
        Ok(self.decode(explored, &sheet)?.0)
    }

    /// With its code.
    fn decode(&self, explored: Explored, sheet: &Sheet) -> Result<(Box<dyn Brdf>, Vec<f32>), String> {
        let numbers = sheet.code(explored.place).ok_or("there are no materials on this map")?;
        let model = self.stock.catalog.autoencoder();
        let code = model.code(numbers);
        let decoded = guarded("Decoding", || model.decode(&code).map_err(|error| error.to_string()))??;
        Ok((decoded, code.code))
    }
}
