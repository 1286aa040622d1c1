//! Our figures against those of other programs; `scripts/golden/metrics.py` says which and how.

use nbrdf_core::{
    Brdf, Image, Rgb,
    brdf::ggx::Ggx,
    metric::{
        ItpImage, LogError, Metric, RelativeLog, delta_e_itp_map, directional_albedo, flip_map, hue_excursion,
        image_errors,
    },
    render::Sphere,
    sampling::rus32k,
};
use serde_json::Value;

fn golden() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/golden/metrics.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn triple(value: &Value) -> [f64; 3] {
    std::array::from_fn(|i| number(&value[i]))
}

fn assert_close(found: f64, expected: &Value, tolerance: f64, what: &str) {
    let expected = number(expected);
    assert!((found - expected).abs() <= tolerance, "{what}: found {found}, expected {expected}");
}

fn image(case: &Value, key: &str, levels: f64) -> Image {
    let hex = case[key].as_str().unwrap();
    let channel = |i: usize| (f64::from(u8::from_str_radix(&hex[2 * i..2 * i + 2], 16).unwrap()) / levels) as f32;
    let pixels = (0..hex.len() / 6).map(|i| Rgb([channel(3 * i), channel(3 * i + 1), channel(3 * i + 2)])).collect();
    Image::new(case["width"].as_u64().unwrap() as usize, case["height"].as_u64().unwrap() as usize, pixels)
}

fn inscribed_disc(width: usize, height: usize) -> Vec<bool> {
    let offset = |i: usize, size: usize| 2 * i as i64 + 1 - size as i64;
    let inside = |i: usize| {
        offset(i % width, width).pow(2) + offset(i / width, height).pow(2) < (width.min(height) as i64).pow(2)
    };
    (0..width * height).map(inside).collect()
}

fn for_each_pair(check: impl Fn(&str, &Value, &Image, &Image, &[bool])) {
    let golden = golden();
    let levels = number(&golden["levels"]);
    for case in golden["images"].as_array().unwrap() {
        let (f, g) = (image(case, "reference", levels), image(case, "other", levels));
        check(case["name"].as_str().unwrap(), case, &f, &g, &inscribed_disc(f.width(), f.height()));
    }
}

#[test]
fn image_errors_agree_with_other_programs() {
    for_each_pair(|name, case, f, g, covered| {
        let errors = image_errors(f, g, covered);
        assert_close(errors.mae, &case["mae"], 1e-6, &format!("{name} mae"));
        assert_close(errors.rmse, &case["rmse"], 1e-6, &format!("{name} rmse"));
        assert_close(errors.psnr, &case["psnr"], 1e-4, &format!("{name} psnr, scikit-image"));
        assert_close(errors.ssim, &case["ssim"], 1e-5, &format!("{name} ssim, scikit-image"));
        assert_close(errors.flip, &case["flip"], 2e-5, &format!("{name} flip, flip-evaluator"));
        assert_close(errors.delta_e_itp, &case["delta_e_itp"], 2e-3, &format!("{name} delta_e_itp, colour-science"));
    });
}

#[test]
fn the_worst_pixel_agrees_with_other_programs() {
    for_each_pair(|name, case, f, g, _| {
        let largest = |map: Vec<f32>| f64::from(map.into_iter().fold(0.0, f32::max));
        assert_close(largest(flip_map(&f.displayed(), &g.displayed())), &case["flip_max"], 1e-4, name);
        assert_close(largest(delta_e_itp_map(f, g)), &case["delta_e_itp_max"], 5e-3, name);
    });
}

#[test]
fn mean_chromaticities_are_those_of_colour_science() {
    for_each_pair(|name, case, f, g, covered| {
        // A path that comes back has a segment of length 0: its excursion is the distance between the two colours.
        let found = hue_excursion(&[f.clone(), g.clone(), f.clone()], covered);
        let difference = |i: usize| number(&case["uv_reference"][i]) - number(&case["uv_other"][i]);
        let expected = difference(0).hypot(difference(1));
        assert!((found - expected).abs() < 1e-6, "{name}: found {found}, expected {expected}");
    });
}

