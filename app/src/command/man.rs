//! `nbrdf man`: manual pages.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::builder::PossibleValue;
use clap::{Arg, ArgAction, Args, Command, CommandFactory};
use clap_mangen::Man as Page;
use clap_mangen::roff::{Roff, bold, roman};
use nbrdf_core::atomic;
use serde_json::json;

use super::Global;
use crate::cli::Cli;
use crate::{output, report};

/// What `man` shows as the source of a page.
const SOURCE: &str = concat!("nbrdf ", env!("CARGO_PKG_VERSION"));
/// Exit codes, and when a command ends with which.
const EXIT_CODES: [(&str, &str); 4] = [
    ("0", "What was asked for is done."),
    ("1", "It failed: a warning under --strict, a full disk, an interrupt."),
    ("2", "The command line makes no sense: an unknown name, a value out of range."),
    ("3", "A file is not what it should be, is not there, or cannot be written."),
];

/// Writes manual pages: nbrdf.1, and one for each command, such as nbrdf-encode.1.
#[derive(Debug, Args)]
pub struct Man {
    /// Folder to write them into, such as ~/.local/share/man/man1.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

impl Man {
    /// Runs the command.
    pub fn run(&self, global: &Global) -> Result<()> {
        let pages = pages()?;
        output::make_folder(&self.output)?;
        for (name, page) in &pages {
            let path = self.output.join(name);
            atomic::write(&path, page).with_context(|| format!("{}: cannot be written", path.display()))?;
        }
        let folder = self.output.display().to_string();
        let names: Vec<&str> = pages.iter().map(|(name, _)| name.as_str()).collect();
        let summary = json!({"schema": 1, "output": folder, "pages": names});
        report::print(global, &summary, || format!("{} pages in {folder}\n", pages.len()))
    }
}

/// The file name and the text of every page: that of the program, and those of its commands.
fn pages() -> Result<Vec<(String, Vec<u8>)>> {
    let mut program = Cli::command().disable_help_subcommand(true);
    program.build();
    let commands: Vec<Command> = program.get_subcommands().cloned().collect();
    std::iter::once(program).chain(commands).map(page).collect()
}

/// Every switch with its value, what may be left out in brackets.
fn synopsis(command: &Command) -> String {
    let shown = |arg: &&Arg| !arg.is_hide_set() && !matches!(arg.get_id().as_str(), "help" | "version");
    let (positional, switches): (Vec<&Arg>, Vec<&Arg>) =
        command.get_arguments().filter(shown).partition(|arg| arg.is_positional());
    let (of_all, own): (Vec<&Arg>, Vec<&Arg>) = switches.into_iter().partition(|arg| arg.is_global_set());
    let words = own.into_iter().chain(of_all).chain(positional).map(word);
    let last = command.has_subcommands().then(|| "[COMMAND]".to_owned());
    let name = command.get_bin_name().unwrap_or_else(|| command.get_name()).to_owned();
    std::iter::once(name).chain(words).chain(last).collect::<Vec<_>>().join(" ")
}

/// Names without a word about each in one line instead of one each.
fn in_a_line(arg: Arg) -> Arg {
    let values = arg.get_possible_values();
    if values.is_empty() || arg.is_hide_possible_values_set() || values.iter().any(|value| value.get_help().is_some()) {
        return arg;
    }
    let names: Vec<&str> = values.iter().map(PossibleValue::get_name).collect();
    let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
    let help = format!("{help}: one of {}", names.join(", "));
    arg.help(help).hide_possible_values(true)
}

/// One argument of a synopsis.
fn word(arg: &Arg) -> String {
    let is_again = matches!(arg.get_action(), ArgAction::Append) && !arg.is_positional();
    let again = if is_again && !arg.to_string().ends_with("...") { "..." } else { "" };
    match arg.is_required_set() || arg.is_positional() {
        true => format!("{arg}{again}"),
        false => format!("[{arg}]{again}"),
    }
}

fn page(command: Command) -> Result<(String, Vec<u8>)> {
    let is_program = command.get_display_name().is_none_or(|name| name == "nbrdf");
    let usage = synopsis(&command);
    let page = Page::new(command.mut_args(in_a_line).override_usage(usage)).source(SOURCE).manual("nbrdf manual");
    let mut text = Vec::new();
    page.render(&mut text)?;
    let mut end = Roff::new();
    end.control("SH", ["EXIT STATUS"]);
    for (code, meaning) in EXIT_CODES {
        end.control("TP", []).text([bold(code)]).text([roman(meaning)]);
    }
    if !is_program {
        end.control("SH", ["SEE ALSO"]).text([bold("nbrdf"), roman("(1)")]);
    }
    end.to_writer(&mut text)?;
    Ok((page.get_filename(), text))
}
