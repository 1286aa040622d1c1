//! Files that are written from the window, and codes and commands on the clipboard.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use egui::{Event, OutputCommand};
use nbrdf::catalog::{Catalog, Reference};
use nbrdf::gui::session::{Export, PictureForm, Way, What};
use nbrdf::gui::store::{self, Found};
use nbrdf::material::{self, parse_code};
use nbrdf::worker::{Shape, Timing};
use nbrdf_core::hash::sha256;
use nbrdf_core::image::Tone;
use nbrdf_core::library::builtin;
use nbrdf_core::path::clock::Clock;
use nbrdf_core::render::{Frame, Light, Model, Sphere, Surfaces};
use nbrdf_core::{Brdf, Directions, Image, Library, Material, Rgb, Weights};
use serde_json::Value;

use super::*;

/// A session that writes small files named `out` into this folder.
fn writing(folder: &Path) -> Session {
    let folder = folder.display().to_string();
    Session { export: Export { folder, name: "out".to_owned(), size: 32, steps: 3, ..Export::default() }, ..quick() }
}

/// Opens the window and chooses what is written.
fn choose(harness: &mut Harness<'_, Workbench>, what: What) {
    if harness.query_by_label("Write files").is_none() && harness.query_by_label("Export to files").is_none() {
        harness.get_by_label("Export").click();
        harness.run_steps(3);
    }
    harness.get_by_label(what.about()[0]).click();
    harness.run_steps(3);
    assert_eq!(harness.state().session.export.what, what);
    looked(harness);
}

/// Waits until the files that are there are known.
fn looked(harness: &mut Harness<'_, Workbench>) {
    until(harness, "the files are looked for", |bench| {
        let paths = bench.session.job(false).map(|job| job.paths());
        bench.gallery.files.there.as_ref().is_some_and(|[asked, _]| Ok(asked) == paths.as_ref())
    });
}

/// Presses the button and waits for the end.
fn write(harness: &mut Harness<'_, Workbench>) -> String {
    let before = harness.state().gallery.files.ended;
    harness.get_by_label("Write files").click();
    harness.run_steps(2);
    until(harness, "the files are written", |bench| bench.gallery.files.ended > before);
    harness.state_mut().gallery.notices.pop().unwrap_or_default()
}

/// The manifest, which must be right about every file.
fn manifest(folder: &Path) -> Value {
    let text = std::fs::read(folder.join("out.manifest.json")).unwrap();
    let manifest: Value = serde_json::from_slice(&text).unwrap();
    let files = manifest["files"].as_array().unwrap();
    assert!(!files.is_empty());
    for file in files {
        let bytes = std::fs::read(folder.join(file["name"].as_str().unwrap())).unwrap();
        assert_eq!(file["sha256"], sha256(&bytes), "{file}");
    }
    manifest
}

/// A key in a frame of its own, so that what the frame puts out is seen.
fn with_command_and_shift(key: Key) -> Event {
    let modifiers = Modifiers::COMMAND | Modifiers::SHIFT;
    Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
}

/// What is put on the clipboard in the next frames.
fn copied(harness: &mut Harness<'_, Workbench>) -> String {
    let patience = Instant::now() + Duration::from_secs(120);
    loop {
        for command in &harness.output().platform_output.commands {
            if let OutputCommand::CopyText(text) = command {
                return text.clone();
            }
        }
        assert!(Instant::now() < patience, "nothing was copied: {:?}", harness.state().gallery.notices);
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
}

#[test]
fn a_material_is_written_and_its_manifest_tells_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = writing(folder.path());
    session.export.card = "A".to_owned();
    let mut harness = built_in(session);
    choose(&mut harness, What::Material);
    let said = write(&mut harness);
    assert!(said.contains("out.npz") && said.contains("out.manifest.json"), "{said}");
    let read = Library::load(&folder.path().join("out.npz")).unwrap().into_entries();
    assert_eq!(read[0].network.weights(), builtin::shared().get("gold-paint").unwrap().network.weights());
    let manifest = manifest(folder.path());
    assert!(manifest["what"] == "material" && manifest["material"] == "gold-paint", "{manifest}");
    harness.state_mut().session.export.card = "raw_weights".to_owned();
    harness.state_mut().session.export.name = "between".to_owned();
    harness.run_steps(2);
    looked(&mut harness);
    let said = write(&mut harness);
    assert!(said.contains("between.npz"), "{said}");
    let between = Library::load(&folder.path().join("between.npz")).unwrap().into_entries();
    assert_ne!(between[0].network.weights(), read[0].network.weights());
}

