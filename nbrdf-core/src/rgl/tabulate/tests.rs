use super::*;
use crate::brdf::lambert::Lambert;
use crate::library::builtin;
use crate::rgl::fields::Fields;

/// In place of many: two metals of narrow highlights, a mirror-like dark one, a plastic, a fabric.
const MATERIALS: [&str; 5] = ["chrome", "steel", "black-obsidian", "blue-acrylic", "red-fabric"];

#[test]
fn spheres_of_a_written_table_keep_their_light_within_a_percent() {
    for name in MATERIALS {
        let network = &builtin::shared().get(name).unwrap().network;
        let Tabulated { file, resolution, error } = tabulated_within(network, 0.01, name);
        let table = RglTable::parse(&file).unwrap();
        assert!(table.is_isotropic() && resolution.side <= 96, "{name}: {resolution:?}");
        let mut worst = 0.0_f64;
        for sphere in [Sphere::point(), Sphere::studio()] {
            let errors = LinearErrors::of(&sphere.render(network), &sphere.render(&table), sphere.covered());
            assert!(errors.of_mean <= errors.of_pixels && errors.of_pixels <= 0.01, "{name}: {errors:?}");
            worst = worst.max(errors.of_pixels);
        }
        assert_eq!(error, worst, "{name}");
    }
}

#[test]
fn a_table_that_is_not_close_enough_says_how_far_it_is() {
    let chrome = &builtin::shared().get("chrome").unwrap().network;
    let Tabulated { resolution, error, .. } = tabulated_within(chrome, 1e-6, "chrome");
    assert_eq!(Some(&resolution), Resolution::LADDER.last());
    assert!(error > 1e-6 && error < 0.01, "{error}");
}

#[test]
fn a_larger_table_is_closer() {
    let network = &builtin::shared().get("chrome").unwrap().network;
    let tabulation = Tabulation::new(network);
    let sphere = Sphere::studio();
    let picture = sphere.render(network);
    let error = |resolution| {
        let table = RglTable::parse(&tabulation.to_bytes(resolution, "chrome")).unwrap();
        LinearErrors::of(&picture, &sphere.render(&table), sphere.covered()).of_pixels
    };
    let [coarse, fine] = [Resolution { eyes: 24, side: 48 }, Resolution { eyes: 48, side: 96 }].map(error);
    assert!(fine < 0.5 * coarse, "{coarse}, {fine}");
}

#[test]
fn places_crowd_towards_the_normal_of_a_gloss_and_towards_grazing_eyes() {
    let gloss = &builtin::shared().get("black-obsidian").unwrap().network;
    let tabulation = Tabulation::new(gloss);
    let (half, _) = tabulation.halves.place(0.5);
    assert!(half < 0.5, "half of the places lie below √θ = {half}");
    let (eye, _) = tabulation.eyes.place(0.5);
    assert!(eye > 0.55, "half of the eyes are steeper than {eye} of 90°");
}

#[test]
fn what_is_drawn_is_what_is_reflected() {
    // A white Lambertian: luminance × density of the warp / Jacobian is cos θ / π but for its scale.
    let white = Lambert { albedo: Rgb::splat(1.0) };
    let tabulation = Tabulation::new(&white);
    let resolution = Resolution { eyes: 8, side: 32 };
    let file = tabulation.to_bytes(resolution, "");
    let fields = Fields::parse(&file).unwrap();
    let (luminance, rgb) = (fields.floats("luminance").unwrap(), fields.floats("rgb").unwrap());
    assert!(rgb.values.iter().all(|&value| value >= 0.0));
    for eye in [0, 5] {
        let theta = tabulation.eyes.place(eye as f64 / 7.0).0 * LAST_EYE;
        let mut scales = Vec::new();
        for (row, column) in [(3, 9), (16, 12), (28, 15), (20, 5)] {
            let (along, density) = tabulation.halves.place(column as f64 / 31.0);
            let place = Place::new(theta, along, (2.0 * row as f64 / 31.0 - 1.0) * PI);
            let at = row * 32 + column;
            let (drawn, value) = (luminance.values[eye * 1024 + at], rgb.values[eye * 3 * 1024 + at]);
            assert!((f64::from(value) - f64::from(place.at.light.z.max(0.0)) / PI).abs() < 1e-6);
            if value > 0.05 {
                scales.push(f64::from(drawn) * density / place.jacobian(along) / f64::from(value));
            }
        }
        assert!(scales.len() > 1 && scales.iter().all(|scale| (scale / scales[0] - 1.0).abs() < 0.02), "{scales:?}");
    }
}

#[test]
fn what_is_black_or_no_number_is_written_as_black() {
    struct Constant(f32);
    impl Brdf for Constant {
        fn eval(&self, _: Directions) -> Rgb {
            Rgb::splat(self.0)
        }
    }
    for value in [0.0, f32::NAN, f32::INFINITY] {
        let file = Tabulation::new(&Constant(value)).to_bytes(Resolution { eyes: 4, side: 8 }, "black");
        let table = RglTable::parse(&file).unwrap();
        let up = Directions::new(crate::Vec3::Z, crate::Vec3::Z);
        assert_eq!(table.eval(up), Rgb::BLACK, "{value}");
        let luminance = Fields::parse(&file).unwrap().floats("luminance").unwrap();
        assert!(luminance.values.iter().all(|&value| value > 0.0));
    }
}
