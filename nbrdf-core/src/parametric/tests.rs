//! What holds for every shading model, and for each as its specification says.

use std::path::PathBuf;

use proptest::prelude::*;
use serde_json::Value;

use super::*;
use crate::brdf::lambert::Lambert;
use crate::metric::{albedo_max, reciprocity};
use crate::sampling::{evaluate, rus32k};
use crate::{Directions, Rgb};

fn golden(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/golden").join(name);
    std::fs::read_to_string(path).unwrap()
}

/// Numbers of a model from parameters by their names in the specification.
fn named<M: ShadingModel>(parameters: &Value) -> M {
    let of = |parameter: &Parameter| -> Vec<f32> {
        let value = &parameters[parameter.name];
        let channel = |i: usize| if parameter.size == 3 { &value[i] } else { value };
        (0..parameter.size).map(|i| channel(i).as_f64().unwrap() as f32).collect()
    };
    M::from_values(&M::PARAMETERS.iter().flat_map(of).collect::<Vec<_>>())
}

/// Numbers at these shares of their ranges; parts that are not named stay neutral.
fn placed<M: ShadingModel>(shares: &[f32], parts: &[&str]) -> M {
    let numbers = M::PARAMETERS.iter().flat_map(|parameter| (0..parameter.size).map(move |_| parameter));
    let value = |(parameter, share): (&Parameter, &f32)| {
        let [low, high] = parameter.range;
        if parts.contains(&parameter.part) { low + (high - low) * share } else { parameter.neutral }
    };
    M::from_values(&numbers.zip(shares).map(value).collect::<Vec<_>>())
}

fn all_parts<M: ShadingModel>() -> Vec<&'static str> {
    M::PARAMETERS.iter().map(|parameter| parameter.part).collect()
}

fn like_the_golden<M: ShadingModel>(relative: impl Fn(&str) -> f32) {
    let golden: Value = serde_json::from_str(&golden("parametric.json")).unwrap();
    let angle = |angles: &Value, i: usize| (angles[i].as_f64().unwrap() as f32).to_radians();
    let pair = |angles: &Value| Directions::from_angles(angle(angles, 0), 0.0, angle(angles, 1), angle(angles, 2));
    let at: Vec<Directions> = golden["angles"].as_array().unwrap().iter().map(pair).collect();
    let mut compared = 0;
    for material in golden["materials"].as_array().unwrap().iter().filter(|material| material["model"] == M::NAME) {
        let name = material["name"].as_str().unwrap();
        let found = evaluate(named::<M>(&material["parameters"]).brdf().as_ref(), &at);
        for (i, found) in found.iter().enumerate() {
            for channel in 0..3 {
                let expected = material["values"][i][channel].as_f64().unwrap() as f32;
                let apart = (found[channel] - expected).abs();
                assert!(apart < relative(name) * expected + 1e-5, "{name} at {i}: {} not {expected}", found[channel]);
                compared += 1;
            }
        }
    }
    assert!(compared >= 4 * 36);
}

#[test]
fn values_are_those_of_the_specifications_in_double_precision() {
    like_the_golden::<GltfPbr>(|name| if name == "velvet" { 0.01 } else { 2e-4 });
    // What layers keep is integrated here with few normals, there on fine grids.
    like_the_golden::<OpenPbr>(|_| 0.015);
    like_the_golden::<Principled>(|_| 0.015);
}

/// The model fitted to itself: its numbers, and those found.
fn refitted<M: ShadingModel>(shares: &[f32], parts: &[&str]) -> (Vec<f32>, Fitted<M>) {
    let model = placed::<M>(shares, parts);
    (model.values(), fit::<M>(model.brdf().as_ref()).unwrap())
}

