//! What the Tab key offers.

use std::process::Command;

use super::support::Place;

#[test]
fn completions_are_scripts() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        assert!(Place::new().run(&["completions", shell]).text().contains("nbrdf"), "{shell}");
    }
    for (shell, files) in [("zsh", "'files:file:_files'"), ("fish", "using_subcommand render\" -a \"alum-bronze")] {
        assert!(Place::new().run(&["completions", shell]).text().contains(files), "{shell}");
    }
}

/// What the script offers after these words; none where there is no bash.
fn offered(place: &Place, words: &str) -> Option<String> {
    let line = format!(
        "source ./script; COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); \
         _nbrdf nbrdf \"${{COMP_WORDS[COMP_CWORD]}}\" \"${{COMP_WORDS[COMP_CWORD-1]}}\"; echo \"${{COMPREPLY[*]}}\""
    );
    let output = Command::new("bash").args(["-c", &line]).current_dir(place.path()).output().ok()?;
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8(output.stdout).unwrap().trim().to_owned())
}

#[test]
fn names_of_the_catalog_and_materials_are_offered_and_files_where_no_name_fits() {
    let place = Place::new();
    place.write("script", &place.run(&["completions", "bash"]).ok());
    place.write("gold.npz", b"");
    for (words, expected) in [
        ("nbrdf info gold-p", "gold-paint"),
        ("nbrdf render rgl/paper_w", "rgl/paper_white"),
        ("nbrdf blend chrome bras", "brass"),
        ("nbrdf encode chrome --with charting_1", "charting_15"),
        ("nbrdf blend chrome brass --method log_", "log_mix"),
        ("nbrdf export chrome --to mt", "mtlx"),
        ("nbrdf render chrome --light s", "studio"),
        ("nbrdf learn optimal_sampling_2", "optimal_sampling_20"),
        ("nbrdf stress --hazard mirr", "mirror"),
        ("nbrdf info ./gol", ""),
    ] {
        let Some(offered) = offered(&place, words) else {
            println!("SKIPPED: no bash");
            return;
        };
        assert_eq!(offered, expected, "{words}");
    }
    // Bash itself offers files where the script has nothing.
    let script = String::from_utf8(place.file("script")).unwrap();
    assert!(script.lines().filter(|line| line.contains("complete -F")).all(|line| line.contains("-o default")));
}
