//! The desktop app, driven without a window.

#[path = "gui/alone.rs"]
mod alone;
#[path = "gui/blend.rs"]
mod blend;
#[path = "gui/clipboard.rs"]
mod clipboard;
#[path = "gui/crash.rs"]
mod crash;
#[path = "gui/export.rs"]
mod export;
#[path = "gui/figures.rs"]
mod figures;
#[path = "gui/scene.rs"]
mod scene;

use std::process::Command;
use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::{Harness, kittest::Queryable as _};
use nbrdf::gui::session::{Look, Methods};
use nbrdf::gui::{Session, Workbench};
use nbrdf::worker::{Asset, Card, Lighting, Scenery, Stock};
use nbrdf_core::Nbrdf;
use nbrdf_core::nbrdf::{PUBLISHED_WEIGHTS, npy};

#[path = "gui/compare.rs"]
mod compare;
#[path = "gui/keys.rs"]
mod keys;
#[path = "gui/library.rs"]
mod library;
#[path = "gui/map.rs"]
mod map;
#[path = "gui/pasted.rs"]
mod pasted;
#[path = "gui/room.rs"]
mod room;
#[path = "gui/scenery.rs"]
mod scenery;
#[path = "gui/sources.rs"]
mod sources;
#[path = "gui/strips.rs"]
mod strips;
#[path = "gui/worker.rs"]
mod worker;

fn quick() -> Session {
    Session { methods: Methods(vec!["raw_weights"]), strips: false, ..Session::default() }
}

fn under(lighting: Lighting) -> Look {
    Look { scenery: Scenery::of(lighting), ..Look::default() }
}

fn open(stock: Stock, session: Session, size: [f32; 2]) -> Harness<'static, Workbench> {
    let workbench = Workbench::new(stock, session);
    Harness::builder().with_size(size).build_ui_state(|ui, workbench: &mut Workbench| workbench.ui(ui), workbench)
}

fn built_in(session: Session) -> Harness<'static, Workbench> {
    open(Stock::built_in(), session, [1200.0, 800.0])
}

fn until(harness: &mut Harness<'_, Workbench>, what: &str, is_so: impl Fn(&Workbench) -> bool) {
    let patience = Instant::now() + Duration::from_secs(120);
    while !is_so(harness.state()) {
        assert!(Instant::now() < patience, "still waiting until {what}");
        std::thread::sleep(Duration::from_millis(10));
        harness.step();
    }
    harness.step();
}

fn settle(harness: &mut Harness<'_, Workbench>) {
    harness.step();
    until(harness, "everything is shown", Workbench::is_settled);
}

#[test]
fn search_narrows_the_list() {
    let mut harness = built_in(quick());
    assert!(harness.query_by_label("alum-bronze").is_some());
    harness.get_by_role(Role::TextInput).focus();
    harness.step();
    harness.get_by_role(Role::TextInput).type_text("fabric blu");
    harness.run_steps(3);
    assert!(harness.query_by_label("alum-bronze").is_none());
    assert!(harness.query_by_role_and_label(Role::ListItem, "blue-fabric").is_some());
}

#[test]
fn choosing_ends_changes_the_cards() {
    let mut harness = built_in(quick());
    settle(&mut harness);
    let before = harness.state().gallery.view(Card::End(1)).and_then(|view| view.figures);
    harness.state_mut().session.listing.search = "chrome".to_owned();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::ListItem, "chrome-steel").click();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::ListItem, "chrome").click_modifiers(Modifiers::SHIFT);
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.ends, ["chrome-steel", "chrome"]);
    settle(&mut harness);
    assert_ne!(harness.state().gallery.view(Card::End(1)).and_then(|view| view.figures), before);
    harness.get_by_label("chrome as A").click();
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.ends, ["chrome", "chrome"]);
}

#[test]
fn arrow_keys_scrub_and_a_new_picture_arrives() {
    let mut harness = built_in(quick());
    settle(&mut harness);
    let figures = |bench: &Workbench| bench.gallery.view(Card::Method("raw_weights")).and_then(|view| view.figures);
    let before = figures(harness.state());
    assert!(before.is_some());
    harness.get_by_label("t, from A to B").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowRight);
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.t, 9.0 / 16.0);
    settle(&mut harness);
    assert_ne!(figures(harness.state()), before);
    assert!(harness.query_by_label("Sphere raw_weights: shown").is_some());
}

#[test]
fn film_strips_show_whole_paths_and_go_there() {
    let mut harness = built_in(Session { strips: true, ..quick() });
    settle(&mut harness);
    assert!((0..9).all(|step| harness.state().gallery.frame(Card::Method("raw_weights"), step).is_some()));
    harness.get_by_label("Raw weights at 0.250").click();
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.t, 0.25);
}

#[test]
fn light_from_all_around_settles_and_lamps_come_back() {
    let around = Lighting::Around { map: Asset::BuiltIn, turn: 0.3 };
    let mut harness = open(Stock::built_in(), Session { look: under(around), ..quick() }, [640.0, 480.0]);
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere raw_weights: shown").is_some());
    let figures = |bench: &Workbench| bench.gallery.view(Card::End(0)).and_then(|view| view.figures);
    assert!(figures(harness.state()).is_none(), "grainy pictures are not judged");
    harness.state_mut().session.look = Look::default();
    harness.run_steps(2);
    settle(&mut harness);
    assert!(figures(harness.state()).is_some());
}

