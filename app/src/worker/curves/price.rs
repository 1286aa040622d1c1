//! What evaluation of the ends and of the middles between them costs, here and now.

use std::any::Any;
use std::collections::HashMap;

use nbrdf_core::brdf::table::Table;
use nbrdf_core::cost::{Cost, Given, Track};
use nbrdf_core::{Brdf, Nbrdf};

use super::{Question, Subject};
use crate::worker::Card;
use crate::worker::paths::Key;

/// Repeats whose median is told.
const REPEATS: usize = 9;

/// What a model costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Price {
    /// Whose.
    pub card: Card,
    /// Nanoseconds per evaluation, one thread.
    pub cost: Cost,
    /// Bytes that evaluation reads of it, where that is known.
    pub bytes: Option<usize>,
    /// Numbers of the code it is decoded from, where there is one.
    pub numbers: Option<usize>,
}

/// Whose cost: an end by its name, or the middle of a path.
#[derive(Clone, PartialEq, Eq, Hash)]
enum Model {
    End(String),
    Middle(Key),
}

/// Costs kept; they are small, so this only bounds a long day's work.
const KEPT: usize = 256;

/// Costs that were measured: each once.
#[derive(Default)]
pub(super) struct Prices(HashMap<Model, Cost>);

impl Prices {
    /// Of these subjects, all that are not known yet measured in turns.
    pub fn of(&mut self, question: &Question, subjects: &[Subject]) -> Vec<Price> {
        let model = |subject: &Subject| match subject.card {
            Card::End(end) => question.ends.get(end).cloned().map(Model::End),
            Card::Method(method) => Some(Model::Middle(question.key(method))),
            // A place of the map is a decoded code, as the points of latent paths are.
            Card::Explored => None,
        };
        let is_unknown = |subject: &&Subject| model(subject).is_some_and(|model| !self.0.contains_key(&model));
        let unknown: Vec<&Subject> = subjects.iter().filter(is_unknown).collect();
        let asked: Vec<(&dyn Brdf, Given)> =
            unknown.iter().map(|subject| (subject.brdf.as_ref(), Given::Directions)).collect();
        if !self.0.is_empty() && self.0.len() + asked.len() > KEPT {
            self.0.clear();
            return self.of(question, subjects);
        }
        if !asked.is_empty() {
            let costs = Track::new(0).measure(&asked, REPEATS);
            self.0.extend(unknown.iter().filter_map(|subject| model(subject)).zip(costs));
        }
        let price = |subject: &Subject| {
            Some(Price {
                card: subject.card,
                cost: *self.0.get(&model(subject)?)?,
                bytes: bytes(subject.brdf.as_ref()),
                numbers: subject.code.as_ref().map(|code| code.code.len()),
            })
        };
        subjects.iter().filter_map(price).collect()
    }
}

/// Of networks and tables; others keep what they need in many places.
fn bytes(brdf: &dyn Brdf) -> Option<usize> {
    let any = brdf as &dyn Any;
    let network = any.downcast_ref::<Nbrdf>().map(|network| size_of_val(network.weights()));
    network.or_else(|| any.downcast_ref::<Table>().map(Table::bytes))
}
