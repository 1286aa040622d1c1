//! Files that come again, are missing, or come back.

use std::path::Path;

use nbrdf::worker::Shape;
use nbrdf_core::{Image, Rgb};

use super::library::{drop_file, has, library, stock};
use super::*;

fn map(path: &Path, value: f32) {
    Image::new(8, 4, vec![Rgb::splat(value); 32]).write_exr(path).unwrap();
}

/// The network of a built-in material in a file.
fn network(path: &Path, place: usize) {
    std::fs::write(path, npy::write_npz(stock().materials[place].network.as_ref().unwrap())).unwrap();
}

fn started(session: Session) -> Harness<'static, Workbench> {
    let mut harness = library(stock(), session);
    until(&mut harness, "the files are read", |bench| bench.gallery.is_reopened);
    until(&mut harness, "there is a picture", |bench| {
        bench.gallery.view(Card::End(0)).is_some_and(|view| view.texture.is_some())
    });
    harness
}

#[test]
fn a_map_and_a_mesh_that_are_missing_for_a_while_move_no_other_and_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let [room, street, pot] = ["room.exr", "street.exr", "pot.obj"].map(|name| folder.path().join(name));
    map(&room, 0.5);
    map(&street, 1.0);
    std::fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/../fuzz/seeds/obj/cube"), &pot).unwrap();
    let mut harness = library(stock(), quick());
    for path in [&pot, &room, &street] {
        drop_file(&mut harness, path);
        until(&mut harness, "it is open", |bench| bench.session.files.contains(path));
    }
    let session = harness.state().session.clone();
    let (light, shape) = (session.look.scenery.lighting, session.look.scenery.shape);
    assert_eq!(light, Lighting::Around { map: Asset::of_file(&street), turn: 0.0 });
    assert_eq!(shape, Shape::Mesh(Asset::of_file(&pot)));
    drop(harness);
    for missing in [vec![&room], vec![&street, &pot], vec![]] {
        let aside = |path: &Path| path.with_extension("aside");
        missing.iter().for_each(|path| std::fs::rename(path, aside(path)).unwrap());
        let harness = started(session.clone());
        let bench = harness.state();
        assert_eq!(bench.session, session, "nothing is lost without {missing:?}");
        let said = |path: &Path| bench.gallery.notices.iter().any(|said| said.contains(path.to_str().unwrap()));
        for path in [&room, &street, &pot] {
            let is_missing = missing.contains(&path);
            assert_eq!(said(path), is_missing, "{path:?}: {:?}", bench.gallery.notices);
            let asset = Asset::of_file(path);
            let listed = bench.gallery.maps.iter().chain(&bench.gallery.meshes).any(|listed| listed.asset == asset);
            assert_eq!(listed, !is_missing, "{path:?}");
        }
        missing.iter().for_each(|path| std::fs::rename(aside(path), path).unwrap());
    }
}

#[test]
fn a_file_that_is_dropped_again_replaces_its_material_wherever_that_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ours.npz");
    network(&path, 0);
    let mut harness = library(stock(), quick());
    drop_file(&mut harness, &path);
    until(&mut harness, "it is read", |bench| has(bench, "ours"));
    let count = harness.state().gallery.names.len();
    harness.state_mut().session.blend.choose(0, "ours");
    harness.run_steps(2);
    settle(&mut harness);
    let figures = |bench: &Workbench| bench.gallery.view(Card::Method("raw_weights")).and_then(|view| view.figures);
    let before = figures(harness.state());
    network(&path, 40);
    drop_file(&mut harness, &path);
    until(&mut harness, "the path is another", |bench| figures(bench) != before && figures(bench).is_some());
    let bench = harness.state();
    assert_eq!((bench.gallery.names.len(), bench.session.files.len()), (count, 1));
    assert!(bench.gallery.notices.is_empty(), "{:?}", bench.gallery.notices);
}

#[test]
fn materials_keep_their_names_when_a_file_before_theirs_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["a", "b"].map(|name| folder.path().join(name).join("ours.npz"));
    let mut harness = library(stock(), quick());
    for (place, (path, name)) in paths.iter().zip(["ours", "ours (ours)"]).enumerate() {
        std::fs::create_dir(path.parent().unwrap()).unwrap();
        network(path, place);
        drop_file(&mut harness, path);
        until(&mut harness, "it is read", |bench| has(bench, name) && bench.session.files.contains(path));
    }
    let session = harness.state().session.clone();
    drop(harness);
    std::fs::remove_file(&paths[0]).unwrap();
    let harness = started(session);
    let bench = harness.state();
    assert!(has(bench, "ours (ours)") && !has(bench, "ours"), "the name is kept for its file");
    assert_eq!(bench.session.origins["ours"], paths[0]);
}
