//! The program killed (SIGKILL) at random moments: what it writes is there as before, or as it should be, and nothing between.
//!
//! 230 kills in all; `NBRDF_KILLS=10` makes ten times as many.

use std::collections::BTreeMap;
use std::os::unix::process::ExitStatusExt;
use std::process::Command;
use std::time::{Duration, Instant};

use nbrdf_core::Library;
use nbrdf_core::nbrdf::file;
use nbrdf_core::nbrdf::fit::generator;
use rand::RngExt;
use serde_json::Value;

use super::support::Place;
use super::{SAMPLES, SCENE};

/// Files by name, those of temporary names left out.
type Files = BTreeMap<String, Vec<u8>>;

/// A command that is killed again and again.
struct Victim {
    place: Place,
    /// What is run.
    arguments: Vec<&'static str>,
    /// The same, with another result of the same names.
    other: Vec<&'static str>,
    /// Names that it writes; one that ends with `/` is a folder.
    outputs: &'static [&'static str],
}

impl Victim {
    fn remove(&self) {
        for output in self.outputs {
            let path = self.place.path().join(output);
            let _ = if path.is_dir() { std::fs::remove_dir_all(path) } else { std::fs::remove_file(path) };
        }
    }

    /// What is there of the outputs. Beside them and the inputs, only temporary files may lie.
    fn found(&self) -> Files {
        let mut files = Files::new();
        for output in self.outputs {
            let path = self.place.path().join(output);
            let names = match output.ends_with('/') {
                true => std::fs::read_dir(&path).into_iter().flatten().map(|file| file.unwrap().path()).collect(),
                false => vec![path],
            };
            for path in names {
                let name = path.file_name().unwrap().to_str().unwrap().to_owned();
                if let (false, Ok(bytes)) = (name.starts_with('.'), std::fs::read(&path)) {
                    files.insert(name, bytes);
                }
            }
        }
        files
    }

    /// Outputs of a run that nobody disturbs, and how long it takes.
    fn undisturbed(&self, arguments: &[&str]) -> (Files, Duration) {
        self.remove();
        let start = Instant::now();
        self.place.run(arguments).ok();
        let took = start.elapsed();
        let files = self.found();
        assert!(!files.is_empty());
        (files, took)
    }

    /// Kills it so many times, over nothing and over an earlier result in turns. After each kill, `is_whole` tells whether
    /// what is found is what was there, or what should be; `again` says whether the next run has to give the same bits.
    fn kill(&self, times: usize, is_whole: impl Fn(&Files, &Files, &Files) -> bool, again: impl Fn(usize) -> bool) {
        let (old, _) = self.undisturbed(&self.other);
        let (new, took) = self.undisturbed(&self.arguments);
        assert_ne!(old, new);
        let before = self.place.names();
        let rng = &mut generator(times as u64, 0);
        let times = times * std::env::var("NBRDF_KILLS").ok().map_or(1, |times| times.parse().unwrap());
        let (mut kills, mut tries) = (0, 0);
        while kills < times {
            tries += 1;
            assert!(tries < 20 * times, "the program is hardly ever met at work");
            self.remove();
            let is_over = tries % 2 == 0;
            if is_over {
                self.place.run(&self.other).ok();
            }
            let mut child = self.place.start(&self.arguments);
            // Half of the moments are near the end, where files are written.
            let from = if rng.random_bool(0.5) { 0.7 } else { 0.0 };
            std::thread::sleep(took.mul_f64(rng.random_range(from..1.1)));
            child.kill().unwrap();
            if child.wait().unwrap().signal() != Some(9) {
                continue;
            }
            kills += 1;
            let (found, nothing) = (self.found(), Files::new());
            let earlier = if is_over { &old } else { &nothing };
            assert!(is_whole(&found, earlier, &new), "{:?}: {:?}", self.arguments, found.keys());
            let strange = |name: &String| !before.contains(name) && !name.starts_with(".nbrdf-");
            assert_eq!(self.place.names().into_iter().find(strange), None);
            if again(kills) {
                self.place.run(&self.arguments).ok();
                assert_eq!(self.found(), new, "after a kill, {:?} gives other bits", self.arguments);
            }
        }
        println!("{:?}: {kills} kills", self.arguments);
    }
}