#[test]
fn all_materials_along_a_path_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = built_in(writing(folder.path()));
    choose(&mut harness, What::Steps);
    write(&mut harness);
    let manifest = manifest(folder.path());
    assert_eq!(manifest["files"].as_array().unwrap().len(), 3);
    assert_eq!(manifest["methods"][0], "raw_weights");
    let folder = folder.path();
    let weights = |step: usize| {
        Library::load(&folder.join(format!("out_{step:02}.npz")))
            .unwrap()
            .into_entries()
            .remove(0)
            .network
            .into_weights()
    };
    let [first, middle, last] = [0, 1, 2].map(weights);
    for ((first, last), middle) in first.iter().zip(&last).zip(&middle) {
        assert!((0.5 * (first + last) - middle).abs() < 1e-5);
    }
}

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

/// Lines of the table that is written of this session's walk.
fn curve(mut session: Session, folder: &Path, steps: u16) -> Vec<Vec<String>> {
    session.export.steps = steps;
    let mut harness = built_in(session);
    choose(&mut harness, What::Curve);
    let said = write(&mut harness);
    let text = std::fs::read_to_string(folder.join("out.csv")).unwrap_or_else(|error| panic!("{said}: {error}"));
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

#[test]
fn a_walk_goes_around_a_polygon_and_beyond_the_ends_as_film_strips_do() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = writing(folder.path());
    session.blend.choose(2, "chrome");
    session.blend.way = Way::Polygon;
    let lines = curve(session, folder.path(), 4);
    assert_eq!(manifest(folder.path())["tour"], "around");
    assert_eq!(lines.len(), 4);
    for (line, corner) in lines.iter().zip([0, 1, 2, 0]) {
        let weights: Vec<f32> = line[2..5].iter().map(|weight| weight.parse().unwrap()).collect();
        assert!((weights[corner] - 1.0).abs() < 1e-5, "{line:?}");
    }
    let folder = tempfile::tempdir().unwrap();
    let mut session = writing(folder.path());
    session.blend.is_beyond = true;
    let lines = curve(session, folder.path(), 3);
    assert_eq!(lines.iter().map(|line| line[1].as_str()).collect::<Vec<_>>(), ["-0.5", "0.5", "1.5"]);
    assert_eq!(lines[0][2..4], ["1.5", "-0.5"]);
}

#[test]
fn of_an_even_path_between_three_the_weights_of_its_clock_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = writing(folder.path());
    session.blend.choose(2, "chrome");
    (session.blend.timing, session.blend.t) = (Timing::Even, 0.25);
    let mut harness = built_in(session);
    choose(&mut harness, What::Material);
    write(&mut harness);
    let told = manifest(folder.path());
    let ends = ["gold-paint", "blue-acrylic", "chrome"].map(|name| builtin::shared().get(name).unwrap().material());
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let path = catalog.interpolation("raw_weights").unwrap().between(&ends).unwrap();
    let at = Clock::of(path.as_ref(), 3).unwrap().set(0.25);
    assert!((at - 0.25).abs() > 1e-3, "{at}: nothing to tell apart");
    let weights: Vec<f64> = told["weights"].as_array().unwrap().iter().filter_map(Value::as_f64).collect();
    let wanted = Weights::along_spline(at, 3);
    assert_eq!(weights.len(), 3);
    assert!(weights.iter().zip(wanted.as_slice()).all(|(a, b)| (*a as f32 - b).abs() < 1e-6), "{told} {wanted:?}");
    assert_eq!(told["t"], 0.25);
}

