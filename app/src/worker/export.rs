//! The thread that writes files, and codes of points for the clipboard.

mod code;
mod curve;
mod goods;
mod job;
mod made;
mod manifest;
mod materials;
mod painter;
mod pictures;
mod places;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, mpsc};

use anyhow::{Result, bail};
use nbrdf_core::atomic;

use super::{Answer, Office, Request, guarded};
use crate::catalog::ExporterEntry;
use crate::exported;
use made::Made;

pub use goods::{Goods, PictureForm};
pub use job::Job;
pub use pictures::SAMPLES;

/// What is said of work that was given up.
const STOPPED: &str = "it was stopped";

/// Most bytes of one export: they are all in memory before any is written.
const MOST_BYTES: usize = 1 << 30;

/// What the thread is asked to do.
pub(super) enum Order {
    /// Which of these files are there?
    Look(Vec<PathBuf>),
    /// Write files.
    Write(Box<Job>),
    /// The code of the point that is shown.
    Code(Box<Request>),
}

/// What the thread has to say.
#[derive(Debug)]
pub enum News {
    /// Those of the files that are there.
    Present {
        /// All that was asked about.
        asked: Vec<PathBuf>,
        /// Those that are there.
        there: Vec<PathBuf>,
    },
    /// How much is done, 0..1.
    Progress(f32),
    /// Files that were written.
    Written {
        /// The manifest first.
        files: Vec<PathBuf>,
        /// What is to be known of them.
        warning: Option<String>,
    },
    /// Nothing was written, for this reason.
    Failed(String),
    /// The code that was asked for.
    Code(String),
    /// There is no such code, for this reason.
    NoCode(String),
}

/// The thread's memory.
pub(super) struct Exporter {
    office: Office,
    stop: Arc<AtomicBool>,
}

/// Follows one order after the other until nobody can give any.
pub(super) fn run(office: Office, stop: Arc<AtomicBool>, orders: &mpsc::Receiver<Order>) {
    let exporter = Exporter { office, stop };
    for order in orders.iter().take_while(|_| !exporter.office.activity.is_over()) {
        let _busy = exporter.office.activity.begin();
        let news = match order {
            Order::Look(asked) => {
                let there = asked.iter().filter(|path| path.symlink_metadata().is_ok()).cloned().collect();
                News::Present { asked, there }
            }
            Order::Write(job) => match done("Writing", || exporter.write(&job)) {
                Ok((files, warning)) => News::Written { files, warning },
                Err(why) => News::Failed(format!("Nothing was written: {why}")),
            },
            Order::Code(request) => match done("The code", || exporter.code(&request)) {
                Ok(text) => News::Code(text),
                Err(why) => News::NoCode(why),
            },
        };
        exporter.office.say(Answer::Export(news));
    }
}

/// What a job made; errors and panics as one message.
fn done<T>(what: &str, job: impl FnOnce() -> Result<T>) -> Result<T, String> {
    guarded(what, job)?.map_err(|error| format!("{error:#}"))
}

impl Exporter {
    /// Writes everything or nothing; the files, the manifest first, and what is to be known of them.
    fn write(&self, job: &Job) -> Result<(Vec<PathBuf>, Option<String>)> {
        let paths = job.paths();
        // Before the work, not after it; the last time right before they are written.
        paths.iter().try_for_each(|path| atomic::check(path))?;
        refuse_to_replace(job, &paths)?;
        let made = self.make(job)?;
        let bytes: usize = made.files.iter().map(|(_, bytes)| bytes.len()).sum();
        if bytes > MOST_BYTES {
            bail!("all files together have more than {} MiB: choose fewer steps", MOST_BYTES >> 20);
        }
        let manifest = manifest::of(&self.office, job, &made)?;
        let form = ExporterEntry::named(job.goods.form());
        let warning = form.and_then(|form| made.errors.iter().find_map(|error| exported::warning(form, error)));
        let files: Vec<_> = std::iter::once((job.manifest(), manifest)).chain(made.files).collect();
        refuse_to_replace(job, &paths)?;
        // From here on there is no way back.
        self.go_on()?;
        atomic::write_together(&files)?;
        Ok((files.into_iter().map(|(path, _)| path).collect(), warning))
    }

    fn make(&self, job: &Job) -> Result<Made> {
        match job.goods {
            Goods::Material { card, form } => self.material(job, card, form),
            Goods::Steps { method, form, steps } => self.steps(job, method, form, steps),
            Goods::Picture { card, form, size } => self.picture(job, card, form, size.into()),
            Goods::Strip { form, size, steps } => self.strip(job, form, size.into(), steps).map(Made::of_many),
            Goods::Curve { steps } => self.curve(job, steps).map(Made::of_many),
        }
    }

    /// Tells how far the work is; an error once it is to be stopped.
    fn advance(&self, done: usize, of: usize) -> Result<()> {
        self.go_on()?;
        self.office.say(Answer::Export(News::Progress(done as f32 / of.max(1) as f32)));
        Ok(())
    }

    /// An error once the work is to be stopped.
    fn go_on(&self) -> Result<()> {
        if self.stop.load(Ordering::Relaxed) {
            bail!(STOPPED);
        }
        Ok(())
    }
}

fn refuse_to_replace(job: &Job, paths: &[PathBuf]) -> Result<()> {
    match paths.iter().find(|path| !job.is_replacing && path.symlink_metadata().is_ok()) {
        Some(path) => bail!("{} is there already", path.display()),
        None => Ok(()),
    }
}
