//! A place of the map as a material of its own.

use std::sync::Arc;

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
    /// A name that no other place has, nor this one among more materials.
    fn name(self, materials: usize) -> String {
        let [x, y] = self.place;
        format!("{} of {materials} materials at {x}, {y}", self.projection.title())
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
        let found = sheet.and_then(|sheet| Ok((self.office.decode(explored, &sheet)?, sheet.count())));
        match found {
            Ok((point, materials)) => {
                self.put(card, point);
                let ends = Arc::new([explored.name(materials)]);
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
        self.decode(explored, &sheet)
    }

    fn decode(&self, explored: Explored, sheet: &Sheet) -> Result<Box<dyn Brdf>, String> {
        let numbers = sheet.code(explored.place).ok_or("there are no materials on this map")?;
        let model = self.stock.catalog.autoencoder();
        guarded("Decoding", || model.decode(&model.code(numbers)).map_err(|error| error.to_string()))?
    }
}
