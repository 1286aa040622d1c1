//! The smallest model of every object's material that serves a scene.
//!
//! A view says what the picture asks of each material ([`View`](crate::scene::View)). A ladder of models is walked from the
//! cheapest up: what is far off on a part of what is asked is left, what comes near is confirmed in the picture. Among the
//! models that are within the tolerance the one of least evaluation time is taken, and within a tenth of it the one of
//! fewest bytes, what several share counted once; or fewest bytes first ([`By`]).

mod bench;
mod choose;
mod climb;
mod follow;
mod judge;
mod models;
mod planner;
mod totals;
mod tried;

use std::sync::Arc;

use serde::{Deserialize, Serialize};

pub use follow::{Followed, LEAVES, TAKES_OVER};
pub use models::Models;
pub use planner::Planner;
pub use totals::Totals;
pub use tried::Tried;

use crate::representation::EncodeError;
use crate::{Brdf, Code, Image, Material, Nbrdf};

/// Mean FLIP on an object's pixels that nobody minds.
pub const TOLERANCE: f64 = 0.04;
/// Times within this factor are the same.
pub const TIE: f64 = 1.1;

/// A kind of model on the ladder.
pub struct Rung {
    /// Its name in reports.
    pub name: String,
    /// Nanoseconds per evaluation to expect, one thread: the order of the ladder.
    pub ns: f64,
    /// Bytes of one material to expect.
    pub bytes: usize,
    /// What all its models share: a name, and bytes.
    pub shared: Option<(String, usize)>,
    /// The rung of the same models in more bits: where that one is far off, this one is.
    pub coarser_than: Option<usize>,
    /// Whether it is the materials as they are; one rung is.
    pub is_itself: bool,
    /// Makes the model of a material.
    pub make: Make,
}

/// Makes the model of a material.
pub type Make = Box<dyn Fn(&Material) -> Result<Model, EncodeError> + Send + Sync>;

/// A material in one of its forms.
#[derive(Clone)]
pub struct Model {
    /// What is evaluated.
    pub brdf: Arc<dyn Brdf>,
    /// Bytes of this material, without what is shared.
    pub bytes: usize,
    /// What is to be kept of it.
    pub kept: Kept,
}

/// What is to be kept of a model.
#[derive(Clone)]
pub enum Kept {
    /// A few numbers.
    Code(Code),
    /// A network.
    Network(Nbrdf),
    /// A table, to be written out from its reflectance.
    Table,
    /// The material, as it is.
    Itself,
}

/// What is to be least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum By {
    /// Evaluation time.
    Time,
    /// Bytes.
    Bytes,
}

/// How a plan is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Mean FLIP that an object's pixels may have, above 0.
    pub tolerance: f64,
    /// What is to be least.
    pub by: By,
    /// Try every model on every object, in the picture: what the walk is checked against.
    pub exhaustive: bool,
    /// Kinds of models with more bytes than this are left out, but for the materials themselves.
    pub most_bytes: usize,
    /// A rung that the plan is compared with, used for everything.
    pub beside: Option<usize>,
}

/// The model of one object.
#[derive(Clone, Debug)]
pub struct Choice {
    /// Place of the model's kind on the ladder.
    pub rung: usize,
    /// Mean FLIP on the object's pixels, everything planned.
    pub error: f64,
    /// Nanoseconds per evaluation.
    pub ns: f64,
    /// Bytes of the material.
    pub bytes: usize,
    /// Where nothing but the material itself is within the tolerance: the closest of the others that were tried, and its
    /// error.
    pub unmet: Option<(usize, f64)>,
    /// Nanoseconds and bytes of the model that the plan is compared with, timed beside this one.
    pub beside: Option<(f64, usize)>,
}

/// A model for every object, and what becomes of the picture.
#[derive(Clone, Debug)]
pub struct Plan {
    /// In the order of the scene's objects.
    pub choices: Vec<Choice>,
    /// The linear picture of the materials themselves.
    pub reference: Image,
    /// That of the models.
    pub planned: Image,
    /// What evaluation and storage of the whole scene cost.
    pub totals: Totals,
    /// The same with the rung that the plan is compared with; none where a material has no such model.
    pub beside: Option<Totals>,
    /// How many models were made.
    pub tried: usize,
}

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The user has asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// A material that cannot be used at all.
    #[error("{0}")]
    Encode(#[source] EncodeError),
}

/// Who is told of every model that was tried, and who may stop the work.
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Called with the object's place and the name of the kind.
    pub tried: &'a (dyn Fn(usize, &str) + Sync),
    /// Asked before every model.
    pub cancelled: &'a (dyn Fn() -> bool + Sync),
}

#[cfg(test)]
mod tests;
