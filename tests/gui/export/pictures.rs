//! Pictures, strips and curves that are written.

use std::process::Command;
use std::sync::Arc;

use nbrdf::gui::session::PictureForm;
use nbrdf::worker::Shape;
use nbrdf_core::Image;
use nbrdf_core::image::Tone;
use nbrdf_core::library::builtin;
use nbrdf_core::render::{Frame, Light, Model, Sphere, Surfaces};

use super::*;

#[test]
fn pictures_strips_and_curves_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut harness = built_in(writing(folder));
    choose(&mut harness, What::Picture);
    write(&mut harness);
    assert_eq!(manifest(folder)["size"], 32);
    let png = std::fs::read(folder.join("out.png")).unwrap();
    assert_eq!((&png[1..4], &png[16..24]), (&b"PNG"[..], &[0, 0, 0, 32, 0, 0, 0, 32][..]));
    harness.state_mut().session.export.picture = PictureForm::Exr;
    harness.state_mut().session.export.name = "linear".to_owned();
    choose(&mut harness, What::Strip);
    let said = write(&mut harness);
    let strip = Image::read(&folder.join("linear.exr")).unwrap_or_else(|error| panic!("{said}: {error}"));
    assert_eq!((strip.width(), strip.height()), (3 * 32, 32));
    harness.state_mut().session.export.name = "curve".to_owned();
    choose(&mut harness, What::Curve);
    let said = write(&mut harness);
    let text = std::fs::read_to_string(folder.join("curve.csv")).unwrap_or_else(|error| panic!("{said}: {error}"));
    let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines.len(), 4);
    assert!(lines.iter().all(|line| line.len() == lines[0].len()), "{text}");
    assert_eq!(lines[2][..4], ["raw_weights", "0.5", "0.5", "0.5"]);
}

#[test]
fn a_picture_is_in_the_shape_the_frame_and_the_tone_curve_that_are_shown() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut session = writing(folder);
    session.export.card = "A".to_owned();
    session.look.show_on(Shape::Plane);
    let frame = Frame::WHOLE.zoomed(2.0, [0.3, -0.2]);
    session.look.scenery.frame = frame;
    (session.look.tone, session.look.exposure) = (Tone::Filmic, 1.0);
    let mut harness = built_in(session);
    choose(&mut harness, What::Picture);
    write(&mut harness);
    let told = manifest(folder);
    assert!(told["shape"]["name"] == "plane" && told["frame"]["zoom"] == 2.0 && told["tone"] == "Filmic", "{told}");
    assert!(told["command"].as_str().unwrap().contains("on a plane"), "{told}");
    let surfaces = Arc::new(Surfaces::new(32, &Model::Plane, frame));
    let gold = builtin::shared().get("gold-paint").unwrap().material();
    let linear = Sphere::of(surfaces, &Light::studio()).render(gold.brdf.as_ref());
    let (shown, mut bytes) = (linear.map(|pixel| pixel.map(|v| Tone::Filmic.shown(2.0 * v))), Vec::new());
    linear.toned_bytes_into(2.0, Tone::Filmic, &mut bytes);
    assert_eq!(shown.display_bytes(), bytes);
    assert!(std::fs::read(folder.join("out.png")).unwrap() == shown.png_bytes().unwrap());
    harness.state_mut().session.export.picture = PictureForm::Exr;
    harness.state_mut().session.export.name = "linear".to_owned();
    harness.run_steps(2);
    choose(&mut harness, What::Picture);
    let said = write(&mut harness);
    let read = Image::read(&folder.join("linear.exr")).unwrap_or_else(|error| panic!("{said}: {error}"));
    assert_eq!(read, linear.map(|pixel| pixel * 2.0));
}

#[test]
#[cfg(unix)]
fn the_command_of_a_manifest_draws_the_same_strip() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = built_in(writing(folder.path()));
    choose(&mut harness, What::Strip);
    write(&mut harness);
    let manifest = manifest(folder.path());
    let again = tempfile::tempdir().unwrap();
    let programs = Path::new(env!("CARGO_BIN_EXE_nbrdf")).parent().unwrap();
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    let shell = shell.arg("-c").arg(manifest["command"].as_str().unwrap()).env("PATH", path);
    assert!(shell.current_dir(again.path()).output().unwrap().status.success(), "{manifest}");
    let [ours, theirs] = [&folder, &again].map(|folder| std::fs::read(folder.path().join("out.png")).unwrap());
    assert!(ours == theirs, "{}", manifest["command"]);
}