fn core_is_found<M: ShadingModel>(shares: &[f32]) -> Result<(), TestCaseError> {
    let (known, found) = refitted::<M>(shares, &[""]);
    prop_assert!(found.errors.log_error < 2e-3, "{}: {known:?} {found:?}", M::NAME, found = found.errors);
    for (known, found) in known.iter().zip(found.model.values()).take(5) {
        prop_assert!((known - found).abs() < 0.03, "{}: {known} {found}", M::NAME);
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3, max_shrink_iters: 0, ..ProptestConfig::default() })]

    #[test]
    fn parameters_of_a_material_inside_the_model_are_found_again(
        shares in prop::collection::vec(0.15..0.85_f32, 18),
    ) {
        core_is_found::<GltfPbr>(&shares)?;
        core_is_found::<OpenPbr>(&shares)?;
        core_is_found::<Principled>(&shares)?;
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, max_shrink_iters: 0, ..ProptestConfig::default() })]

    #[test]
    fn models_that_layer_by_albedo_reflect_no_more_than_they_receive(
        shares in prop::collection::vec(0.0..1.0_f32, 18),
    ) {
        let open_pbr = placed::<OpenPbr>(&shares, &all_parts::<OpenPbr>());
        let principled = placed::<Principled>(&shares, &all_parts::<Principled>());
        for brdf in [open_pbr.brdf(), principled.brdf()] {
            prop_assert!(albedo_max(brdf.as_ref()) < 1.03, "{} of {shares:?}", albedo_max(brdf.as_ref()));
        }
    }

    #[test]
    fn any_values_in_range_are_a_reflectance(shares in prop::collection::vec(0.0..=1.0_f32, 18)) {
        let grazing = Directions::from_angles(1.5705, 0.0, 1.5705, std::f32::consts::PI);
        let at: Vec<Directions> = rus32k().iter().step_by(97).copied().chain([grazing]).collect();
        let brdfs = [
            placed::<GltfPbr>(&shares, &all_parts::<GltfPbr>()).brdf(),
            placed::<OpenPbr>(&shares, &all_parts::<OpenPbr>()).brdf(),
            placed::<Principled>(&shares, &all_parts::<Principled>()).brdf(),
        ];
        for brdf in brdfs {
            for f in evaluate(brdf.as_ref(), &at) {
                prop_assert!(f.is_finite() && f.min() >= 0.0, "{f:?} of {shares:?}");
            }
        }
    }

    #[test]
    fn gltf_without_clear_coat_may_exchange_light_and_view(shares in prop::collection::vec(0.0..1.0_f32, 18)) {
        let parts = ["", "KHR_materials_ior", "KHR_materials_specular", "KHR_materials_sheen"];
        let error = reciprocity(placed::<GltfPbr>(&shares, &parts).brdf().as_ref());
        prop_assert!(error < 1e-4, "{error} of {shares:?}");
    }
}

#[test]
fn a_white_rough_metal_gives_back_everything_where_the_model_counts_all_bounces() {
    let white = Rgb::splat(1.0);
    let of = |values: &[f32]| albedo_max(Principled::from_values(values).brdf().as_ref());
    let principled = of(&[&white.0[..], &[1.0, 0.9, 1.5], &white.0, &[0.0, 0.0]].concat());
    assert!((principled - 1.0).abs() < 0.03, "{principled}");
    let gltf = GltfPbr::from_values(&[&white.0[..], &[1.0, 0.9, 1.5, 1.0], &white.0, &[0.0; 6]].concat());
    assert!(albedo_max(gltf.brdf().as_ref()) < 0.9, "single scattering loses light");
}

#[test]
fn parts_are_used_where_they_help_and_only_there() {
    let plastic = [0.3, 0.1, 0.05, 0.0, 0.4, 1.5, 1.0, 1.0, 1.0, 1.0];
    let plain = GltfPbr::from_values(&[&plastic[..], &[0.0; 6]].concat());
    let found = fit::<GltfPbr>(plain.brdf().as_ref()).unwrap();
    assert!(found.parts.len() <= 1 && found.errors.studio_psnr > 45.0, "{found:?}");
    // A coloured metal below: of two colourless lobes either could be the coat.
    let metal = GltfPbr { base_color: Rgb([0.6, 0.2, 0.1]), metallic: 1.0, roughness: 0.6, ..plain };
    let coated = GltfPbr { clearcoat: 1.0, clearcoat_roughness: 0.15, ..metal };
    let found = fit::<GltfPbr>(coated.brdf().as_ref()).unwrap();
    assert!(found.parts.contains(&"KHR_materials_clearcoat"), "{found:?}");
    assert!((found.model.clearcoat_roughness - 0.15).abs() < 0.03 && found.errors.log_error < 5e-3, "{found:?}");
}

