//! Pictures of one material.

use nbrdf_core::render::Environment;
use nbrdf_core::{Image, Rgb};

use super::chrome_npz;
use super::support::Place;

#[test]
fn render_writes_png_and_exr_of_names_files_and_codes() {
    let place = Place::new();
    place.write("mine.npz", &chrome_npz());
    place.run(&["encode", "chrome", "-o", "code.json"]).ok();
    for (material, output) in [("chrome", "a.png"), ("mine.npz", "b.exr"), ("code.json", "c.png")] {
        place.run(&["render", material, "-o", output, "--size", "32", "--light", "point"]).ok();
    }
    assert!(place.file("a.png").starts_with(b"\x89PNG"));
    assert!(place.file("b.exr").starts_with(b"\x76\x2f\x31\x01"));
    place.run(&["render", "chrome", "-o", "d.png", "--size", "32", "--exposure", "-2"]).ok();
    assert_ne!(place.file("d.png"), place.file("a.png"));
    for wrong in [["--size", "0"], ["--size", "4097"], ["--light", "moon"], ["--exposure", "nan"]] {
        place.run(&["render", "chrome", "-o", "e.png", wrong[0], wrong[1]]).fails(2);
    }
}

#[test]
fn an_environment_lights_the_sphere_the_same_for_the_same_seed() {
    let place = Place::new();
    Environment::softboxes().map().write_exr(&place.path().join("room.exr")).unwrap();
    let render = |output: &str, more: &[&str]| {
        let usual = ["render", "chrome", "-o", output, "--size", "32", "--samples", "4", "--json"];
        let report = place.run(&[&usual, more].concat()).json();
        (place.file(output), report)
    };
    let (picture, report) = render("a.png", &["--environment", "softboxes", "--seed", "1"]);
    let environment = &report["environment"];
    assert_eq!((&environment["map"], &environment["samples"]), (&"softboxes".into(), &4.into()));
    assert!(report["light"].is_null());
    let same = ["--environment", "room.exr", "--seed", "1", "--threads", "1"];
    assert_eq!(render("b.png", &same).0, picture);
    assert_ne!(render("c.png", &["--environment", "softboxes", "--seed", "2"]).0, picture);
    assert_ne!(render("d.png", &["--environment", "softboxes", "--seed", "1", "--rotate", "-90"]).0, picture);
}

#[test]
fn environments_that_are_none_exit_with_3_and_misused_switches_with_2() {
    let place = Place::new();
    Image::black(4, 4).write_exr(&place.path().join("square.exr")).unwrap();
    let mut map = Image::black(4, 2);
    map.pixels_mut()[5] = Rgb([0.0, f32::NAN, 0.0]);
    map.write_exr(&place.path().join("nan.exr")).unwrap();
    Environment::softboxes().map().write_exr(&place.path().join("room.exr")).unwrap();
    place.write("cut.exr", &place.file("room.exr")[..5000]);
    place.write("huge.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 32768\n");
    place.write("notes.hdr", b"hello");
    let before = place.names();
    let cases = [
        ("square.exr", "twice as wide as high"),
        ("nan.exr", "column 1, row 1"),
        ("cut.exr", "cut off"),
        ("huge.hdr", "32768 x 16384"),
        ("notes.hdr", "Radiance"),
        ("missing.hdr", "missing.hdr: "),
    ];
    for (map, expected) in cases {
        let said = place.run(&["render", "chrome", "-o", "x.png", "--environment", map]).fails(3);
        assert!(said.contains(map) && said.contains(expected), "{said}");
    }
    let lit = ["render", "chrome", "-o", "x.png", "--environment", "softboxes"];
    for wrong in [["--light", "point"], ["--samples", "0"], ["--rotate", "nan"], ["--rotate", "400"]] {
        place.run(&[&lit[..], &wrong].concat()).fails(2);
    }
    for wrong in [["--samples", "4"], ["--rotate", "4"], ["--environment", "softbox"]] {
        place.run(&[&lit[..4], &wrong].concat()).fails(2);
        place.run(&[&lit[..4], &wrong, &["--light", "point"]].concat()).fails(2);
    }
    assert_eq!(place.names(), before);
}
