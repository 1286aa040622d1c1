//! `nbrdf plan`: the smallest model of every material that serves a scene.

mod check;
mod curve;
mod distance;
mod export;
mod look;
mod picture;
mod summary;
mod tolerance;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use anyhow::Result;
use clap::{Args, ValueEnum};
use nbrdf_core::plan::{By, Models, Options, Plan as Planned, Planner, TOLERANCE, Watch};

use super::Global;
use crate::catalog::{Catalog, Reference};
use crate::failure::Failure;
use crate::measure::planned::Opened;
use crate::{output, progress, report};

/// Finds the cheapest model of every object's material that nobody can tell from the material itself.
///
/// Scenes are TOML: scenes/shelf.toml is one, docs/scenes.md tells every key.
#[derive(Debug, Args)]
pub struct Plan {
    /// File of a scene.
    #[arg(value_name = "SCENE.toml")]
    scene: PathBuf,
    /// Mean FLIP that an object's pixels may have: above 0, 1 at most; that of the scene by default, else 0.04.
    #[arg(long, value_name = "X", value_parser = tolerance)]
    tolerance: Option<f64>,
    /// What is to be least; within a tenth of the least time, fewest bytes.
    #[arg(long, value_enum, default_value_t = Least::Time)]
    by: Least,
    /// Leave out kinds of models of more bytes: 1000000 leaves out tables.
    #[arg(long, value_name = "BYTES", default_value_t = usize::MAX, hide_default_value = true)]
    most_bytes: usize,
    /// Picture (.png) of full models, planned models and their difference, plan.png by default; of a sweep its chart (.svg or
    /// .png), plan.svg by default.
    #[arg(short, long, value_name = "PICTURE")]
    output: Option<PathBuf>,
    /// Folder for the chosen models' files, and which object takes which.
    #[arg(long, value_name = "DIR", conflicts_with = "sweep")]
    export: Option<PathBuf>,
    /// Plan again and again: over tolerances, or over distances of the camera from one object.
    #[arg(long, value_enum, value_name = "WHAT")]
    sweep: Option<Sweep>,
    /// Object whose distance is swept.
    #[arg(long, value_name = "NAME", requires = "sweep")]
    object: Option<String>,
    /// Also try every model on every object, and tell where the plan differs and how long both took.
    #[arg(long, conflicts_with = "sweep")]
    check: bool,
    /// Library whose names are meant: a folder or an archive; the built-in one by default.
    #[arg(long, value_name = "PATH")]
    library: Option<PathBuf>,
    /// Another ZNBRDF checkpoint, of any length, whose codes may be chosen too; may be repeated.
    #[arg(long, value_name = "CKPT")]
    checkpoint: Vec<PathBuf>,
}

/// What is to be least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Least {
    /// Time of evaluation.
    Time,
    /// Bytes, what several models share counted once.
    Bytes,
}

/// What changes from plan to plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Sweep {
    /// The tolerance.
    Tolerance,
    /// The camera's distance from one object.
    Distance,
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "expected a number".to_owned())?;
    if value > 0.0 && value <= 1.0 { Ok(value) } else { Err("expected a number above 0, 1 at most".to_owned()) }
}

