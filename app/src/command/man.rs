//! `nbrdf man`: manual pages.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, Command, CommandFactory};
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

fn page(command: Command) -> Result<(String, Vec<u8>)> {
    let is_program = command.get_display_name().is_none_or(|name| name == "nbrdf");
    let page = Page::new(command).source(SOURCE).manual("nbrdf manual");
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
