//! The report: printed by `--json`, drawn again by `--from`, kept beside the page while it is not finished.

use std::path::Path;

use anyhow::Result;
use nbrdf_core::stress::{Group, Hazard, Verdict};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::failure::Failure;
use crate::measure::stress::{Cell, Extent, Setup, hazards};
use crate::report::saved::SavedReport;

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

impl SavedReport for Saved {
    const COMMAND: &'static str = "stress";
    /// With its pictures it has some 15 million.
    const MAX_BYTES: u64 = 256 << 20;

    fn schema(&self) -> u32 {
        self.schema
    }

    fn check(&self) -> Result<(), String> {
        if self.cells.len() > MOST_CELLS {
            return Err(format!("{} cells, of {MOST_CELLS} at most", self.cells.len()));
        }
        let known = hazards();
        for cell in &self.cells {
            let hazard = known.iter().find(|hazard| hazard.name == cell.hazard && hazard.group == cell.group);
            let hazard = hazard.ok_or_else(|| format!("the hazard {:?}, which is not known here", cell.hazard))?;
            if !cell.is_sound(hazard) {
                return Err(format!("a cell of {:?} whose verdict nobody gives here", cell.hazard));
            }
        }
        Ok(())
    }
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
