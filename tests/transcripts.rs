//! docs/cli.md and docs/tour.md: their transcripts are run, and no command is left out.
#![cfg(unix)]

#[path = "transcripts/step.rs"]
mod step;

use clap::CommandFactory as _;
use nbrdf::cli::Cli;
use step::{Step, steps};

fn page(name: &str) -> String {
    std::fs::read_to_string(format!("{}/../docs/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn commands() -> Vec<String> {
    Cli::command().get_subcommands().map(|command| command.get_name().to_owned()).collect()
}

fn step(command: &str, expected: &str) -> Step {
    Step { place: "here:7".into(), command: command.into(), expected: expected.into() }
}

/// Runs all steps of a page in a folder of their own; so many there must be.
fn holds(name: &str, least: usize) {
    let folder = tempfile::tempdir().unwrap();
    let steps = steps(name, &page(name));
    assert!(steps.len() >= least, "{name} has only {} transcripts", steps.len());
    let wrong: Vec<String> = steps.iter().filter_map(|step| step.run(folder.path()).err()).collect();
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn the_program_says_what_its_page_says() {
    holds("cli.md", commands().len());
}

#[test]
fn the_tour_goes_as_it_is_told() {
    holds("tour.md", 10);
}

#[test]
fn every_command_has_its_section() {
    let page = page("cli.md");
    let lacks = |name: &String| !page.lines().any(|line| line == format!("### `nbrdf {name}`"));
    let missing: Vec<String> = commands().into_iter().filter(lacks).collect();
    assert!(missing.is_empty(), "docs/cli.md has no section for {}", missing.join(", "));
}

#[test]
fn every_command_has_its_manual_page_with_every_switch() {
    let folder = tempfile::tempdir().unwrap();
    step("nbrdf man -o man1", "[..] pages in man1\n").run(folder.path()).unwrap();
    let page = |name: &str| std::fs::read_to_string(folder.path().join("man1").join(name)).unwrap();
    assert!(page("nbrdf.1").contains("nbrdf\\-encode(1)"));
    for command in Cli::command().get_subcommands() {
        let page = page(&format!("nbrdf-{}.1", command.get_name()));
        assert!(page.contains("EXIT STATUS") && page.contains("\\-\\-threads"), "{page}");
        let shown = command.get_arguments().filter(|argument| !argument.is_hide_set());
        for switch in shown.filter_map(|argument| argument.get_long()) {
            let switch = format!("\\-\\-{}", switch.replace('-', "\\-"));
            assert!(page.contains(&switch), "{} lacks {switch}", command.get_name());
        }
    }
}

#[test]
fn a_transcript_that_is_not_true_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let step = |expected: &str| step("nbrdf info chrme", expected);
    step("error: no material `chrme` in the library of [..]: did you mean `chrome`?\n? 2\n")
        .run(folder.path())
        .unwrap();
    let told = step("chrome\n...\n").run(folder.path()).unwrap_err();
    assert!(told.contains("here:7") && told.contains("did you mean"), "{told}");
}