#[test]
fn kept_pictures_give_the_same_colour_difference() {
    for_each_pair(|name, case, f, g, covered| {
        let found = ItpImage::new(f).distance(&ItpImage::new(g), covered);
        assert_close(found, &case["delta_e_itp"], 2e-3, name);
    });
}

fn ggx(case: &Value) -> Ggx {
    let rgb = |value: &Value| Rgb(triple(value).map(|v| v as f32));
    Ggx { diffuse: rgb(&case["diffuse"]), f0: rgb(&case["f0"]), alpha: number(&case["alpha"]) as f32 }
}

#[test]
fn the_direction_set_is_that_of_numpy() {
    let expected = &golden()["materials"]["rus32k"];
    assert_eq!(rus32k().len() as u64, expected["count"].as_u64().unwrap());
    for pick in expected["picks"].as_array().unwrap() {
        let at = rus32k()[pick[0].as_u64().unwrap() as usize];
        for (axis, (light, view)) in at.light.to_array().into_iter().zip(at.view.to_array()).enumerate() {
            assert_close(f64::from(light), &pick[1][axis], 1e-6, "light");
            assert_close(f64::from(view), &pick[2][axis], 1e-6, "view");
        }
    }
    for axis in 0..3 {
        let mean = rus32k().iter().map(|at| f64::from(at.light[axis])).sum::<f64>() / rus32k().len() as f64;
        assert_close(mean, &expected["mean_light"][axis], 1e-7, "mean light");
    }
}

#[test]
fn direction_errors_and_ggx_values_agree_with_numpy() {
    let golden = &golden()["materials"];
    let (a, b) = (ggx(&golden["a"]), ggx(&golden["b"]));
    for pick in golden["values_a"].as_array().unwrap() {
        let value = a.eval(rus32k()[pick[0].as_u64().unwrap() as usize]);
        let expected = triple(&pick[1]);
        for channel in 0..3 {
            assert!((f64::from(value[channel]) / expected[channel] - 1.0).abs() < 1e-4, "{value:?} {expected:?}");
        }
    }
    assert_close(LogError.distance(&a, &b), &golden["log_error"], 1e-6, "log_error");
    assert_close(RelativeLog.distance(&a, &b), &golden["relative_log"], 1e-5, "relative_log");
}

#[test]
fn directional_albedos_agree_with_a_much_finer_quadrature() {
    let golden = &golden()["materials"];
    let white = Ggx { diffuse: Rgb::BLACK, f0: Rgb::splat(1.0), alpha: 0.1 };
    for case in golden["albedo"].as_array().unwrap() {
        let name = case[0].as_str().unwrap();
        let material = if name == "white_0.1" { white } else { ggx(&golden[name]) };
        let albedo = directional_albedo(&material, (number(&case[1]) as f32).to_radians());
        for channel in 0..3 {
            assert_close(
                f64::from(albedo[channel]),
                &case[2][channel],
                3e-4,
                &format!("{name} at {} degrees", case[1]),
            );
        }
    }
}

#[test]
fn spheres_agree_with_an_independent_renderer() {
    let golden = &golden()["materials"];
    for (light, sphere) in [("point", Sphere::point()), ("studio", Sphere::studio())] {
        let covered = sphere.covered().iter().filter(|&&on| on).count();
        assert_eq!(covered as u64, golden["covered"].as_u64().unwrap());
        for name in ["a", "b"] {
            let image = sphere.render(&ggx(&golden[name]));
            let expected = &golden["pictures"][format!("{light}_{name}")];
            for channel in 0..3 {
                let sum: f64 = image.pixels().iter().map(|pixel| f64::from(pixel[channel])).sum();
                assert_close(sum / covered as f64, &expected["mean"][channel], 1e-5, &format!("{light} {name} mean"));
            }
            for pixel in expected["pixels"].as_array().unwrap() {
                let at = |i: usize| pixel[i].as_u64().unwrap() as usize;
                let (found, wanted) = (image.get(at(0), at(1)), triple(&pixel[2]));
                for channel in 0..3 {
                    let error = f64::from(found[channel]) / wanted[channel] - 1.0;
                    assert!(error.abs() < 1e-4, "{light} {name} {pixel}: {found:?}");
                }
            }
        }
    }
}
