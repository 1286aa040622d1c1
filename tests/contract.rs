//! What every representation, interpolation and metric promises, asked of all that are in the catalog.

use std::sync::{Arc, OnceLock};

use nbrdf::catalog::{Catalog, INTERPOLATIONS, REPRESENTATIONS, Reference, Variant, metrics};
use nbrdf_core::library::builtin;
use nbrdf_core::metric::Metric as _;
use nbrdf_core::metric::{RelativeLog, log_error};
use nbrdf_core::path::PathError;
use nbrdf_core::representation::DecodeError;
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Brdf, Code, Directions, Material, Representation, Rgb, Weights};

fn catalog() -> &'static Catalog {
    static CATALOG: OnceLock<Catalog> = OnceLock::new();
    CATALOG.get_or_init(|| Catalog::new(Arc::new(Reference::built_in())))
}

fn material(name: &str) -> Material {
    builtin::shared().get(name).unwrap().material()
}

fn some_directions() -> Vec<Directions> {
    rus32k().iter().step_by(37).copied().collect()
}

/// Every entry with its name in failures.
fn representations() -> impl Iterator<Item = (String, Arc<dyn Representation>)> {
    REPRESENTATIONS.iter().map(|entry| {
        let name = format!("{} ({})", entry.name, entry.variant.name());
        (name, entry.build(catalog()).unwrap())
    })
}

fn assert_is_a_reflectance(name: &str, brdf: &dyn Brdf) {
    let at = some_directions();
    let together = evaluate(brdf, &at);
    for (&at, together) in at.iter().zip(together) {
        assert!(together.is_finite() && together.min() >= 0.0, "{name}: {together:?} at {at:?}");
        let alone = brdf.eval(at);
        let tolerance = 1e-4 * alone.max().max(1.0);
        assert!(alone.zip(together, |a, b| (a - b).abs()).max() <= tolerance, "{name}: {alone:?} {together:?}");
    }
    let below = Directions::new(-at[0].light, at[0].view);
    assert_eq!(brdf.eval(below), Rgb::BLACK, "{name}: below the horizon");
}

#[test]
fn codes_have_the_promised_length_name_and_checkpoint_and_are_the_same_each_time() {
    for (name, representation) in representations() {
        let code = representation.encode(&material("chrome")).unwrap();
        assert_eq!(representation.dim(), code.code.len(), "{name}");
        assert_eq!(
            (code.model.as_str(), code.checkpoint.as_str()),
            (representation.name(), representation.checkpoint())
        );
        assert!(code.code.iter().all(|v| v.is_finite()), "{name}");
        assert!((1..=representation.code_bytes()).contains(&representation.bytes_of(&code)), "{name}");
        assert_eq!(representation.encode(&material("chrome")).unwrap(), code, "{name}");
    }
}

#[test]
fn every_step_towards_the_target_comes_closer_to_it() {
    let znbrdf = |variant: Variant| {
        let mut entries = REPRESENTATIONS.iter().filter(|entry| entry.name == "znbrdf" && entry.variant == variant);
        entries.next().unwrap().build(catalog()).unwrap()
    };
    let mean = |variant: Variant| -> f64 {
        let representation = znbrdf(variant);
        let held_out = ["aluminium", "blue-fabric", "chrome", "pink-plastic", "rgl/satin_white"].map(material);
        let one = |material: &Material| {
            let decoded = representation.decode(&representation.encode(material).unwrap()).unwrap();
            RelativeLog.distance(material.brdf.as_ref(), decoded.as_ref())
        };
        held_out.iter().map(one).sum::<f64>() / held_out.len() as f64
    };
    let [alone, unrolled, refined] = [Variant::FeedForward, Variant::Unrolled, Variant::Refined].map(mean);
    println!("relative_log: encoder alone {alone:.4}, unrolled {unrolled:.4}, refined {refined:.4}");
    assert!(unrolled < 0.9 * alone && refined < unrolled, "{alone} {unrolled} {refined}");
}

#[test]
fn decoded_codes_are_reflectances_and_networks_agree_with_them() {
    for (name, representation) in representations() {
        let code = representation.encode(&material("blue-fabric")).unwrap();
        let decoded = representation.decode(&code).unwrap();
        assert_is_a_reflectance(&name, decoded.as_ref());
        if let Some(network) = representation.network(&code).unwrap() {
            let at = some_directions();
            assert_eq!(evaluate(&network, &at), evaluate(decoded.as_ref(), &at), "{name}");
        }
    }
}