/// All files are the earlier ones, or all are the new ones.
fn old_or_new(found: &Files, old: &Files, new: &Files) -> bool {
    found == old || found == new
}

fn with_samples() -> Place {
    let place = Place::new();
    place.write("samples.csv", SAMPLES.as_bytes());
    place
}

#[test]
fn a_killed_import_leaves_a_library_that_is_old_or_new() {
    let place = Place::new();
    place.library("some", ["chrome", "blue-fabric"]);
    place.library("more", ["chrome", "gold-paint", "brass"]);
    let quick = Victim {
        place,
        arguments: vec!["import", "more", "-o", "out", "--quiet"],
        other: vec!["import", "some", "-o", "out", "--quiet"],
        outputs: &["out/"],
    };
    let folder = quick.place.path().join("out");
    // Between two renames both files are new, one of them under its temporary name: what counts is what is read.
    let names = |library: Library| library.iter().map(|entry| entry.name.clone()).collect::<Vec<_>>();
    quick.kill(
        40,
        |found, old, new| match found.get("library.safetensors") {
            None => found.is_empty() && old.is_empty(),
            Some(tensors) => {
                let read = Library::load(&folder).map(names);
                let expected = if Some(tensors) == new.get("library.safetensors") { 3 } else { 2 };
                read.is_ok_and(|names| names.len() == expected)
            }
        },
        |_| true,
    );
    let arguments = ["import", "more", "-o", "out", "--quiet", "--shared-start", "--steps"];
    let fitted =
        Victim { arguments: [&arguments[..], &["60"]].concat(), other: [&arguments[..], &["5"]].concat(), ..quick };
    fitted.kill(
        20,
        |found, old, _| match found.is_empty() {
            true => old.is_empty(),
            false => Library::load(&folder).is_ok_and(|own| own.len() == 3),
        },
        |_| true,
    );
}

#[test]
fn a_killed_fit_leaves_no_half_written_network() {
    let fit = |output: &'static str, outputs: &'static [&'static str]| Victim {
        place: with_samples(),
        arguments: vec!["fit", "samples.csv", "-o", output, "--steps", "40", "--quiet"],
        other: vec!["fit", "samples.csv", "-o", output, "--steps", "5", "--quiet"],
        outputs,
    };
    fit("a.npz", &["a.npz"]).kill(30, old_or_new, |_| true);
    // Six files: stopped between them, a set lacks its first one, and is refused; old and new ones are never read together.
    let set = fit("a.npy", &["a_fc1.npy", "a_b1.npy", "a_fc2.npy", "a_b2.npy", "a_fc3.npy", "a_b3.npy"]);
    let path = set.place.path().join("a_b2.npy");
    set.kill(
        30,
        |found, old, new| {
            old_or_new(found, old, new)
                || (!found.contains_key("a_fc1.npy") && (found.is_empty() || file::read(&path).is_err()))
        },
        |_| true,
    );
}

#[test]
fn a_killed_training_leaves_no_half_written_checkpoint() {
    let train =
        |steps| vec!["train", "--architecture", "published", "--steps", steps, "-o", "a.safetensors", "--quiet"];
    let victim = Victim { place: Place::new(), arguments: train("12"), other: train("4"), outputs: &["a.safetensors"] };
    victim.kill(20, old_or_new, |kill| kill % 5 == 0);
}

