use std::f64::consts::{PI, TAU};

use super::*;
use crate::{
    brdf::{ggx::Ggx, lambert::Lambert},
    sampler::{cosine::Cosine, uniform::Uniform},
};

const WHITE: Lambert = Lambert { albedo: Rgb::splat(1.0) };
const GLOSSY: Ggx = Ggx { diffuse: Rgb([0.2, 0.1, 0.05]), f0: Rgb([0.3, 0.5, 0.9]), alpha: 0.3 };
const SIZE: usize = 8;

/// A bright patch on the upper left of the viewer in a dim, tinted room.
fn room() -> Environment {
    let pixel = |i: usize| match (i % 16, i / 16) {
        (9 | 10, 2) => Rgb([20.0, 16.0, 10.0]),
        (x, y) => Rgb([0.1, 0.02 * x as f32, 0.05 * y as f32]),
    };
    Environment::new(Image::new(16, 8, (0..128).map(pixel).collect())).unwrap()
}

fn rendered(environment: &Environment, brdf: &dyn Brdf, sampler: &dyn Sampler, passes: u32) -> Image {
    let mut progressive = Progressive::new(SIZE, environment.clone(), 3);
    (0..passes).for_each(|_| progressive.pass(brdf, sampler));
    progressive.image()
}

/// The sum over even parts of each pixel of the map, from the definition of its orientation.
fn quadrature(environment: &Environment, brdf: &dyn Brdf) -> Image {
    let (map, parts) = (environment.map(), 24);
    let (columns, rows) = (map.width() * parts, map.height() * parts);
    let shade = |surface: Surface| {
        let to_surface = surface.to_view().transpose();
        let mut sum = [0.0; 3];
        for (column, row) in (0..columns).flat_map(|column| (0..rows).map(move |row| (column, row))) {
            let longitude = PI - TAU * (column as f64 + 0.5) / columns as f64;
            let polar = PI * (row as f64 + 0.5) / rows as f64;
            let towards = DVec3::new(polar.sin() * longitude.sin(), polar.cos(), polar.sin() * longitude.cos());
            let solid_angle = TAU / columns as f64 * PI / rows as f64 * polar.sin();
            let at = Directions::new((to_surface * towards).as_vec3(), (to_surface * DVec3::Z).as_vec3());
            if at.is_above() {
                let (value, radiance) = (brdf.eval(at), map.get(column / parts, row / parts));
                for channel in 0..3 {
                    let light = f64::from(radiance[channel]) * f64::from(at.light.z) * solid_angle;
                    sum[channel] += f64::from(value[channel]) * light;
                }
            }
        }
        Rgb(sum.map(|sum| sum as f32))
    };
    let pixel = |i: usize| Surfaces::sphere(SIZE).at(i % SIZE, i / SIZE).map_or(Rgb::BLACK, shade);
    Image::new(SIZE, SIZE, (0..SIZE * SIZE).map(pixel).collect())
}

/// Root of the mean squared difference over all channels, relative to the mean of `reference`.
fn error(image: &Image, reference: &Image) -> f64 {
    let flat = |image: &Image| image.pixels().iter().flat_map(|pixel| pixel.0.map(f64::from)).collect::<Vec<_>>();
    let (image, reference) = (flat(image), flat(reference));
    let squared: f64 = image.iter().zip(&reference).map(|(a, b)| (a - b) * (a - b)).sum();
    (squared / image.len() as f64).sqrt() / (reference.iter().sum::<f64>() / reference.len() as f64)
}

#[test]
fn a_white_sphere_in_a_white_furnace_shows_one() {
    let furnace = Environment::new(Image::new(8, 4, vec![Rgb::splat(1.0); 32])).unwrap();
    let image = rendered(&furnace, &WHITE, &Cosine, 1024);
    for (i, pixel) in image.pixels().iter().enumerate() {
        let expected = if Surfaces::sphere(SIZE).at(i % SIZE, i / SIZE).is_some() { 1.0 } else { 0.0 };
        assert!(pixel.0.iter().all(|value| (value - expected).abs() < 3e-3), "{pixel:?}");
    }
}

