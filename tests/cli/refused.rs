//! What the system refuses: full disks, folders that are not to be written, files that are gone.

use std::process::{Command, Output};

use super::support::Place;

/// The program under a shell's limit on the length of files [blocks]: what a full disk does, for anybody.
fn run_full(place: &Place, blocks: u32, arguments: &str) -> Output {
    let line = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$NBRDF\" {arguments}");
    let mut shell = Command::new("sh");
    shell.args(["-c", &line]).env("NBRDF", env!("CARGO_BIN_EXE_nbrdf")).current_dir(place.path()).output().unwrap()
}

fn inputs() -> Place {
    let place = Place::new();
    place.library("some", ["chrome", "brass"]);
    place.write("a.csv", super::SAMPLES.as_bytes());
    place.write("scene.toml", super::SCENE.as_bytes());
    place
}

#[test]
fn a_full_disk_is_said_with_the_file_and_leaves_nothing() {
    let place = inputs();
    std::fs::create_dir(place.path().join("models")).unwrap();
    let before = place.names();
    for (blocks, file, arguments) in [
        (1, "out", "import some -o out"),
        (1, "a.npz", "fit a.csv -o a.npz --steps 5"),
        (1, "a.npy", "fit a.csv -o a.npy --steps 5"),
        (1, "a.safetensors", "train --architecture published --steps 2 -o a.safetensors"),
        (1, "a.safetensors", "learn pca_weights --numbers 3 -o a.safetensors"),
        (0, "a.json", "encode chrome -o a.json"),
        (1, "b.npz", "decode code.json -o b.npz"),
        (1, "b.binary", "export chrome -o b.binary"),
        (1, "a.exr", "render chrome -o a.exr --size 64"),
        (1, "a.png", "render chrome -o a.png --size 64"),
        (1, "b.png", "blend chrome brass --method latent --steps 2 --size 32 -o b.png"),
        (0, "models", "plan scene.toml --tolerance 1 --export models -o /dev/null"),
    ] {
        if arguments.starts_with("decode") {
            place.run(&["encode", "chrome", "-o", "code.json"]).ok();
        }
        let output = run_full(&place, blocks, arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments}: {said}");
        assert!(said.contains(file) && said.contains("File too large"), "{arguments}: {said}");
        assert!(output.stdout.is_empty(), "{arguments}");
        // Not even a temporary file.
        let _ = std::fs::remove_file(place.path().join("code.json"));
        let _ = std::fs::remove_dir(place.path().join("out"));
        assert_eq!(place.names(), before, "{arguments}");
    }
}

#[test]
fn a_full_disk_keeps_what_was_there() {
    let place = inputs();
    place.run(&["import", "some", "-o", "out"]).ok();
    place.run(&["fit", "a.csv", "-o", "a.npy", "--steps", "5"]).ok();
    let files =
        || ["out/library.safetensors", "out/manifest.json", "a_fc1.npy", "a_fc2.npy"].map(|name| place.file(name));
    let before = files();
    assert!(!run_full(&place, 1, "import some/chrome.npz -o out").status.success());
    assert!(!run_full(&place, 1, "fit a.csv -o a.npy --steps 9").status.success());
    assert_eq!(files(), before);
}

#[test]
fn standard_output_that_is_full_is_a_failure_that_is_said() {
    let place = Place::new();
    for arguments in ["list", "list --json", "encode chrome", "info chrome"] {
        let line = format!("exec \"$NBRDF\" {arguments} > /dev/full");
        let output = Command::new("sh").args(["-c", &line]).env("NBRDF", env!("CARGO_BIN_EXE_nbrdf")).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments}: {said}");
        assert!(said.contains("standard output: No space left"), "{arguments}: {said}");
    }
    drop(place);
}