#[test]
fn an_edited_code_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = Session { methods: Methods(vec!["latent"]), ..writing(folder.path()) };
    session.blend.edits[0] = 0.25;
    let mut harness = built_in(session);
    choose(&mut harness, What::Material);
    write(&mut harness);
    let told = manifest(folder.path());
    assert_eq!(told["edits"], serde_json::json!({"lightness": 0.25}));
    assert_eq!(told["edited_code"]["code"].as_array().unwrap().len(), 32);
}

#[test]
fn a_stop_while_a_path_is_prepared_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let is_open: Arc<AtomicBool> = Arc::default();
    let (gate, catalog) = (Arc::clone(&is_open), Catalog::new(Arc::new(Reference::built_in())));
    let interpolation = move |name: &str| {
        while !gate.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(5));
        }
        catalog.interpolation(name)
    };
    let stock = Stock { interpolation: Box::new(interpolation), ..Stock::built_in() };
    let mut harness = open(stock, writing(folder.path()), [1200.0, 800.0]);
    choose(&mut harness, What::Material);
    let before = harness.state().gallery.files.ended;
    harness.get_by_label("Write files").click();
    harness.run_steps(2);
    harness.get_by_label("Stop").click();
    harness.run_steps(2);
    is_open.store(true, Ordering::Relaxed);
    until(&mut harness, "the writing has ended", |bench| bench.gallery.files.ended > before);
    let notices = &harness.state().gallery.notices;
    assert!(notices.iter().any(|notice| notice.contains("it was stopped")), "{notices:?}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
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

#[test]
fn files_that_are_there_are_replaced_only_with_leave() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.csv");
    std::fs::write(&file, "mine").unwrap();
    let mut harness = built_in(writing(folder.path()));
    choose(&mut harness, What::Curve);
    assert!(harness.query_by_label("There already: out.csv").is_some());
    harness.get_by_label("Write files").click();
    harness.run_steps(3);
    assert!(harness.state().gallery.files.progress.is_none());
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    harness.get_by_label("Replace").click();
    harness.run_steps(2);
    let said = write(&mut harness);
    assert!(std::fs::read_to_string(&file).unwrap().starts_with("method,t,"), "{said}");
    // Leave was given once.
    looked(&mut harness);
    assert!(harness.query_by_label_contains("There already").is_some());
    harness.get_by_label("Write files").click();
    harness.run_steps(3);
    assert!(harness.state().gallery.files.progress.is_none());
}

#[test]
fn a_folder_that_cannot_be_written_to_is_a_notice() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = built_in(writing(&folder.path().join("nowhere")));
    choose(&mut harness, What::Curve);
    let said = write(&mut harness);
    assert!(said.contains("Nothing was written") && said.contains("nowhere"), "{said}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn a_copied_code_is_the_present_point_and_comes_back_when_pasted() {
    let mut harness = built_in(Session { methods: Methods(vec!["latent"]), ..quick() });
    settle(&mut harness);
    harness.event(with_command_and_shift(Key::C));
    let text = copied(&mut harness);
    let code = parse_code("clipboard", text.as_bytes()).unwrap();
    assert_eq!(code.code.len(), 32);
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let ends = ["gold-paint", "blue-acrylic"].map(|name| builtin::shared().get(name).unwrap().material());
    let point = catalog.interpolation("latent").unwrap().between(&ends).unwrap().at(&Weights::two(0.5)).unwrap();
    let decoded = material::decoded(&catalog, code, "clipboard").unwrap().material;
    let at = Directions::new(nbrdf_core::Vec3::new(0.6, 0.0, 0.8), nbrdf_core::Vec3::new(0.0, 0.6, 0.8));
    assert_eq!(decoded.brdf.eval(at), point.eval(at));
    let before = harness.state().gallery.names.len();
    harness.event(Event::Paste(text));
    harness.step();
    until(&mut harness, "the code is listed", |bench| bench.gallery.names.len() > before);
    let name = harness.state().gallery.names[before].clone();
    assert_eq!(name, "0.50 gold-paint + 0.50 blue-acrylic");
    harness.state_mut().session.blend.choose(0, &name);
    harness.run_steps(2);
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere A: shown").is_some());
    harness.event(Event::Paste("no code".to_owned()));
    harness.step();
    until(&mut harness, "what is no code is a notice", |bench| {
        bench.gallery.notices.iter().any(|notice| notice.contains("expected a code"))
    });
}