impl Plan {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        self.check_switches()?;
        let (default, forms): (_, &[&str]) = match self.sweep {
            None => ("plan.png", &["png"]),
            Some(_) => ("plan.svg", &["svg", "png"]),
        };
        let output = self.output.clone().unwrap_or_else(|| default.into());
        output::check(&output, forms)?;
        if let Some(folder) = &self.export {
            output::make_folder(folder)?;
        }
        let catalog = Arc::new(Catalog::new(Arc::new(Reference::built_in())));
        let opened = Opened::load(&self.scene, self.library.as_deref(), &self.checkpoint, &catalog)?;
        let by = if self.by == Least::Time { By::Time } else { By::Bytes };
        let tolerance = self.tolerance.or(opened.scene.tolerance).unwrap_or(TOLERANCE);
        let options = opened.options(tolerance, by, self.most_bytes);
        match self.sweep {
            None => self.once(&opened, options, &output, global),
            Some(Sweep::Tolerance) => tolerance::sweep(&opened, options, &output, global),
            Some(Sweep::Distance) => {
                let object = look::object(&opened, self.object.as_deref())?;
                distance::sweep(&opened, object, options, &output, global)
            }
        }
    }

    /// Refuses what a sweep would not heed.
    fn check_switches(&self) -> Result<()> {
        let unheeded = match self.sweep {
            Some(Sweep::Tolerance) if self.tolerance.is_some() => "--tolerance: a sweep of the tolerance has its own",
            Some(Sweep::Tolerance) if self.object.is_some() => "--object: a sweep of the tolerance is of all objects",
            Some(Sweep::Distance) if self.by == Least::Bytes => "--by bytes: a sweep of the distance is by time",
            _ => return Ok(()),
        };
        Err(Failure::Usage(format!("{unheeded}: leave it out")).into())
    }

    fn once(&self, opened: &Opened, options: Options, output: &Path, global: &Global) -> Result<()> {
        let view = look::whole(opened, global)?;
        let models = Models::new(&opened.materials, &opened.ladder);
        let start = Instant::now();
        let planner = Planner::new(&view, &models, &opened.material)?;
        let plan = watched(&planner, options, global)?;
        let seconds = start.elapsed().as_secs_f64();
        refuse_if_nothing_serves(opened, &planner, &plan, options)?;
        let mut summary = summary::json(opened, &planner, &plan, options, seconds);
        if self.check {
            summary["check"] = check::json(opened, &planner, &plan, options, seconds, global)?;
        }
        output::write_picture(output, &picture::triptych(&self.scene, &view, &plan, &summary))?;
        if let Some(folder) = &self.export {
            export::export(folder, opened, &planner, &plan)?;
        }
        report::print(global, &summary, || summary::text(&summary, output))
    }
}

/// A plan, with a bar that tells what is tried.
fn watched(planner: &Planner, options: Options, global: &Global) -> Result<Planned> {
    let bar = progress::spinner("planning", global.quiet);
    let tried = |object: usize, name: &str| {
        bar.set_message(format!("object {}: {name}", object + 1));
        bar.inc(1);
    };
    let plan = planner.plan(options, &Watch { tried: &tried, cancelled: &progress::cancelled });
    bar.finish_and_clear();
    Ok(plan?)
}

/// A tolerance that nothing meets but the materials themselves is one of the scene's mistakes.
fn refuse_if_nothing_serves(opened: &Opened, planner: &Planner, plan: &Planned, options: Options) -> Result<()> {
    let all_unmet = |plan: &Planned| plan.choices.iter().all(|choice| choice.unmet.is_some());
    if !all_unmet(plan) {
        return Ok(());
    }
    // What is dearer than the materials themselves was not tried yet.
    let watch = Watch { tried: &|_, _| {}, cancelled: &progress::cancelled };
    let plan = planner.plan(Options { exhaustive: true, ..options }, &watch)?;
    if !all_unmet(&plan) {
        return Ok(());
    }
    let closest = plan.choices.iter().enumerate().filter_map(|(object, choice)| Some((object, choice.unmet?)));
    let closest = closest.min_by(|a, b| a.1.1.total_cmp(&b.1.1)).map_or_else(String::new, |(object, (rung, error))| {
        let (model, name) = (&opened.ladder[rung].name, &opened.scene.objects[object].name);
        format!(" (the closest is {model} of '{name}' at {})", report::figure(error))
    });
    let (scene, tolerance) = (opened.path.display(), options.tolerance);
    Err(Failure::InvalidFile(format!(
        "{scene}: expected a tolerance that some model meets, found {tolerance}, which only the materials themselves \
         meet{closest}: raise it"
    ))
    .into())
}
