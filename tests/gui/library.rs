//! The library: filters, order, favourites, dragging, and files of every kind.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui_kittest::kittest::NodeT as _;
use nbrdf::gui::session::Sort;
use nbrdf::gui::store::{self, Found};
use nbrdf::worker::Cache;
use nbrdf_core::class::Class;
use nbrdf_core::quality::Qualities;

use super::*;

/// The built-in stock with short fits, and no window of the system.
pub(super) fn stock() -> Stock {
    Stock { fit_steps: 128, dialog: Box::new(|| Ok(Vec::new())), ..Stock::built_in() }
}

pub(super) fn library(stock: Stock, session: Session) -> Harness<'static, Workbench> {
    open(stock, session, [1200.0, 800.0])
}

fn is_listed(harness: &Harness<'_, Workbench>, name: &str) -> bool {
    harness.query_by_role_and_label(Role::ListItem, name).is_some()
}

fn search(harness: &mut Harness<'_, Workbench>, words: &str) {
    harness.state_mut().session.listing.search = words.to_owned();
    harness.run_steps(3);
}

/// Samples of a grey matte material, as a goniometer would take them.
pub(super) fn samples(folder: &Path) -> PathBuf {
    let mut text = "light_x,light_y,light_z,view_x,view_y,view_z,r,g,b\n".to_owned();
    for k in 0..64u8 {
        let (light, view, turn) = (1.2 * f32::from(k % 8) / 8.0, 1.2 * f32::from(k / 8) / 8.0, 0.7 * f32::from(k));
        let (x, y) = (view.sin() * turn.cos(), view.sin() * turn.sin());
        writeln!(text, "{},0,{},{x},{y},{},0.1,0.1,0.1", light.sin(), light.cos(), view.cos()).unwrap();
    }
    let path = folder.join("felt.csv");
    std::fs::write(&path, text).unwrap();
    path
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

pub(super) fn drop_file(harness: &mut Harness<'_, Workbench>, path: &Path) {
    harness.input_mut().dropped_files.push(Arc::new(Dropped(path.to_owned())));
    harness.step();
}

pub(super) fn has(bench: &Workbench, name: &str) -> bool {
    bench.gallery.names.iter().any(|known| known == name)
}

#[test]
fn a_kind_is_filtered_by_the_menu_and_the_grid_shows_the_same() {
    let mut harness = library(stock(), quick());
    search(&mut harness, "black");
    assert!(is_listed(&harness, "black-obsidian") && is_listed(&harness, "black-fabric"));
    harness.get_by_label("Filter").click();
    harness.run_steps(3);
    harness.get_by_label("Fabric").click();
    harness.run_steps(3);
    assert_eq!(harness.state().session.listing.class, Some(Class::Fabric));
    assert!(!is_listed(&harness, "black-obsidian") && is_listed(&harness, "black-fabric"));
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    harness.state_mut().session.listing.is_grid = true;
    harness.run_steps(3);
    assert!(!is_listed(&harness, "black-obsidian") && is_listed(&harness, "black-fabric"));
    harness.get_by_role_and_label(Role::ListItem, "black-fabric").click();
    harness.run_steps(3);
    assert_eq!(harness.state().session.blend.ends[0], "black-fabric");
}

#[test]
fn the_order_by_lightness_is_that_of_the_measured_qualities() {
    let stock = stock();
    let lightness = |material: &nbrdf_core::Material| Qualities::of(material.brdf.as_ref()).lightness;
    let mut expected: Vec<_> = stock.materials.iter().map(|m| (lightness(m), m.name.clone())).collect();
    expected.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut session = quick();
    session.listing.sort = Sort::Lightness;
    session.listing.is_descending = true;
    let mut harness = library(stock, session);
    until(&mut harness, "all are measured", |bench| {
        bench.gallery.names.iter().all(|name| bench.gallery.qualities(name).is_some())
    });
    harness.run_steps(2);
    let top = |name: &str| harness.get_by_role_and_label(Role::ListItem, name).rect().top();
    let tops: Vec<f32> = expected[..6].iter().map(|(_, name)| top(name)).collect();
    assert!(tops.windows(2).all(|pair| pair[0] < pair[1]), "{tops:?} of {:?}", &expected[..6]);
    let first = harness.query_all_by_role(Role::ListItem).map(|node| node.rect().top()).fold(f32::INFINITY, f32::min);
    assert_eq!(tops[0], first);
}

#[test]
fn favourites_come_back_with_undo_and_with_the_session() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("session.json");
    let workbench = Workbench::new(stock(), quick()).keeping(file.clone());
    let mut harness = Harness::builder()
        .with_size([1200.0, 800.0])
        .build_ui_state(|ui, workbench: &mut Workbench| workbench.ui(ui), workbench);
    harness.run_steps(3);
    search(&mut harness, "chrome");
    let favourites = |harness: &Harness<'_, Workbench>| harness.state().session.listing.favourites.clone();
    harness.get_by_label("chrome as favourite").click();
    harness.run_steps(3);
    assert!(favourites(&harness).contains("chrome"));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert!(favourites(&harness).is_empty());
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Y);
    harness.run_steps(3);
    harness.state_mut().session.listing.is_favourites = true;
    harness.run_steps(3);
    assert!(is_listed(&harness, "chrome") && !is_listed(&harness, "chrome-steel"));
    harness.state_mut().finish(None);
    let Found::Session(saved) = store::read(&file) else { panic!("no session") };
    assert!(saved.session.listing.favourites.contains("chrome") && saved.session.listing.is_favourites);
}