#[test]
fn passes_converge_to_the_integral_for_lambert_and_ggx() {
    for brdf in [&WHITE as &dyn Brdf, &GLOSSY] {
        let error = error(&rendered(&room(), brdf, &Cosine, 4096), &quadrature(&room(), brdf));
        assert!(error < 3e-3, "{error}");
    }
}

#[test]
fn a_turned_map_is_the_turned_map() {
    let turned = room().rotated(TAU / 16.0 * 3.0);
    let moved = |i: usize| room().map().get((i % 16 + 3) % 16, i / 16);
    let by_hand = Environment::new(Image::new(16, 8, (0..128).map(moved).collect())).unwrap();
    let error = error(&rendered(&turned, &GLOSSY, &Cosine, 4096), &quadrature(&by_hand, &GLOSSY));
    assert!(error < 3e-3, "{error}");
}

#[test]
fn four_times_the_passes_leave_less_than_half_the_error() {
    let exact = quadrature(&room(), &GLOSSY);
    let errors = [4, 16, 64, 256, 1024].map(|passes| error(&rendered(&room(), &GLOSSY, &Cosine, passes), &exact));
    assert!(errors.windows(2).all(|pair| pair[1] < 0.5 * pair[0]), "{errors:?}");
}

#[test]
fn a_bad_sampler_gives_the_same_mean_as_a_good_one() {
    for brdf in [&WHITE as &dyn Brdf, &GLOSSY] {
        let (good, bad) = (rendered(&room(), brdf, &Cosine, 4096), rendered(&room(), brdf, &Uniform, 4096));
        assert!(error(&bad, &good) < 5e-3, "{}", error(&bad, &good));
    }
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| rendered(&Environment::softboxes(), &GLOSSY, &Cosine, 3))
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn a_restarted_picture_is_as_new_and_seeds_differ() {
    let mut progressive = Progressive::new(SIZE, room(), 1);
    assert_eq!(progressive.image(), Image::black(SIZE, SIZE));
    progressive.pass(&WHITE, &Uniform);
    progressive.restart();
    assert_eq!((progressive.passes(), progressive.image()), (0, Image::black(SIZE, SIZE)));
    progressive.pass(&GLOSSY, &Cosine);
    let mut fresh = Progressive::new(SIZE, room(), 1);
    fresh.pass(&GLOSSY, &Cosine);
    assert_eq!((progressive.passes(), progressive.image()), (1, fresh.image()));
    let mut other = Progressive::new(SIZE, room(), 2);
    other.pass(&GLOSSY, &Cosine);
    assert_ne!(other.image(), fresh.image());
}

#[test]
fn a_picture_without_pixels_and_a_room_without_light_are_fine() {
    let mut none = Progressive::new(0, room(), 0);
    none.pass(&WHITE, &Cosine);
    assert!(none.image().pixels().is_empty());
    let dark = Environment::new(Image::black(2, 1)).unwrap();
    assert_eq!(rendered(&dark, &WHITE, &Cosine, 2), Image::black(SIZE, SIZE));
}

#[test]
fn in_a_white_furnace_a_plane_shows_one_and_a_mesh_is_darker_in_its_folds() {
    use crate::render::{Frame, Model};
    let furnace = Environment::new(Image::new(8, 4, vec![Rgb::splat(1.0); 32])).unwrap();
    let mean = |model: Model| {
        let surfaces = Arc::new(Surfaces::new(16, &model, Frame::WHOLE));
        let mut picture = Progressive::of(Arc::clone(&surfaces), furnace.clone(), 3);
        (0..256).for_each(|_| picture.pass(&WHITE, &Cosine));
        let image = picture.image();
        let seen = (0..256).filter(|i| surfaces.at(i % 16, i / 16).is_some()).map(|i| f64::from(image.pixels()[i][1]));
        let seen: Vec<f64> = seen.collect();
        seen.iter().sum::<f64>() / seen.len() as f64
    };
    let (plane, knot) = (mean(Model::Plane), mean(Model::Mesh(Arc::new(crate::scene::Mesh::knot()))));
    assert!((plane - 1.0).abs() < 5e-3, "{plane}");
    assert!(knot > 0.5 && knot < 0.95, "{knot}");
}
