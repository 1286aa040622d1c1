//! The report: printed by `--json`, drawn again by `--from`, kept beside the page while it is not finished.

use std::fmt::Display;
use std::path::Path;

use anyhow::Result;
use nbrdf_core::stress::{Group, Hazard, Verdict};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::measure::stress::{Cell, Extent, Setup, hazards};

/// Largest report that is read \[bytes\]: with its pictures it has some 15 million.
const MAX_BYTES: u64 = 256 << 20;

/// Most cells that are drawn.
const MOST_CELLS: usize = 3000;

/// What was measured.
#[derive(Deserialize, Serialize)]
pub struct Saved {
    /// Of the report: 1.
    pub schema: u32,
    /// Where the reference materials come from.
    pub reference: String,
    /// The mark of the ZNBRDF checkpoint.
    pub checkpoint: String,
    /// Mark of what is measured against, by which hazards and with which version: a run goes on with its own work only.
    pub work: String,
    /// How much was asked for.
    pub extent: Extent,
    /// How much there was of that.
    pub counted: Extent,
    /// Of everything random.
    pub seed: u64,
    /// Names that were asked for; none where all were.
    pub asked: [Vec<String>; 2],
    /// Kinds of hazards that are finished.
    pub groups: Vec<Group>,
    /// The cells.
    pub cells: Vec<Cell>,
}

impl Saved {
    /// Before anything is measured.
    ///
    /// # Errors
    /// Where there are too few materials.
    pub fn new(setup: &Setup) -> Result<Self> {
        Ok(Self {
            schema: 1,
            reference: setup.catalog.reference().kind.clone(),
            checkpoint: setup.catalog.mark(),
            work: setup.work(),
            extent: setup.extent,
            counted: setup.counted()?,
            seed: setup.seed,
            asked: [setup.hazards.clone(), setup.methods.clone()],
            groups: Vec::new(),
            cells: Vec::new(),
        })
    }

    /// Reads a report.
    pub fn load(path: &Path) -> Result<Self> {
        let name = path.display().to_string();
        let bytes = nbrdf_core::bounded::read(path, MAX_BYTES).map_err(|error| invalid(&name, &error))?;
        let bytes = bytes.ok_or_else(|| invalid(&name, &format_args!("more than {MAX_BYTES} bytes")))?;
        Self::parse(&name, &bytes)
    }

    /// The report in bytes that came from `path`.
    pub fn parse(path: &str, bytes: &[u8]) -> Result<Self> {
        let invalid = |found: &dyn Display| invalid(path, found);
        let saved: Self = serde_json::from_slice(bytes).map_err(|error| invalid(&error))?;
        if saved.schema != 1 {
            return Err(invalid(&format_args!("schema {}", saved.schema)).into());
        }
        if saved.cells.len() > MOST_CELLS {
            return Err(invalid(&format_args!("{} cells, of {MOST_CELLS} at most", saved.cells.len())).into());
        }
        let known = hazards();
        for cell in &saved.cells {
            let hazard = known.iter().find(|hazard| hazard.name == cell.hazard && hazard.group == cell.group);
            let hazard = hazard
                .ok_or_else(|| invalid(&format_args!("the hazard {:?}, which is not known here", cell.hazard)))?;
            if !cell.is_sound(hazard) {
                let found = format!("a cell of {:?} whose verdict nobody gives here", cell.hazard);
                return Err(invalid(&found).into());
            }
        }
        Ok(saved)
    }

    /// Goes on from another one, which must be of the same work.
    pub fn resumed(self, other: Self, path: &Path) -> Result<Self> {
        let is_same = self.work == other.work
            && self.reference == other.reference
            && self.checkpoint == other.checkpoint
            && self.extent == other.extent
            && self.seed == other.seed
            && self.asked == other.asked;
        if !is_same {
            let found = format!("{} is of other materials, hazards, methods, another seed or version", path.display());
            return Err(Failure::InvalidFile(format!("{found}: leave out --resume to start anew")).into());
        }
        Ok(other)
    }

    /// The hazards that were measured, in order.
    pub fn hazards(&self) -> Vec<&'static Hazard> {
        hazards().into_iter().filter(|hazard| self.cells.iter().any(|cell| cell.hazard == hazard.name)).collect()
    }

    /// Titles of the methods with cells of these groups, in the order of the first cells.
    pub fn methods(&self, is_walk: bool) -> Vec<String> {
        let mut titles: Vec<String> = Vec::new();
        for cell in self.cells.iter().filter(|cell| (cell.group == Group::Paths) == is_walk) {
            let title = cell.title();
            if !titles.contains(&title) {
                titles.push(title);
            }
        }
        titles
    }

    /// The cell of a hazard and a method's title.
    pub fn cell(&self, hazard: &Hazard, title: &str) -> Option<&Cell> {
        self.cells.iter().find(|cell| cell.hazard == hazard.name && cell.title() == title)
    }

    /// How many cells have this verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.cells.iter().filter(|cell| cell.verdict == verdict).count()
    }

    /// The report, without pictures.
    pub fn json(&self) -> Value {
        let mut value = json!(self);
        for cell in value["cells"].as_array_mut().into_iter().flatten() {
            cell.as_object_mut().map(|cell| cell.remove("picture"));
        }
        let verdicts = Verdict::ALL.map(|verdict| (verdict.name(), self.count(verdict)));
        value["verdicts"] = verdicts.into_iter().collect::<std::collections::BTreeMap<_, _>>().into_iter().collect();
        value["hazards"] = self
            .hazards()
            .into_iter()
            .map(|h| json!({"name": h.name, "group": h.group, "title": h.title, "measure": h.measure, "threshold": {"holds": h.holds, "fails": h.fails}}))
            .collect();
        value
    }
}

fn invalid(path: &str, found: &dyn Display) -> Failure {
    Failure::InvalidFile(format!("{path}: expected a report of `nbrdf stress --json`, found {found}: make it again"))
}