#[test]
fn a_material_that_is_dragged_onto_a_card_takes_its_place() {
    let mut harness = library(stock(), quick());
    settle(&mut harness);
    search(&mut harness, "chrome-steel");
    let from =
        harness.get_by_role_and_label(Role::ListItem, "chrome-steel").rect().left_center() + egui::vec2(70.0, 0.0);
    let to = harness.get_by_label("Sphere A: shown").rect().center();
    let before = harness.state().session.look.clone();
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    for share in [0.1, 0.5, 1.0] {
        harness.hover_at(from + share * (to - from));
        harness.step();
    }
    harness.drop_at(to);
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.ends[0], "chrome-steel");
    assert_eq!(harness.state().session.look, before, "the light is dragged by spheres alone");
}

#[test]
fn samples_that_are_dropped_are_fitted_and_the_next_start_has_the_network() {
    let folder = tempfile::tempdir().unwrap();
    let path = samples(folder.path());
    let cache = || Cache(Some(folder.path().join("cache")));
    let mut harness = library(Stock { cache: cache(), ..stock() }, quick());
    drop_file(&mut harness, &path);
    until(&mut harness, "it is fitted", |bench| has(bench, "felt"));
    until(&mut harness, "it is told", |bench| bench.gallery.notices.iter().any(|said| said.contains("felt.csv")));
    assert_eq!(harness.state().session.files, [path.as_path()]);
    assert!(harness.state().gallery.jobs.is_empty());
    let mut session = harness.state().session.clone();
    session.blend.choose(0, "felt");
    drop(harness);
    let mut again = library(Stock { cache: cache(), fit_steps: 128, ..stock() }, session);
    settle(&mut again);
    assert!(has(again.state(), "felt") && again.state().gallery.jobs.is_empty());
    assert!(again.query_by_label("Sphere A: shown").is_some());
    let notices = &again.state().gallery.notices;
    assert!(!notices.iter().any(|said| said.contains("no material") || said.contains("felt.csv")), "{notices:?}");
}

#[test]
fn a_cancelled_fit_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = samples(folder.path());
    let mut harness = library(Stock { fit_steps: 1 << 40, ..stock() }, quick());
    drop_file(&mut harness, &path);
    until(&mut harness, "it is under way", |bench| bench.gallery.jobs.first().is_some_and(|job| job.left.is_some()));
    harness.get_by_label("Cancel").click();
    until(&mut harness, "it has ended", |bench| bench.gallery.jobs.is_empty());
    harness.run_steps(2);
    let bench = harness.state();
    assert!(!has(bench, "felt") && bench.session.files.is_empty() && bench.gallery.notices.is_empty());
}

