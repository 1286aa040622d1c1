//! The same command gives the same bits, for any number of threads; other instructions give other last digits.

use nbrdf_core::cost::WithSet;
use nbrdf_core::library::builtin;
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::simd::{InstructionSet, VARIABLE};
use nbrdf_core::{Directions, Rgb};
use serde_json::Value;

use super::SAMPLES;
use super::support::Place;

/// Everything that is written, by a command with this output.
fn written(place: &Place, arguments: &[&str], output: &str, threads: &str) -> Vec<u8> {
    place.run(&[arguments, &["-o", output, "--threads", threads, "--quiet"]].concat()).ok();
    let path = place.path().join(output);
    if !path.is_dir() {
        return place.file(output);
    }
    ["library.safetensors", "manifest.json"].iter().flat_map(|name| place.file(&format!("{output}/{name}"))).collect()
}

#[test]
fn the_same_command_gives_the_same_bits_for_any_number_of_threads() {
    let place = Place::new();
    place.library("some", ["chrome", "brass"]);
    place.write("a.csv", SAMPLES.as_bytes());
    place.run(&["encode", "chrome", "-o", "chrome.json"]).ok();
    let brushed = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/brushed.bsdf");
    let around = ["--environment", "softboxes", "--samples", "4", "--size", "24"];
    let commands: [(&[&str], &str); 15] = [
        (&["import", "some"], "library"),
        (&["import", "some", "--shared-start", "--steps", "30"], "library"),
        (&["import", "some", "--independent", "--steps", "30"], "library"),
        (&["fit", "a.csv", "--steps", "50"], "npz"),
        (&["fit", brushed, "--steps", "50"], "safetensors"),
        (&["train", "--architecture", "published", "--steps", "12"], "safetensors"),
        (&["learn", "pca_weights", "--numbers", "5"], "safetensors"),
        (&["learn", "pca_45", "--numbers", "2", "--library", "learned"], "safetensors"),
        (&["encode", "chrome"], "json"),
        (&["encode", "chrome", "--refine"], "json"),
        (&["encode", "chrome", "--with", "pca_weights"], "json"),
        (&["decode", "chrome.json"], "npz"),
        (
            &["blend", "chrome", "brass", "--method", "latent", "--method", "log_mix", "--steps", "3", "--size", "32"],
            "exr",
        ),
        (&["render", "chrome", "--size", "48"], "exr"),
        (&[&["render", "chrome.json"], &around[..]].concat(), "exr"),
    ];
    place.library("learned", ["aluminium", "blue-metallic-paint", "gold-metallic-paint2", "green-latex", "pvc"]);
    for (arguments, extension) in commands {
        // One name, since reports and manifests hold it.
        let output = format!("out.{extension}");
        let first = written(&place, arguments, &output, "1");
        for threads in ["1", "2", "3"] {
            let again = written(&place, arguments, &output, threads);
            assert!(again == first, "{arguments:?} gives other bits with {threads} threads");
        }
    }
}

/// Largest difference of evaluations, in parts of the larger one or of 0.001, between sets with and without fused
/// multiply-add; see docs/robustness.md.
const EVALUATED: f32 = 1e-3;

#[test]
fn instruction_sets_with_fused_multiply_add_differ_in_the_last_digits_of_evaluations() {
    let sets = InstructionSet::available();
    let (mut worst, mut sum, mut count) = (0.0_f32, 0.0_f64, 0_usize);
    for entry in builtin::shared() {
        let values = |set: InstructionSet| evaluate(&WithSet { network: entry.network.clone(), set }, rus32k());
        let portable = values(sets[0]);
        for set in &sets[1..] {
            for (a, b) in portable.iter().zip(values(*set)) {
                for channel in 0..3 {
                    let difference = (a[channel] - b[channel]).abs() / a[channel].max(b[channel]).max(1e-3);
                    worst = worst.max(difference);
                    sum += f64::from(difference);
                    count += 1;
                }
            }
        }
    }
    println!("evaluations: {worst:.1e} at most, {:.1e} in the mean", sum / count.max(1) as f64);
    assert!(worst < EVALUATED, "{worst:e}");
}

/// Largest `log_error` between results of the same command with different instructions; see docs/robustness.md.
const RESULTS: [(&[&str], &str, f64); 3] = [
    (&["encode", "chrome"], "json", 1e-5),
    (&["encode", "chrome", "--refine"], "json", 1e-5),
    (&["fit", "chrome.csv", "--steps", "300"], "npz", 3e-3),
];

/// Samples of a built-in material.
fn samples_of(name: &str) -> String {
    let at: Vec<_> = rus32k().iter().step_by(67).copied().filter(|at| at.is_above()).collect();
    let values = evaluate(&builtin::shared().get(name).unwrap().network, &at);
    let line = |(at, f): (&Directions, &Rgb)| {
        let numbers = at.light.to_array().into_iter().chain(at.view.to_array()).chain(f.0);
        numbers.map(|v| v.to_string()).collect::<Vec<_>>().join(",") + "\n"
    };
    let heading = SAMPLES.lines().next().unwrap();
    format!("{heading}\n{}", at.iter().zip(&values).map(line).collect::<String>())
}

#[test]
fn instruction_sets_give_results_that_hardly_differ() {
    let place = Place::new();
    place.write("chrome.csv", samples_of("chrome").as_bytes());
    let run = |arguments: &[&str], set: &str| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_nbrdf"));
        command.args(arguments).env(VARIABLE, set).current_dir(place.path()).output().unwrap()
    };
    let refused = run(&["list"], "sse9");
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("expected one of portable"));
    let sets = InstructionSet::available();
    let Some(vector) = sets.get(1) else {
        println!("SKIPPED: this processor has one set of instructions");
        return;
    };
    for (arguments, extension, most) in RESULTS {
        let [portable, fused] = [sets[0], *vector].map(|set| {
            let output = format!("{}.{extension}", set.name());
            let ran = run(&[arguments, &["-o", &output, "--quiet"]].concat(), set.name());
            assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
            output
        });
        let compared: Value = place.run(&["info", &portable, "--against", &fused, "--json"]).json();
        let difference = compared["against"]["figures"]["log_error"].as_f64().unwrap();
        println!("{arguments:?}: log_error {difference:.1e}");
        assert!(difference < most, "{arguments:?}: {difference}");
    }
}
