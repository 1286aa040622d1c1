//! Files of networks and archives of them, sound and hostile.

use std::io::{Cursor, Write};

use nbrdf_core::data::published_or_skip;
use nbrdf_core::library::builtin;
use nbrdf_core::nbrdf::{ARRAYS, npy};
use zip::{ZipWriter, write::SimpleFileOptions};

use super::support::Place;
use super::{chrome_npz, two_materials};

fn npy_of(npz: &[u8]) -> [Vec<u8>; 6] {
    npy::write_npy(&npy::read_npz(npz).unwrap())
}

fn zip_of(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        zip.start_file(*name, SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

#[test]
fn files_that_are_no_networks_exit_with_3_and_are_named() {
    let place = Place::new();
    let whole = chrome_npz();
    let wrong_shape = npy::write_npz(&nbrdf_core::Nbrdf::new([2, 2], vec![0.0; 29]).unwrap());
    let nan = {
        let mut arrays = npy::write_npy(&builtin::shared().get("chrome").unwrap().network);
        let end = arrays[0].len();
        arrays[0][end - 4..].copy_from_slice(&f32::NAN.to_le_bytes());
        arrays
    };
    for (array, bytes) in ARRAYS.iter().zip(&nan) {
        place.write(&format!("nan_{array}.npy"), bytes);
    }
    // One array of another shape than its neighbours.
    for (array, (own, other)) in ARRAYS.iter().zip(nan.iter().zip(npy_of(&wrong_shape))) {
        place.write(&format!("odd_{array}.npy"), if *array == "fc2" { &other } else { own });
    }
    place.write("cut.npz", &whole[..whole.len() / 2]);
    place.write("junk.h5", b"junk");
    place.write("notes.txt", b"hello");
    for name in ["cut.npz", "junk.h5", "./notes.txt", "missing.npz", "nan_fc1.npy", "odd_fc1.npy"] {
        let said = place.run(&["info", name]).fails(3);
        assert!(said.contains(name.trim_start_matches("./")), "{said}");
    }
}

#[test]
fn hostile_archives_exit_with_3_and_write_nothing() {
    let place = Place::new();
    let network = chrome_npz();
    let whole = zip_of(&[("chrome.npz", &network)]);
    place.write("cut.zip", &whole[..whole.len() - 30]);
    place.write("traversal.zip", &zip_of(&[("../../chrome.npz", &network)]));
    place.write("bomb.zip", &zip_of(&[("chrome.h5", &vec![0; 32 << 20])]));
    place.write("empty.zip", &zip_of(&[("readme.txt", b"hello")]));
    let before = place.names();
    for name in ["cut.zip", "traversal.zip", "bomb.zip", "empty.zip"] {
        let said = place.run(&["import", name, "-o", "library"]).fails(3);
        assert!(said.contains(name), "{said}");
    }
    assert_eq!(place.names(), before);
    place.write("mixed.zip", &zip_of(&[("chrome.npz", &network), ("bad.h5", b"junk")]));
    place.run(&["import", "mixed.zip", "-o", "library"]).fails(3);
    let report = place.run(&["import", "mixed.zip", "-o", "library", "--skip-bad", "--json"]).json();
    assert_eq!(report["materials"].as_array().unwrap().len(), 1);
}

#[test]
fn the_published_archive_imports_as_100_materials() {
    let Some(archive) = published_or_skip("merl_nbrdf.zip") else { return };
    let place = Place::new();
    let report = place.run(&["import", archive.to_str().unwrap(), "-o", "merl", "--json"]).json();
    assert_eq!(report["materials"].as_array().unwrap().len(), 100);
    let listed = place.run(&["list", "--library", "merl", "--json"]).json();
    assert_eq!(listed["materials"].as_array().unwrap().len(), 100);
}

#[test]
fn a_shared_start_import_gives_the_same_bytes_for_the_same_seed() {
    let place = Place::new();
    two_materials(&place);
    let import = |output: &str, seed: &str| {
        place.run(&["import", "two", "-o", output, "--shared-start", "--steps", "20", "--seed", seed]).ok();
        place.file(&format!("{output}/library.safetensors"))
    };
    let first = import("a", "1");
    assert_eq!(import("b", "1"), first);
    assert_ne!(import("c", "2"), first);
}
