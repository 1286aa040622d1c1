//! Networks, coordinates and spheres against numbers made by `scripts/make_golden.py` (NumPy, float64).

use std::path::PathBuf;

use nbrdf_core::brdf::ggx::Ggx;
use nbrdf_core::brdf::lambert::Lambert;
use nbrdf_core::cost::ReferenceLoop;
use nbrdf_core::render::{Light, Sphere};
use nbrdf_core::simd::InstructionSet;
use nbrdf_core::{Brdf, Directions, Library, Nbrdf, Rgb, Rusinkiewicz, Vec3, data};
use safetensors::SafeTensors;
use serde_json::Value;

fn golden(name: &str) -> Vec<u8> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/golden").join(name);
    std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn triples(file: &SafeTensors, name: &str) -> Vec<[f32; 3]> {
    let bytes = file.tensor(name).unwrap().data().as_chunks().0.to_vec();
    let numbers: Vec<f32> = bytes.into_iter().map(f32::from_le_bytes).collect();
    numbers.as_chunks().0.to_vec()
}

/// The largest error of every published network relative to (f + 10⁻³), against NumPy in float64; sorted.
fn errors(evaluate: impl Fn(&Nbrdf, &[Directions], &mut [Rgb])) -> Option<Vec<(f64, String)>> {
    let bytes = golden("forward.safetensors");
    let file = SafeTensors::deserialize(&bytes).unwrap();
    let vectors = |name| triples(&file, name).into_iter().map(Vec3::from);
    let at: Vec<Directions> = vectors("light").zip(vectors("view")).map(|(l, v)| Directions::new(l, v)).collect();
    let mut worst = Vec::new();
    for zip in ["merl_nbrdf.zip", "rgl_nbrdf_subset.zip"] {
        for entry in &Library::load(&data::published_or_skip(zip)?).unwrap() {
            let mut own = vec![Rgb::BLACK; at.len()];
            evaluate(&entry.network, &at, &mut own);
            let wanted = triples(&file, &entry.name);
            let errors = own.iter().zip(wanted).flat_map(|(own, wanted)| {
                (0..3).map(move |c| f64::from((own[c] - wanted[c]).abs()) / (f64::from(wanted[c]) + 1e-3))
            });
            worst.push((errors.fold(0.0, f64::max), entry.name.clone()));
        }
    }
    worst.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_eq!(worst.len(), 134);
    Some(worst)
}

#[test]
fn published_networks_evaluate_as_in_float64_and_as_well_as_by_the_plain_loop() {
    let plain = errors(|network, at, out| ReferenceLoop::new(network).eval_into(at, out));
    let own = errors(|network, at, out| network.eval_into(at, out));
    let (Some(plain), Some(own)) = (plain, own) else { return };
    for (name, worst) in [("plain loop", &plain), ("kernel", &own)] {
        let (median, last) = (&worst[67], &worst[133]);
        println!("{name}: median network {:.2e}, worst {:.2e} ({})", median.0, last.0, last.1);
    }
    assert!(own[67].0 <= 1e-5 && own[133].0 <= 3e-4, "{:?} {:?}", own[67], own[133]);
    for place in [67, 133] {
        assert!(own[place].0 <= 1.05 * plain[place].0, "{:?} {:?}", own[place], plain[place]);
    }
    for set in InstructionSet::available() {
        let worst = errors(|network, at, out| network.eval_with(set, at, out)).unwrap();
        println!("{}: median network {:.2e}, worst {:.2e}", set.name(), worst[67].0, worst[133].0);
        assert!(worst[67].0 <= 1e-5 && worst[133].0 <= 3e-4, "{}", set.name());
    }
}

fn vector(value: &Value) -> Vec3 {
    let number = |i: usize| value[i].as_f64().unwrap() as f32;
    Vec3::new(number(0), number(1), number(2))
}

#[test]
fn coordinates_agree_both_ways() {
    let json: Value = serde_json::from_slice(&golden("coordinates.json")).unwrap();
    let cases = json["cases"].as_array().unwrap();
    assert!(cases.len() > 10);
    for case in cases {
        let angle = |name: &str| case[name].as_f64().unwrap() as f32;
        let at = Directions::new(vector(&case["light"]), vector(&case["view"]));
        // Rounded to f32, the azimuth of a half vector near the normal is only known to 2⁻²⁴ / θ_half.
        let tolerance = 2e-6 + 6e-8 / angle("theta_half");
        let close = |a: Vec3, b: Vec3| assert!((a - b).length() < tolerance, "{a} {b} in {case}");
        let vectors = at.half_diff();
        close(vectors.half, vector(&case["half"]));
        close(vectors.diff, vector(&case["difference"]));
        let angles = Rusinkiewicz {
            theta_half: angle("theta_half"),
            theta_diff: angle("theta_diff"),
            phi_diff: angle("phi_diff"),
            phi_half: angle("phi_half"),
        };
        let back = angles.directions();
        close(back.light, at.light);
        close(back.view, at.view);
        let found = at.rusinkiewicz();
        assert!((found.theta_half - angles.theta_half).abs() < 1e-5);
        assert!((found.theta_diff - angles.theta_diff).abs() < 1e-5);
    }
}

#[test]
fn spheres_show_what_numpy_shows() {
    let json: Value = serde_json::from_slice(&golden("sphere.json")).unwrap();
    let mut seen = 0;
    for (name, material) in json["materials"].as_object().unwrap() {
        let Some(brdf) = formula(material) else { continue };
        for light in Light::NAMES {
            let sphere = Sphere::new(json["size"].as_u64().unwrap() as usize, &Light::by_name(light).unwrap());
            let picture = sphere.render(brdf.as_ref());
            let case = &material[light];
            let covered = sphere.covered().iter().filter(|on| **on).count();
            assert_eq!(case["covered"].as_u64().unwrap() as usize, covered);
            for pixel in case["pixels"].as_array().unwrap() {
                let place = |key: &str| pixel[key].as_u64().unwrap() as usize;
                let wanted = vector(&pixel["rgb"]);
                let own = Vec3::from(picture.get(place("column"), place("row")).0);
                assert!((own - wanted).length() < 2e-4 * wanted.length() + 1e-6, "{name} {light} {pixel}: {own}");
            }
            seen += 1;
        }
    }
    assert!(seen >= 4, "only {seen} spheres compared");
}

/// The formulas this crate has; other lobes in the file are skipped.
fn formula(material: &Value) -> Option<Box<dyn Brdf>> {
    let colour = |key: &str| Rgb(vector(&material[key]).to_array());
    if material["f0"].is_null() {
        return Some(Box::new(Lambert { albedo: colour("diffuse") }));
    }
    let alpha = material["alpha"].as_f64()? as f32;
    (material["lobe"] == "ggx").then(|| Box::new(Ggx { diffuse: colour("diffuse"), f0: colour("f0"), alpha }) as _)
}
