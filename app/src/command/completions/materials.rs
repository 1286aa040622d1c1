//! Names of materials for the Tab key, where a path would do as well.

use clap::builder::PossibleValuesParser;
use clap::{Arg, Command, CommandFactory as _};
use clap_complete::Shell;
use nbrdf_core::library::builtin;

use crate::cli::Cli;

fn names() -> Vec<&'static str> {
    builtin::shared().iter().map(|entry| entry.name.as_str()).collect()
}

fn is_material(arg: &Arg) -> bool {
    arg.get_value_names().is_some_and(|names| names.iter().any(|name| name.starts_with("MATERIAL")))
}

/// The program as completion scripts are to know it: materials are those that are built in.
pub(super) fn command() -> Command {
    let listed = |arg: Arg| match is_material(&arg) {
        true => arg.value_parser(PossibleValuesParser::new(names())),
        false => arg,
    };
    Cli::command().mut_subcommands(|command| command.mut_args(listed))
}

/// The script, which also offers files where materials are asked for. Bash does so by itself where no name fits.
pub(super) fn with_files(shell: Shell, script: String) -> String {
    let names = names().join(" ");
    match shell {
        Shell::Zsh => {
            let function =
                format!("_nbrdf_materials() {{ _alternative 'materials:material:({names})' 'files:file:_files' }}");
            let script = script.replace(&format!("({names})"), "_nbrdf_materials");
            script.replacen("\n\n", &format!("\n\n{function}\n\n"), 1)
        }
        // The generator leaves out what is no switch.
        Shell::Fish => {
            let command = command();
            let takers = command.get_subcommands().filter(|command| command.get_positionals().any(is_material));
            let line = |command: &Command| {
                let name = command.get_name();
                format!("complete -c nbrdf -n \"__fish_nbrdf_using_subcommand {name}\" -a \"{names}\"\n")
            };
            script + &takers.map(line).collect::<String>()
        }
        _ => script,
    }
}
