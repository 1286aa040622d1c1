//! The measuring, group by group; what is done is kept.

use std::path::PathBuf;

use anyhow::{Context, Result};
use nbrdf_core::stress::Group;

use super::{Saved, Stress, write};
use crate::catalog::Catalog;
use crate::command::Global;
use crate::failure::Failure;
use crate::measure::stress::{Extent, Setup};
use crate::progress;
use crate::report::saved::SavedReport;

impl Stress {
    /// Measures what was asked for.
    pub(super) fn measure(&self, global: &Global) -> Result<Saved> {
        let catalog = Catalog::for_measuring(self.reference.as_deref(), self.checkpoint.as_deref())?;
        let extent = if self.quick { Extent::QUICK } else { Extent::FULL };
        let extent = Extent { steps: self.steps.map_or(extent.steps, |steps| steps as usize), ..extent };
        let setup = Setup {
            catalog: &catalog,
            extent,
            seed: global.seed(),
            hazards: self.hazards.clone(),
            methods: self.methods.clone(),
        };
        let mut saved = Saved::new(&setup)?;
        let partial = self.partial();
        match (self.resume, partial.exists()) {
            (true, true) => saved = saved.resumed(Saved::load(&partial)?, &partial)?,
            (true, false) => {
                global.warn(format_args!("nothing to go on from at {}: starting anew", partial.display()))?;
            }
            (false, true) => global.warn(format_args!(
                "{} of an interrupted run is written over: --resume would go on with it",
                partial.display()
            ))?,
            (false, false) => {}
        }
        let is_resumed = !saved.groups.is_empty();
        let bar = progress::spinner("measuring", global.quiet);
        for group in Group::ALL {
            if saved.groups.contains(&group) || !setup.wants_any(group) {
                continue;
            }
            let cells = setup.measure(group, &|what| {
                progress::check()?;
                bar.set_message(format!("{}: {what}", group.name()));
                bar.inc(1);
                Ok(())
            });
            saved.cells.extend(cells.with_context(|| self.advice(&saved))?);
            saved.groups.push(group);
            // What is done is done: the next run may go on from here.
            if !saved.cells.is_empty() {
                write(&partial, &serde_json::to_string(&saved)?)?;
            }
        }
        bar.finish_and_clear();
        // Whoever asked for a basis before the interruption is not known any more.
        if !is_resumed {
            catalog.check_used()?;
        }
        if saved.cells.is_empty() {
            return Err(Failure::Usage("no such method is exposed to such a hazard: name others".into()).into());
        }
        Ok(saved)
    }

    /// Where the groups that are done wait for the others.
    pub(super) fn partial(&self) -> PathBuf {
        self.output.with_extension("partial.json")
    }

    fn advice(&self, saved: &Saved) -> String {
        match saved.groups.is_empty() {
            true => "nothing was finished".to_owned(),
            false => format!("{} keeps what was finished: go on with --resume", self.partial().display()),
        }
    }
}
