//! One command of a transcript, and what it says.

use std::path::Path;
use std::process::{Command, Stdio};

use snapbox::{Assert, IntoData as _};

/// A command as a user types it, pipes and all.
pub struct Step {
    /// Page and line.
    pub place: String,
    /// What is typed; more lines after the first begin with `> ` on the page.
    pub command: String,
    /// What is printed on both outputs: `[..]` is anything, a line `...` any lines, and a last line `? 2` the exit code
    /// unless that is 0.
    pub expected: String,
}

/// The steps of a page: what stands in its blocks of `console`.
pub fn steps(name: &str, page: &str) -> Vec<Step> {
    let mut steps: Vec<Step> = Vec::new();
    let mut is_transcript = false;
    for (line, text) in page.lines().enumerate() {
        if let Some(language) = text.strip_prefix("```") {
            is_transcript = language == "console";
            continue;
        }
        if !is_transcript {
            continue;
        }
        if let Some(command) = text.strip_prefix("$ ") {
            let place = format!("docs/{name}:{}", line + 1);
            steps.push(Step { place, command: command.into(), expected: String::new() });
        } else if let Some(step) = steps.last_mut() {
            match text.strip_prefix("> ").filter(|_| step.expected.is_empty()) {
                Some(more) => step.command += &format!("\n{more}"),
                None => step.expected += &format!("{text}\n"),
            }
        }
    }
    steps
}

impl Step {
    /// Runs the command in a folder; what differs from what is expected, if anything does.
    pub fn run(&self, folder: &Path) -> Result<(), String> {
        let program = Path::new(env!("CARGO_BIN_EXE_nbrdf")).parent().unwrap().display();
        let path = format!("{program}:{}", std::env::var("PATH").unwrap_or_default());
        let mut shell = Command::new("sh");
        // In the order in which a terminal would show both outputs.
        shell.arg("-c").arg(format!("exec 2>&1\n{}", self.command));
        // Without published data, so that the built-in networks are what is measured against on every machine.
        shell.current_dir(folder).env("PATH", path).env("NBRDF_DATA", "none").stdin(Stdio::null());
        let output = shell.output().unwrap();
        let mut said = String::from_utf8(output.stdout).unwrap();
        if let Some(code) = output.status.code().filter(|&code| code != 0) {
            said += &format!("? {code}\n");
        }
        let same =
            Assert::new().try_eq(Some(&"what the program says"), said.into_data(), self.expected.as_str().into_data());
        same.map_err(|difference| format!("{}: $ {}\n{difference}", self.place, self.command))
    }
}