#[test]
fn decoding_in_place_is_decoding_and_refuses_the_same_numbers() {
    let at = some_directions();
    for (name, representation) in representations() {
        let mut place = representation.decode(&representation.code(vec![0.0; representation.dim()])).unwrap();
        let code = representation.encode(&material("blue-fabric")).unwrap();
        representation.decode_into(&code.code, &mut place).unwrap();
        let decoded = representation.decode(&code).unwrap();
        assert_eq!(evaluate(place.as_ref(), &at), evaluate(decoded.as_ref(), &at), "{name}");
        let wrong = [vec![0.0; representation.dim() + 1], vec![f32::NAN; representation.dim()]];
        for numbers in &wrong {
            assert!(representation.decode_into(numbers, &mut place).is_err(), "{name}");
        }
        assert_eq!(evaluate(place.as_ref(), &at), evaluate(decoded.as_ref(), &at), "{name}: as it was");
    }
}

#[test]
fn derivatives_by_the_code_are_those_of_small_changes() {
    for (name, representation) in representations() {
        let code = representation.encode(&material("gold-paint")).unwrap();
        let Some(linearized) = representation.linearize(&code.code).unwrap() else { continue };
        let weights = |numbers: Vec<f32>| {
            let network = representation.network(&representation.code(numbers)).unwrap().unwrap();
            network.into_weights()
        };
        assert_eq!(linearized.weights, weights(code.code.clone()), "{name}");
        for (number, row) in linearized.rows().enumerate().step_by(7) {
            let [above, below] = [1e-2, -1e-2].map(|by| {
                let mut numbers = code.code.clone();
                numbers[number] += by;
                weights(numbers)
            });
            let largest = row.iter().fold(1e-3f32, |largest, d| largest.max(d.abs()));
            for ((above, below), own) in above.iter().zip(&below).zip(row) {
                let slope = (above - below) / 2e-2;
                assert!((slope - own).abs() < 0.02 * largest, "{name}, number {number}: {own} {slope}");
            }
        }
    }
}

#[test]
fn a_basis_from_a_file_is_the_one_that_was_saved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("basis.safetensors");
    let at = some_directions();
    for entry in Catalog::learned_entries() {
        catalog().learn(entry.name).unwrap().save(&path).unwrap();
        // From other materials nothing can be learned: what it knows is from the file.
        let none = Reference { kind: "none".to_owned(), materials: Vec::new() };
        let elsewhere = Catalog::new(Arc::new(none)).with_checkpoint(&path).unwrap();
        assert_eq!(elsewhere.checkpoint_of(), Some(entry.name));
        let [own, read] = [catalog(), &elsewhere].map(|catalog| catalog.representation(entry.name, false).unwrap());
        let code = own.encode(&material("gold-paint")).unwrap();
        assert_eq!(read.encode(&material("gold-paint")).unwrap(), code, "{}", entry.name);
        let [own, read] =
            [own, read].map(|representation| evaluate(representation.decode(&code).unwrap().as_ref(), &at));
        assert_eq!(own, read, "{}", entry.name);
    }
}

#[test]
fn codes_that_belong_elsewhere_are_refused() {
    for (name, representation) in representations() {
        let code = representation.code(vec![0.0; representation.dim()]);
        let refusal = |code: Code| {
            let network = representation.network(&code).err().map(|error| error.to_string());
            let error = representation.decode(&code).err().unwrap_or_else(|| panic!("{name} decodes {code:?}"));
            assert_eq!(network, Some(error.to_string()), "{name}: both decoders refuse alike");
            error
        };
        let changed = |change: &dyn Fn(&mut Code)| {
            let mut code = code.clone();
            change(&mut code);
            refusal(code)
        };
        assert!(matches!(changed(&|code| code.model = "another".into()), DecodeError::Model { .. }));
        assert!(matches!(changed(&|code| code.checkpoint = "another".into()), DecodeError::Checkpoint { .. }));
        assert!(matches!(changed(&|code| code.code.push(0.0)), DecodeError::Length { .. }));
        let nan = changed(&|code| *code.code.last_mut().unwrap() = f32::NAN);
        assert!(matches!(nan, DecodeError::NotFinite { index, .. } if index + 1 == representation.dim()), "{name}");
        assert!(matches!(changed(&|code| code.code[0] = f32::INFINITY), DecodeError::NotFinite { .. }));
    }
}

#[test]
fn at_the_end_of_a_path_is_the_methods_own_version_of_the_end() {
    let ends = [material("chrome"), material("blue-fabric")];
    let at = some_directions();
    let values: Vec<_> = ends.iter().map(|end| evaluate(end.brdf.as_ref(), &at)).collect();
    for entry in INTERPOLATIONS {
        let path = entry.build(catalog()).unwrap().between(&ends).unwrap();
        let swapped = entry.build(catalog()).unwrap().between(&[ends[1].clone(), ends[0].clone()]).unwrap();
        for (end, t) in [(0, 0.0), (1, 1.0)] {
            let here = evaluate(path.at(&Weights::two(t)).unwrap().as_ref(), &at);
            let there = evaluate(swapped.at(&Weights::two(1.0 - t)).unwrap().as_ref(), &at);
            let apart = log_error(&at, &here, &there);
            assert!(apart < 1e-3, "{}: end {end} depends on its place: {apart}", entry.name);
            let own = log_error(&at, &values[end], &here);
            assert!(own.is_finite(), "{}: {own}", entry.name);
        }
    }
}