#[test]
fn the_same_material_has_the_same_fit_and_one_that_is_not_finite_has_none() {
    let grey = Lambert { albedo: Rgb([0.4, 0.3, 0.2]) };
    let first = fit::<OpenPbr>(&grey).unwrap();
    assert_eq!(first, fit::<OpenPbr>(&grey).unwrap());
    assert!(first.errors.studio_psnr > 35.0, "{first:?}");
    assert!(fit::<OpenPbr>(&Lambert { albedo: Rgb::splat(f32::NAN) }).is_none());
}

const ERRORS: FitErrors =
    FitErrors { log_error: 0.0123, relative_log: 0.2, studio_psnr: 31.2, studio_delta_e_itp: 4.5 };

fn open_pbr() -> OpenPbr {
    let [base_color, specular_color] = [Rgb([0.25, 0.125, 0.0]), Rgb::splat(1.0)];
    let [metalness, roughness, diffuse_roughness, ior, coat, coat_roughness] = [0.5, 0.3, 0.0, 1.6, 0.75, 0.1];
    OpenPbr { base_color, metalness, roughness, diffuse_roughness, specular_color, ior, coat, coat_roughness }
}

fn principled() -> Principled {
    let [base_color, specular_tint] = [Rgb([0.25, 0.125, 0.0]), Rgb::splat(1.0)];
    Principled { base_color, metallic: 0.5, roughness: 0.3, ior: 1.6, specular_tint, coat: 0.75, coat_roughness: 0.1 }
}

#[test]
fn files_are_as_their_readers_elsewhere_accept_them() {
    // scripts/tests/test_parametric.py gives these files to MaterialX and to Python.
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    assert_eq!(text(open_pbr().write("car paint & co", &ERRORS)), golden("car_paint.mtlx"));
    assert_eq!(text(principled().write_python("car paint & co", &ERRORS)), golden("car_paint.py"));
}

proptest! {
    /// Of a part without weight nothing is written, since nothing of it is seen: no share is 0.
    #[test]
    fn what_is_written_is_read_back(shares in prop::collection::vec(0.1..1.0_f32, 18)) {
        fn tenth<M: ShadingModel>(shares: &[f32]) -> M {
            let model = placed::<M>(shares, &all_parts::<M>());
            M::from_values(&model.values().iter().map(|v| (v * 1e3).round() / 1e3).collect::<Vec<_>>())
        }
        let near = |a: Vec<f32>, b: Vec<f32>| a.iter().zip(&b).all(|(a, b)| (a - b).abs() < 1e-6);
        let gltf = tenth::<GltfPbr>(&shares);
        prop_assert!(near(GltfPbr::read(&gltf.write("a", &ERRORS)).unwrap().values(), gltf.values()));
        let open_pbr = tenth::<OpenPbr>(&shares);
        prop_assert!(near(OpenPbr::read(&open_pbr.write("a", &ERRORS)).unwrap().values(), open_pbr.values()));
        let principled = tenth::<Principled>(&shares);
        prop_assert!(near(Principled::read(&principled.write("a", &ERRORS)).unwrap().values(), principled.values()));
    }
}

#[test]
fn what_is_no_such_file_is_refused_with_the_reason() {
    let said = |error: FileError| error.to_string();
    assert!(said(GltfPbr::read(b"{").unwrap_err()).contains("a .gltf file"));
    assert!(said(GltfPbr::read(b"{}").unwrap_err()).contains("expected a material"));
    let odd = br#"{"materials":[{"pbrMetallicRoughness":{"metallicFactor":"much"}}]}"#;
    assert!(said(GltfPbr::read(odd).unwrap_err()).contains("a number of 0 to 1 for 'metallicFactor'"));
    assert!(said(OpenPbr::read(b"<materialx/>").unwrap_err()).contains("an open_pbr_surface"));
    let odd = br#"<materialx><open_pbr_surface><input name="base_color" value="1, 2"/></open_pbr_surface></materialx>"#;
    assert!(said(OpenPbr::read(odd).unwrap_err()).contains("three numbers of 0 to 1 for 'base_color', found '1, 2'"));
    assert!(said(Principled::read(b"[]").unwrap_err()).contains("'inputs'"));
    let glass = said(Principled::read(br#"{"inputs":{"IOR":0.5}}"#).unwrap_err());
    assert!(glass.contains("a number of 1 to 100 for 'IOR', found 0.5"), "{glass}");
}