#[test]
fn a_method_that_fails_hides_no_code_of_another() {
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let interpolation = move |name: &str| {
        assert_ne!(name, "latent_even", "out of paint");
        catalog.interpolation(name)
    };
    let stock = Stock { interpolation: Box::new(interpolation), ..Stock::built_in() };
    let session = Session { methods: Methods(vec!["latent_even", "latent"]), ..quick() };
    let mut harness = open(stock, session, [1200.0, 800.0]);
    harness.run_steps(2);
    harness.event(with_command_and_shift(Key::C));
    let code = parse_code("clipboard", copied(&mut harness).as_bytes()).unwrap();
    assert_eq!(code.code.len(), 32);
}

#[test]
fn the_command_is_copied() {
    let mut harness = built_in(quick());
    harness.run_steps(2);
    harness.event(with_command_and_shift(Key::X));
    let text = copied(&mut harness);
    assert!(text.starts_with("nbrdf blend gold-paint blue-acrylic --at=0.5 --method=raw_weights"), "{text}");
}

/// A material that nobody can look at.
struct Torn;

impl Brdf for Torn {
    fn eval(&self, _: Directions) -> Rgb {
        panic!("torn to pieces")
    }
}

#[test]
fn a_panicking_material_is_a_notice_and_later_requests_work() {
    let mut stock = Stock::built_in();
    stock.materials.insert(0, Material::new("torn", Arc::new(Torn)));
    let mut session = quick();
    session.blend.choose(0, "torn");
    let mut harness = open(stock, session, [1200.0, 800.0]);
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere A: failed").is_some());
    // The thumbnail of the first material has failed, and all others are rendered.
    until(&mut harness, "there are thumbnails", |bench| bench.gallery.thumbnail("chrome").is_some());
    let said = |bench: &Workbench| bench.gallery.notices.iter().filter(|told| told.contains("torn to pieces")).count();
    assert!(said(harness.state()) >= 2, "{:?}", harness.state().gallery.notices);
    assert!(harness.state().gallery.thumbnail("torn").is_none());
    harness.state_mut().session.blend.choose(0, "chrome");
    harness.run_steps(2);
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere A: shown").is_some());
    assert!(harness.query_by_label("Sphere raw_weights: shown").is_some());
}

#[test]
fn a_session_survives_a_crash() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("session.json");
    let workbench = Workbench::new(Stock::built_in(), quick()).keeping(file.clone());
    let harness = Harness::builder().with_size([1200.0, 800.0]);
    let mut harness = harness.build_ui_state(|ui, workbench: &mut Workbench| workbench.ui(ui), workbench);
    harness.run_steps(2);
    harness.state_mut().session.blend.choose(1, "chrome");
    harness.state_mut().session.blend.go_to(0.3125);
    harness.state_mut().session.export.name = "mine".to_owned();
    let wanted = harness.state().session.clone();
    let kept = || matches!(store::read(&file), Found::Session(saved) if saved.session == wanted);
    until(&mut harness, "the session is kept", |_| kept());
    // Nobody says goodbye.
    drop(harness);
    assert!(kept());
}