#[test]
fn every_point_of_a_path_is_a_reflectance_also_beyond_the_ends() {
    let ends = ["chrome", "blue-fabric", "gold-paint"].map(material);
    for entry in INTERPOLATIONS {
        let interpolation = entry.build(catalog()).unwrap();
        let path = interpolation.between(&ends).unwrap();
        let mut moved = path.at(&Weights::normalized(vec![1.0, 0.0, 0.0]).unwrap()).unwrap();
        for weights in [[1.0, 1.0, 1.0], [0.2, 0.3, 0.5], [1.3, -0.3, 0.0]] {
            let weights = Weights::normalized(weights.to_vec()).unwrap();
            let point = path.at(&weights).unwrap();
            assert_is_a_reflectance(entry.name, point.as_ref());
            path.move_to(&weights, &mut moved).unwrap();
            let at = some_directions();
            assert_eq!(evaluate(moved.as_ref(), &at), evaluate(point.as_ref(), &at), "{}: moved in place", entry.name);
        }
        assert_eq!(interpolation.name(), entry.name);
    }
}

#[test]
fn paths_refuse_too_few_ends_and_the_wrong_number_of_weights() {
    let ends = [material("chrome"), material("blue-fabric")];
    for entry in INTERPOLATIONS {
        let interpolation = entry.build(catalog()).unwrap();
        for few in [&ends[..0], &ends[..1]] {
            let refused = interpolation.between(few).err();
            assert!(matches!(refused, Some(PathError::TooFewEnds { .. })), "{}", entry.name);
        }
        let path = interpolation.between(&ends).unwrap();
        let three = Weights::normalized(vec![1.0; 3]).unwrap();
        assert!(matches!(path.at(&three).err(), Some(PathError::Weights { .. })), "{}", entry.name);
    }
}

#[test]
fn metrics_are_best_for_the_same_material_and_worse_the_other_way_round_too() {
    let (chrome, fabric) = (material("chrome"), material("blue-fabric"));
    for metric in metrics() {
        let distance = |a: &Material, b: &Material| metric.distance(a.brdf.as_ref(), b.brdf.as_ref());
        let same = distance(&chrome, &chrome);
        for other in [distance(&chrome, &fabric), distance(&fabric, &chrome)] {
            assert!(same.is_finite() && other.is_finite(), "{}", metric.name());
            assert_eq!(same > other, metric.higher_is_better(), "{}: {same} {other}", metric.name());
        }
        if !metric.higher_is_better() {
            assert_eq!(same, 0.0, "{}", metric.name());
        }
    }
}

#[test]
fn no_name_is_there_twice() {
    let mut names: Vec<String> = representations().map(|(name, _)| name).collect();
    names.extend(INTERPOLATIONS.iter().map(|entry| format!("path {}", entry.name)));
    names.extend(metrics().iter().map(|metric| format!("metric {}", metric.name())));
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn training_interrupted_and_resumed_writes_the_same_bytes() {
    use autoencoder::{Architecture, TrainError, TrainOptions, TrainingData, train};
    use nbrdf::families::{random_materials, random_walks};
    use std::ops::ControlFlow;

    let measured = ["chrome", "blue-fabric"].map(material);
    let networks: Vec<_> = measured.iter().filter_map(|material| material.network.clone()).collect();
    let (analytic, walks) = (random_materials(1, 3), random_walks(1, 3));
    let data =
        TrainingData { measured: &measured, analytic: &analytic, walks: &walks, networks: &networks, start: None };
    let options = TrainOptions { steps: 110, ..TrainOptions::new(Architecture::Znbrdf) };
    let folder = tempfile::tempdir().unwrap();
    let [straight, broken] = ["straight.safetensors", "broken.safetensors"].map(|name| folder.path().join(name));
    train(&data, &options, &straight, false, &mut |_, _| ControlFlow::Continue(())).unwrap();
    let stopped = train(&data, &options, &broken, false, &mut |_, _| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(TrainError::Stopped { step: 100, .. })));
    assert!(!broken.exists(), "an interrupted training leaves no checkpoint");
    train(&data, &options, &broken, true, &mut |_, _| ControlFlow::Continue(())).unwrap();
    assert_eq!(std::fs::read(&straight).unwrap(), std::fs::read(&broken).unwrap());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "the state is gone");
}
