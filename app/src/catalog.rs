//! THE lists: every representation, interpolation and metric by name.
//!
//! A newcomer writes one file and adds one line to a list; command line, app, contract tests and result tables follow.
//! (A metric that `evaluate` should report also needs its line in `measure/target.rs`, which evaluates and renders once.)

mod bases;
pub mod exporters;
mod family;
mod held;
mod interpolations;
mod ladder;
mod learned;
mod once;
mod open;
mod reference;
mod representations;
mod twin;
mod unknown;
mod variant;

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::metric::{LogError, Metric, RelativeLog, Rendered};
use nbrdf_core::representation::basis::BasisFile;
use nbrdf_core::{Interpolation, Representation};

pub use exporters::{EXPORTERS, ExporterEntry};
pub use family::Family;
pub use interpolations::INTERPOLATIONS;
pub use ladder::{NBRDF, ladder};
pub use learned::{BasisSize, Catalog};
pub use reference::Reference;
pub use representations::REPRESENTATIONS;
pub use variant::Variant;

/// Numbers in a code of the learned representations, unless their names say otherwise.
pub const DIM: usize = 32;

type Shared = Arc<dyn Representation>;

/// A representation in the list.
pub struct RepresentationEntry {
    /// Name on the command line, in reports and in codes.
    pub name: &'static str,
    /// What it keeps of a material.
    pub family: Family,
    /// How its codes are made.
    pub variant: Variant,
    /// One line for people.
    pub about: &'static str,
    build: fn(&Catalog) -> Result<Shared>,
    /// What is learned, where that can be saved.
    basis: Option<Learned>,
}

/// What is learned of a representation.
#[derive(Clone, Copy)]
pub struct Learned {
    file: fn(&Catalog) -> Result<BasisFile>,
    /// Most numbers of another size than the name's ([`BasisSize::numbers`]); 0 where there is one size only.
    pub most_numbers: usize,
    /// Whether its tables can have other cells.
    pub has_grids: bool,
}

/// An interpolation in the list.
pub struct InterpolationEntry {
    /// Name on the command line and in reports.
    pub name: &'static str,
    /// Name for people.
    pub title: &'static str,
    /// One line for people.
    pub about: &'static str,
    build: fn(&Catalog) -> Result<Box<dyn Interpolation>>,
}

/// Every metric, in the order of reports.
pub fn metrics() -> Vec<Box<dyn Metric>> {
    let directions: [Box<dyn Metric>; 2] = [Box::new(LogError), Box::new(RelativeLog)];
    directions.into_iter().chain(Rendered::all().map(|metric| Box::new(metric) as Box<dyn Metric>)).collect()
}

impl RepresentationEntry {
    /// How its codes are made, where the list has other ways too.
    pub fn shown_variant(&self) -> Option<&'static str> {
        let others = REPRESENTATIONS.iter().filter(|other| other.name == self.name).count();
        (others > 1).then_some(self.variant.name())
    }

    /// Makes it; may learn a basis first.
    pub fn build(&self, catalog: &Catalog) -> Result<Shared> {
        (self.build)(catalog)
    }
}

impl InterpolationEntry {
    /// Makes it; may learn a basis first.
    pub fn build(&self, catalog: &Catalog) -> Result<Box<dyn Interpolation>> {
        (self.build)(catalog)
    }
}
