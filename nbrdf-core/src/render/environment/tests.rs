use std::f64::consts::{PI, TAU};

use rand::RngExt;

use super::*;
use crate::nbrdf::fit::generator;

/// A dim sky with a gradient, a sun, and black ground.
fn outdoors() -> Environment {
    let pixel = |i: usize| match (i % 32, i / 32) {
        (5, 3) => Rgb([900.0, 800.0, 700.0]),
        (x, y) if y < 9 => Rgb([0.2, 0.3 + 0.02 * x as f32, 0.6]),
        _ => Rgb::BLACK,
    };
    Environment::new(Image::new(32, 16, (0..512).map(pixel).collect())).unwrap()
}

fn constant(radiance: f32) -> Environment {
    Environment::new(Image::new(8, 4, vec![Rgb::splat(radiance); 32])).unwrap()
}

/// Centre of cell (i, j) of an even division of the sphere by cos θ from +z and azimuth, and its solid angle.
fn cell(i: usize, j: usize, n: usize) -> (Vec3, f64) {
    let z = 1.0 - (2 * i + 1) as f64 / n as f64;
    let (sin, cos) = ((j as f64 + 0.5) / (2 * n) as f64 * TAU).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    (DVec3::new(radius * cos, radius * sin, z).as_vec3(), 4.0 * PI / (2 * n * n) as f64)
}

#[test]
fn the_density_integrates_to_one() {
    for environment in [outdoors(), outdoors().rotated(1.0), constant(2.0), constant(0.0), Environment::softboxes()] {
        let n = 1200;
        let cells = (0..n).flat_map(|i| (0..2 * n).map(move |j| cell(i, j, n)));
        let sum: f64 = cells.map(|(direction, solid_angle)| environment.pdf(direction) * solid_angle).sum();
        assert!((sum - 1.0).abs() < 2e-3, "{sum}");
    }
}

#[test]
fn a_constant_map_is_drawn_from_evenly_and_so_is_a_black_one() {
    for environment in [constant(3.0), constant(0.0)] {
        assert!((environment.pdf(Vec3::Z) - 0.25 / PI).abs() < 1e-9);
        let drawn = environment.sample([0.3, 0.7]);
        assert!((drawn.pdf - 0.25 / PI).abs() < 1e-9 && (drawn.direction.length() - 1.0).abs() < 1e-6);
    }
}

/// Pearson's test over cells that do not follow the pixels; the bound is four standard deviations above the mean.
#[test]
fn samples_follow_the_density() {
    for (seed, environment) in [outdoors(), outdoors().rotated(2.0), constant(0.0)].into_iter().enumerate() {
        let (n, fine, samples) = (8, 512, 200_000);
        let place = |d: Vec3| {
            let i = ((1.0 - d.z) / 2.0 * n as f32) as usize;
            let j = ((d.y.atan2(d.x) / TAU as f32).rem_euclid(1.0) * 2.0 * n as f32) as usize;
            i.min(n - 1) * 2 * n + j.min(2 * n - 1)
        };
        let mut expected = vec![0.0; 2 * n * n];
        for (direction, solid_angle) in (0..fine).flat_map(|i| (0..2 * fine).map(move |j| cell(i, j, fine))) {
            expected[place(direction)] += environment.pdf(direction) * solid_angle * f64::from(samples);
        }
        let mut found = vec![0.0; 2 * n * n];
        let mut rng = generator(seed as u64, 0);
        for _ in 0..samples {
            let drawn = environment.sample([rng.random(), rng.random()]);
            assert_eq!(drawn.pdf > 0.0, drawn.radiance.max() > 0.0 || environment.map().pixels()[0] == Rgb::BLACK);
            found[place(drawn.direction)] += 1.0;
        }
        let cells = expected.iter().zip(&found).filter(|(expected, _)| **expected > 5.0);
        let (freedom, chi2) = cells.fold((0.0, 0.0), |(n, sum), (e, f)| (n + 1.0, sum + (f - e) * (f - e) / e));
        let bound = freedom + 4.0 * (2.0_f64 * freedom).sqrt();
        assert!(chi2 < bound && freedom > 20.0, "{chi2} over {freedom} cells");
    }
}

#[test]
fn a_drawn_direction_is_looked_up_as_it_was_drawn() {
    let environment = outdoors().rotated(0.7);
    let mut rng = generator(1, 0);
    let same = (0..10_000).filter(|_| {
        let drawn = environment.sample([rng.random(), rng.random()]);
        environment.look(drawn.direction) == drawn
    });
    assert!(same.count() > 9990, "all but those that rounding takes over an edge");
}

#[test]
fn known_pixels_are_found_in_their_directions() {
    let colour = |i: usize| Rgb([(i % 8) as f32, (i / 8) as f32, 1.0]);
    let environment = Environment::new(Image::new(8, 4, (0..32).map(colour).collect())).unwrap();
    let at = |x: f32, y: f32, z: f32| environment.radiance(Vec3::new(x, y, z).normalize());
    assert_eq!(at(-0.1, 0.1, 1.0), Rgb([4.0, 1.0, 1.0]), "centre column, above the horizon");
    assert_eq!(at(1.0, -0.1, -0.1), Rgb([1.0, 2.0, 1.0]), "a quarter from the left, below");
    assert_eq!(at(-1.0, 0.1, -0.1), Rgb([6.0, 1.0, 1.0]), "a quarter from the right");
    assert_eq!(at(0.1, 5.0, -1.0), Rgb([0.0, 0.0, 1.0]), "top left");
}

#[test]
fn a_turn_takes_light_from_the_viewer_to_the_right() {
    let turned = outdoors().rotated(PI / 2.0);
    assert_eq!(turned.radiance(Vec3::new(1.0, 0.5, 0.1)), outdoors().radiance(Vec3::new(-0.1, 0.5, 1.0)));
    assert_eq!(outdoors().rotated(1.0).rotated(0.0).radiance(Vec3::Z), outdoors().radiance(Vec3::Z));
}

#[test]
fn other_shapes_and_pixels_that_are_no_radiance_are_refused_with_their_place() {
    for (width, height) in [(0, 0), (4, 3), (3, 3), (2, 0)] {
        let found = Environment::new(Image::black(width, height)).unwrap_err();
        assert_eq!(found, EnvironmentProblem::Shape { width, height });
    }
    for value in [f32::NAN, f32::INFINITY, -0.5] {
        let mut map = Image::black(4, 2);
        map.pixels_mut()[6] = Rgb([0.0, 1.0, value]);
        let said = Environment::new(map).unwrap_err().to_string();
        assert!(said.contains(&format!("found {value} in the blue of column 2, row 1")), "{said}");
    }
}

#[test]
fn the_largest_numbers_are_radiances_too() {
    let environment = constant(f32::MAX);
    assert!((environment.sample([0.5, 0.5]).pdf - 0.25 / PI).abs() < 1e-9);
}

#[test]
fn files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("square.exr");
    Image::black(2, 2).write_exr(&path).unwrap();
    let said = Environment::load(&path).unwrap_err().to_string();
    assert!(said.contains("square.exr: expected a latitude-longitude map") && said.contains("2 x 2"), "{said}");
    assert!(Environment::load(&folder.path().join("none.hdr")).unwrap_err().to_string().contains("none.hdr"));
    outdoors().map().write_exr(&path).unwrap();
    assert_eq!(Environment::load(&path).unwrap().map(), outdoors().map());
}

#[test]
fn every_name_is_known() {
    assert!(Environment::NAMES.iter().all(|name| Environment::by_name(name).is_some()));
    assert!(Environment::by_name("moon").is_none());
}