#[test]
fn a_folder_that_is_not_to_be_written_is_refused_before_the_work() {
    use std::os::unix::fs::PermissionsExt;
    let place = inputs();
    let locked = place.path().join("locked");
    std::fs::create_dir(&locked).unwrap();
    std::fs::set_permissions(&locked, PermissionsExt::from_mode(0o555)).unwrap();
    let folder = match std::fs::write(locked.join("probe"), b"") {
        Err(_) => locked.to_str().unwrap().to_owned(),
        // Nothing is locked for the superuser, but for what the kernel itself does not let be written.
        Ok(()) => "/proc".to_owned(),
    };
    for arguments in [
        &["fit", "a.csv", "--steps", "1000000000", "-o"][..],
        &["train", "-o"],
        &["learn", "pca_weights", "-o"],
        &["encode", "chrome", "-o"],
        &["render", "chrome", "-o"],
    ] {
        let extension = match arguments[0] {
            "fit" => "npz",
            "encode" => "json",
            "render" => "png",
            _ => "safetensors",
        };
        let output = format!("{folder}/a.{extension}");
        let said = place.run(&[arguments, &[&output]].concat()).fails(3);
        assert!(said.contains(&output) && said.contains("cannot be written"), "{said}");
    }
    let output = format!("{folder}/models");
    for arguments in [&["import", "some", "-o", &output][..], &["plan", "scene.toml", "--export", &output]] {
        let said = place.run(arguments).fails(3);
        assert!(said.contains(&folder) && said.contains("cannot be written"), "{said}");
    }
}

#[test]
fn a_folder_that_vanishes_during_the_work_is_named() {
    let place = inputs();
    std::fs::create_dir(place.path().join("gone")).unwrap();
    let line = "mkdir -p gone; \"$NBRDF\" fit a.csv -o gone/a.npz --steps 100000 --quiet & sleep \"$WAIT\"; rmdir gone; wait $!";
    // On a busy machine it may take a while until the work has begun: before, the folder is missed at once.
    let runs = ["0.2", "1", "3", "9"].map(|wait| {
        move |place: &Place| {
            let mut run = Command::new("sh");
            let run = run.args(["-c", line]).env("WAIT", wait).env("NBRDF", env!("CARGO_BIN_EXE_nbrdf"));
            run.current_dir(place.path()).output().unwrap()
        }
    });
    let during = runs.into_iter().map(|run| run(&place)).find(|run| run.status.code() != Some(3));
    let run = during.expect("the work begins within nine seconds");
    let said = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(1), "{said}");
    assert!(said.contains("gone/a.npz") && said.contains("gone does not exist: create it first"), "{said}");
}

#[test]
fn files_that_are_gone_or_folders_are_named() {
    let place = inputs();
    let at = |name: &str| place.path().join(name);
    for extension in ["npz", "h5", "safetensors", "binary", "bsdf", "csv", "brdf", "json", "zip", "toml", "exr"] {
        std::os::unix::fs::symlink(at("nowhere"), at(&format!("link.{extension}"))).unwrap();
        std::fs::create_dir(at(&format!("folder.{extension}"))).unwrap();
    }
    for kind in ["link", "folder"] {
        for (arguments, extension) in [
            (&["info"][..], "npz"),
            (&["info"], "h5"),
            (&["info"], "safetensors"),
            (&["render", "-o", "x.png"], "binary"),
            (&["render", "-o", "x.png"], "bsdf"),
            (&["fit", "-o", "x.npz"], "csv"),
            (&["fit", "-o", "x.npz"], "brdf"),
            (&["decode", "-o", "x.npz"], "json"),
            (&["import", "-o", "library"], "zip"),
            (&["plan"], "toml"),
            (&["encode", "chrome", "--checkpoint"], "safetensors"),
            (&["chart", "--from"], "json"),
            (&["render", "chrome", "-o", "x.png", "--environment"], "exr"),
        ] {
            let name = format!("{kind}.{extension}");
            let said = place.run(&[arguments, &[&name]].concat()).fails(3);
            assert!(said.contains(&name), "{arguments:?}: {said}");
        }
    }
    assert!(!place.names().iter().any(|name| name.starts_with("x.") || name == "library" || name == "plan.png"));
}

#[test]
fn what_a_damaged_file_holds_is_no_command_to_the_terminal() {
    let place = Place::new();
    for name in ["a.brdf", "a.csv"] {
        place.write(name, b"\x1b]0;owned\x07\x1b[31mred\n");
        let said = place.run(&["info", name]).fails(3);
        assert!(said.contains("\\u{1b}") && !said.contains(['\u{1b}', '\u{7}']), "{said:?}");
    }
}