#[test]
fn what_cannot_be_read_is_a_notice_that_names_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let bad = [("light.csv", "a,b,c\n1,2,3\n"), ("code.json", "{}"), ("chrome.npz", "no network")];
    let mut harness = library(stock(), quick());
    for (name, text) in bad {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        drop_file(&mut harness, &path);
    }
    drop_file(&mut harness, &folder.path().join("nowhere.npz"));
    until(&mut harness, "all are told", |bench| bench.gallery.notices.len() == 4);
    for name in ["light.csv", "code.json", "chrome.npz", "nowhere.npz"] {
        let notices = &harness.state().gallery.notices;
        assert!(notices.iter().any(|said| said.contains(name)), "{name}: {notices:?}");
    }
    assert!(harness.state().session.files.is_empty());
}

#[test]
fn a_code_is_decoded_and_named_after_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("shiny.json");
    let stock = stock();
    let chrome = stock.materials.iter().find(|material| material.name == "chrome").unwrap();
    let mut code = stock.catalog.representation("znbrdf", false).unwrap().encode(chrome).unwrap();
    code.material = None;
    std::fs::write(&path, serde_json::to_string(&code).unwrap()).unwrap();
    let mut harness = library(stock, quick());
    drop_file(&mut harness, &path);
    until(&mut harness, "it is decoded", |bench| has(bench, "shiny"));
}

#[test]
fn a_path_is_typed_where_the_dialog_hangs_and_a_dialog_that_fails_says_why() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ours.npz");
    let network = stock().materials[0].network.clone().unwrap();
    std::fs::write(&path, npy::write_npz(&network)).unwrap();
    let hangs = Stock {
        dialog: Box::new(|| {
            loop {
                std::thread::park()
            }
        }),
        ..stock()
    };
    let mut harness = library(hangs, quick());
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::O);
    harness.run_steps(3);
    harness.get_by_role(Role::MultilineTextInput).type_text(path.to_str().unwrap());
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    until(&mut harness, "it is read", |bench| has(bench, "ours"));
    let fails = Stock { dialog: Box::new(|| Err("No portal".to_owned())), ..stock() };
    let mut harness = library(fails, quick());
    harness.run_steps(2);
    harness.get_by_label("Open…").click();
    until(&mut harness, "it fails", |bench| bench.gallery.dialog.as_deref() == Some("No portal"));
    let field = harness.get_by_role(Role::MultilineTextInput);
    assert!(field.accesskit_node().placeholder().is_some_and(|hint| hint.contains("No portal")));
}

#[test]
fn the_second_start_reads_thumbnails_and_makes_only_a_damaged_one_anew() {
    let folder = tempfile::tempdir().unwrap();
    let start = || {
        let mut stock = Stock { cache: Cache(Some(folder.path().to_owned())), ..stock() };
        stock.materials.retain(|material| ["gold-paint", "blue-acrylic", "chrome"].contains(&material.name.as_str()));
        let mut harness = library(stock, quick());
        until(&mut harness, "the pictures are there", |bench| bench.gallery.is_complete());
    };
    let files = || {
        let files = std::fs::read_dir(folder.path()).unwrap().map(|file| file.unwrap().path());
        let mut files: Vec<PathBuf> = files.filter(|path| path.extension().unwrap() == "thumbnail").collect();
        files.sort();
        files
    };
    start();
    let made = files();
    assert_eq!(made.len(), 3);
    let times = || made.iter().map(|path| path.metadata().unwrap().modified().unwrap()).collect::<Vec<_>>();
    let whole = std::fs::read(&made[0]).unwrap();
    std::fs::write(&made[0], &whole[..whole.len() - 1]).unwrap();
    let before = times();
    start();
    assert_eq!(files(), made);
    assert_eq!(std::fs::read(&made[0]).unwrap(), whole, "the damaged one is as it was");
    assert_eq!(times()[1..], before[1..], "the others were not written again");
}