#[test]
fn a_training_that_is_stopped_and_then_killed_goes_on_to_the_same_bits() {
    let place = Place::new();
    let train = |output: &'static str| {
        ["train", "--architecture", "published", "--steps", "250", "-o", output, "--quiet", "--threads", "2"]
    };
    let start = Instant::now();
    place.run(&train("whole.safetensors")).ok();
    let took = start.elapsed();
    // A stop, as from a keyboard, is heeded at the next hundred steps, and before the first step it ends the program.
    let is_stopped = (3..9).any(|tenths| {
        let mut first = place.start(&train("a.safetensors"));
        std::thread::sleep(took.mul_f64(0.1 * f64::from(tenths)));
        let sent = Command::new("kill").args(["-INT", &first.id().to_string()]).status().unwrap();
        sent.success() && !first.wait().unwrap().success() && place.names().contains(&"a.safetensors.state".to_owned())
    });
    assert!(is_stopped);
    let state = place.file("a.safetensors.state");
    let resume = [&train("a.safetensors")[..], &["--resume"]].concat();
    let rng = &mut generator(10, 0);
    let (mut kills, mut tries) = (0, 0);
    while kills < 10 {
        tries += 1;
        assert!(tries < 100, "the program is hardly ever met at work");
        let mut child = place.start(&resume);
        std::thread::sleep(took.mul_f64(rng.random_range(0.0..0.1)));
        child.kill().unwrap();
        kills += usize::from(child.wait().unwrap().signal() == Some(9));
        if place.path().join("a.safetensors").exists() {
            // It was done already: back to where it was stopped.
            assert!(place.file("a.safetensors") == place.file("whole.safetensors"));
            std::fs::remove_file(place.path().join("a.safetensors")).unwrap();
            place.write("a.safetensors.state", &state);
        }
        assert!(place.file("a.safetensors.state") == state, "what was saved is not touched before more is");
    }
    place.run(&resume).ok();
    assert!(place.file("a.safetensors") == place.file("whole.safetensors"));
    assert!(!place.path().join("a.safetensors.state").exists());
}

#[test]
fn a_killed_learning_leaves_no_half_written_basis() {
    let learn = |numbers| vec!["learn", "pca_weights", "--numbers", numbers, "-o", "a.safetensors", "--quiet"];
    let victim = Victim { place: Place::new(), arguments: learn("9"), other: learn("3"), outputs: &["a.safetensors"] };
    victim.kill(20, old_or_new, |_| true);
}

#[test]
fn a_killed_encoding_or_rendering_leaves_no_half_written_code_or_picture() {
    let encode = |material| vec!["encode", material, "-o", "a.json", "--quiet"];
    let victim =
        Victim { place: Place::new(), arguments: encode("chrome"), other: encode("brass"), outputs: &["a.json"] };
    victim.kill(20, old_or_new, |_| true);
    let render = |material| vec!["render", material, "-o", "a.exr", "--size", "128", "--quiet"];
    let victim =
        Victim { place: Place::new(), arguments: render("chrome"), other: render("brass"), outputs: &["a.exr"] };
    victim.kill(20, old_or_new, |_| true);
}

#[test]
fn a_killed_export_leaves_an_index_whose_files_are_all_there() {
    let place = Place::new();
    place.write("scene.toml", SCENE.as_bytes());
    let plan = |tolerance| {
        vec!["plan", "scene.toml", "--by", "bytes", "--tolerance", tolerance, "--export", "models", "--quiet"]
    };
    let victim = Victim { place, arguments: plan("1"), other: plan("0.02"), outputs: &["models/"] };
    let models = victim.place.path().join("models");
    let serves = |found: &Files| match found.get("plan.json") {
        // Files without an index are taken by nobody.
        None => true,
        Some(index) => {
            let index: Value = serde_json::from_slice(index).unwrap();
            let objects = index["objects"].as_array().unwrap();
            objects.iter().all(|object| {
                let file = models.join(object["file"].as_str().unwrap());
                victim.place.run(&["render", file.to_str().unwrap(), "-o", "/dev/null", "--size", "8"]).ok();
                true
            })
        }
    };
    victim.kill(
        20,
        |found, old, _| serves(found) && (found.contains_key("plan.json") || old.is_empty()),
        |kill| kill % 5 == 0,
    );
}