#[test]
fn a_map_that_is_opened_is_shown_and_one_that_is_none_is_a_notice() {
    let folder = tempfile::tempdir().unwrap();
    let map = folder.path().join("room.exr");
    let grey = nbrdf_core::Image::new(8, 4, vec![nbrdf_core::Rgb::splat(0.5); 32]);
    grey.write_exr(&map).unwrap();
    let mut harness = built_in(quick());
    harness.state().open(map.clone());
    until(&mut harness, "the map is listed", |bench| bench.gallery.maps.len() == 2);
    assert_eq!(
        harness.state().session.look.scenery.lighting,
        Lighting::Around { map: Asset::of_file(&map), turn: 0.0 }
    );
    let square = folder.path().join("square.exr");
    nbrdf_core::Image::black(4, 4).write_exr(&square).unwrap();
    harness.state().open(square);
    until(&mut harness, "there is a notice", |bench| !bench.gallery.notices.is_empty());
    assert!(harness.state().gallery.notices[0].contains("square.exr"), "{:?}", harness.state().gallery.notices);
}

#[test]
fn a_material_that_is_opened_and_makes_light_of_nothing_is_a_notice() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lamp.npz");
    // Whatever it is asked, f = e - 1: an albedo of 5.4.
    let mut weights = vec![0.0; PUBLISHED_WEIGHTS];
    weights[PUBLISHED_WEIGHTS - 3..].fill(1.0);
    std::fs::write(&path, npy::write_npz(&Nbrdf::published(weights).unwrap())).unwrap();
    let mut harness = built_in(quick());
    harness.state().open(path);
    until(&mut harness, "a notice", |bench| !bench.gallery.notices.is_empty());
    let notices = &harness.state().gallery.notices;
    assert!(notices[0].contains("lamp") && notices[0].contains("more light leaves than arrives"), "{notices:?}");
}

#[test]
fn an_unknown_material_is_a_notice() {
    let mut session = quick();
    session.blend.choose(0, "crome");
    let mut harness = built_in(session);
    until(&mut harness, "there is a notice", |bench| !bench.gallery.notices.is_empty());
    assert!(harness.query_by_label("Sphere A: failed").is_some());
    harness.get_by_label("Dismiss").click();
    harness.run_steps(2);
    assert!(harness.state().gallery.notices.is_empty());
}

#[test]
fn a_panicking_method_is_a_notice_and_the_other_spheres_stay() {
    let stock = Stock { interpolation: Box::new(|_| panic!("out of paint")), ..Stock::built_in() };
    let mut harness = open(stock, quick(), [1200.0, 800.0]);
    settle(&mut harness);
    assert!(harness.state().gallery.notices.iter().any(|notice| notice.contains("out of paint")));
    assert!(harness.query_by_label("Sphere raw_weights: failed").is_some());
    assert!(harness.query_by_label("Sphere A: shown").is_some());
}

#[test]
fn in_a_small_window_no_spheres_overlap() {
    let methods = vec!["latent", "raw_weights", "linear_mix", "log_mix", "nearest_end"];
    let mut harness = open(Stock::built_in(), Session { methods: Methods(methods), ..quick() }, [640.0, 480.0]);
    harness.run_steps(3);
    let spheres: Vec<_> = harness.query_all_by_role(Role::Image).map(|node| node.rect()).collect();
    assert!(spheres.len() >= 2, "{spheres:?}");
    for (place, sphere) in spheres.iter().enumerate() {
        assert!(sphere.width() >= 90.0);
        assert!(spheres[place + 1..].iter().all(|other| !other.shrink(0.5).intersects(*sphere)), "{spheres:?}");
    }
}

#[test]
#[cfg(all(unix, not(target_os = "macos")))]
fn without_a_display_it_names_the_command_to_try() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_nbrdf"));
    let output = command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("no display") && said.contains("nbrdf blend gold-paint blue-acrylic"), "{said}");
}

/// Sources of the window, folders and all.
fn sources(folder: &std::path::Path) -> Vec<std::path::PathBuf> {
    let found = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    found.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

#[test]
fn every_character_that_the_window_shows_has_a_glyph() {
    let files = sources(&std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/gui"));
    let mut shown = std::collections::BTreeSet::new();
    for file in &files {
        let text = std::fs::read_to_string(file).unwrap();
        let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
        shown.extend(code.flat_map(str::chars).filter(|character| !character.is_ascii()));
    }
    assert!(files.len() > 50 && shown.contains(&'θ'), "{} files, {shown:?}", files.len());
    let mut missing = Vec::new();
    Harness::new_ui(|ui| {
        let font = egui::FontId::proportional(13.0);
        missing = ui.fonts_mut(|fonts| shown.iter().copied().filter(|&c| !fonts.has_glyph(&font, c)).collect());
    });
    assert!(missing.is_empty(), "shown as boxes: {missing:?}");
}
