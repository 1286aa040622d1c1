//! The command line.

use std::ffi::OsString;
use std::process::ExitCode;

use anyhow::Result;
use clap::{Arg, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};
use nbrdf_core::simd::{InstructionSet, VARIABLE};

use crate::command::Global;
use crate::command::{
    axes::Axes, blend::Blend, chart::Chart, compare::Compare, completions::Completions, decode::Decode, edit::Edit,
    encode::Encode, evaluate::Evaluate, export::Export, fit::Fit, import::Import, info::Info, learn::Learn,
    linear::Linear, list::List, man::Man, manifold::Manifold, plan::Plan, reconstruct::Reconstruct, render::Render,
    sampling::Sampling, speed::Speed, stress::Stress, train::Train,
};
use crate::failure::{Failure, advice, exit_code};
use crate::visible::visible;

/// Measured materials as 32 numbers: walk between them, render them, judge them.
#[derive(Debug, Parser)]
#[command(name = "nbrdf", version, about)]
pub struct Cli {
    #[command(flatten)]
    global: Global,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    List(List),
    Info(Info),
    #[cfg(feature = "gui")]
    App(crate::gui::App),
    Import(Import),
    Fit(Fit),
    Train(Train),
    Learn(Learn),
    Encode(Encode),
    Decode(Decode),
    Export(Export),
    Blend(Blend),
    Edit(Edit),
    Render(Render),
    Evaluate(Evaluate),
    Compare(Compare),
    Axes(Axes),
    Linear(Linear),
    Manifold(Manifold),
    Sampling(Sampling),
    Reconstruct(Reconstruct),
    Chart(Chart),
    Plan(Plan),
    Stress(Stress),
    Speed(Speed),
    Completions(Completions),
    Man(Man),
}

/// Parses the arguments and runs; the exit code says how it went.
pub fn run() -> ExitCode {
    let cli = Cli::of(std::env::args_os()).unwrap_or_else(|error| error.exit());
    match cli.execute() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let text = match advice(&error) {
                Some(advice) => format!("error: {error:#}: {advice}"),
                None => format!("error: {error:#}"),
            };
            eprintln!("{}", visible(&text));
            ExitCode::from(exit_code(&error))
        }
    }
}

/// Refuses a set of instructions that this processor does not have.
fn check_instructions() -> Result<()> {
    let Err(found) = InstructionSet::asked() else { return Ok(()) };
    let here: Vec<&str> = InstructionSet::available().into_iter().map(InstructionSet::name).collect();
    Err(Failure::Usage(format!("{VARIABLE}: expected one of {}, found '{found}'", here.join(", "))).into())
}

impl Cli {
    /// What words ask for, the program's name first.
    ///
    /// # Errors
    /// As `clap` says it, help and version included.
    pub fn of<T: Into<OsString> + Clone>(words: impl IntoIterator<Item = T>) -> Result<Self, clap::Error> {
        // A negative number is a value that is out of range, not the name of a switch.
        let with_negatives = |arg: Arg| match arg.get_action().takes_values() && !arg.is_positional() {
            true => arg.allow_negative_numbers(true),
            false => arg,
        };
        let command = Self::command().mut_args(with_negatives);
        let command = command.mut_subcommands(|subcommand| subcommand.mut_args(with_negatives));
        Self::from_arg_matches(&command.try_get_matches_from(words)?)
    }

    fn execute(&self) -> Result<()> {
        check_instructions()?;
        if let Some(threads) = self.global.threads {
            rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global()?;
        }
        match &self.command {
            Some(Command::List(command)) => command.run(&self.global),
            Some(Command::Info(command)) => command.run(&self.global),
            Some(Command::Import(command)) => command.run(&self.global),
            Some(Command::Fit(command)) => command.run(&self.global),
            Some(Command::Train(command)) => command.run(&self.global),
            Some(Command::Learn(command)) => command.run(&self.global),
            Some(Command::Evaluate(command)) => command.run(&self.global),
            Some(Command::Compare(command)) => command.run(&self.global),
            Some(Command::Linear(command)) => command.run(&self.global),
            Some(Command::Sampling(command)) => command.run(&self.global),
            Some(Command::Reconstruct(command)) => command.run(&self.global),
            Some(Command::Chart(command)) => command.run(&self.global),
            Some(Command::Plan(command)) => command.run(&self.global),
            Some(Command::Stress(command)) => command.run(&self.global),
            Some(Command::Speed(command)) => command.run(&self.global),
            Some(Command::Encode(command)) => command.run(&self.global),
            Some(Command::Decode(command)) => command.run(&self.global),
            Some(Command::Export(command)) => command.run(&self.global),
            Some(Command::Blend(command)) => command.run(&self.global),
            Some(Command::Edit(command)) => command.run(&self.global),
            Some(Command::Axes(command)) => command.run(&self.global),
            Some(Command::Manifold(command)) => command.run(&self.global),
            Some(Command::Render(command)) => command.run(&self.global),
            Some(Command::Completions(command)) => command.run(),
            Some(Command::Man(command)) => command.run(&self.global),
            #[cfg(feature = "gui")]
            Some(Command::App(app)) => app.run(),
            #[cfg(feature = "gui")]
            None => crate::gui::run(Vec::new()),
            #[cfg(not(feature = "gui"))]
            None => anyhow::bail!("this build has no window: `nbrdf --help` names the commands"),
        }
    }
}
