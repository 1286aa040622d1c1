use std::{
    fs,
    io::{Cursor, Write},
    path::{Path, PathBuf},
};

use ::zip::{ZipWriter, write::SimpleFileOptions};
use proptest::prelude::*;
use tempfile::TempDir;

use super::*;
use crate::hash::sha256;
use crate::{
    data::published_or_skip,
    database::{MERL, RGL},
    nbrdf::{
        file::{self, ReadProblem},
        npy, safetensors,
    },
};

fn network(value: f32) -> Nbrdf {
    Nbrdf::published((0..675).map(|i| value + (i as f32 * 0.1).cos()).collect()).unwrap()
}

fn sample() -> Library {
    let mut chrome = Entry::new("chrome", "merl_nbrdf.zip: chrome.h5", network(0.0));
    chrome.error = BTreeMap::from([("log_error".to_owned(), 0.0125), ("studio_psnr".to_owned(), 48.5)]);
    let narrow = Nbrdf::new([4, 5], vec![0.25; crate::nbrdf::weight_count([4, 5])]).unwrap();
    let entries =
        vec![chrome, Entry::new("my-paint", "my.npz", narrow), Entry::new("rgl/paper_white", "p.h5", network(2.0))];
    let source = Source { file: "a.zip".into(), sha256: sha256(b"a"), source: "them".into(), terms: "MIT".into() };
    let provenance =
        Provenance { title: "Sample".into(), command: "nbrdf import".into(), seed: 7, derived_from: vec![source] };
    Library::new(provenance, Some(network(9.0)), entries).unwrap()
}

fn zip_of(files: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in files {
        zip.start_file(*name, SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    zip.finish().unwrap().into_inner()
}

fn written(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn all_published_archives_load_under_their_standard_names() {
    let (Some(merl), Some(rgl)) = (published_or_skip("merl_nbrdf.zip"), published_or_skip("rgl_nbrdf_subset.zip"))
    else {
        return;
    };
    for (archive, standard, held_out) in [(merl, &MERL[..], 20), (rgl, &RGL[..], 9)] {
        let library = Library::load(&archive).unwrap();
        assert!(library.iter().map(|entry| entry.name.as_str()).eq(standard.iter().copied()));
        assert_eq!(library.iter().filter(|entry| entry.held_out).count(), held_out);
        let folder = tempfile::tempdir().unwrap();
        library.save(folder.path()).unwrap();
        assert_eq!(Library::load(folder.path()).unwrap(), library, "our own form keeps every bit");
    }
}

#[test]
fn a_saved_library_is_the_same_library() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new/library");
    sample().save(&path).unwrap();
    assert_eq!(names(&path), ["library.safetensors", "manifest.json"]);
    for named in [path.clone(), path.join("manifest.json"), path.join("library.safetensors")] {
        assert_eq!(Library::load(&named).unwrap(), sample());
    }
    let first = fs::read(path.join("library.safetensors")).unwrap();
    sample().save(&path).unwrap();
    assert_eq!(fs::read(path.join("library.safetensors")).unwrap(), first, "same library, same bytes");
    let scanned = scan(&path).unwrap();
    assert!(scanned.iter().all(|scanned| scanned.entry.is_ok()) && scanned.len() == 3);
}

#[test]
fn a_save_that_fails_leaves_the_old_library() {
    let folder = tempfile::tempdir().unwrap();
    sample().save(folder.path()).unwrap();
    let mut bad = sample();
    bad.entries[0].error.insert("rmse".into(), f64::NAN);
    let error = bad.save(folder.path()).unwrap_err();
    assert_eq!(error.to_string(), "error `rmse` of material `chrome` is NaN, expected a finite number");
    assert_eq!(Library::load(folder.path()).unwrap(), sample());
    assert_eq!(names(folder.path()), ["library.safetensors", "manifest.json"]);
}

#[test]
fn a_rename_that_fails_takes_back_the_one_before_it() {
    for old in [Some(b"old tensors"), None] {
        let folder = tempfile::tempdir().unwrap();
        // A folder in the manifest's place lets the second rename fail.
        fs::create_dir(folder.path().join("manifest.json")).unwrap();
        let tensors = folder.path().join("library.safetensors");
        if let Some(old) = old {
            fs::write(&tensors, old).unwrap();
        }
        assert!(matches!(sample().save(folder.path()), Err(LibraryError::Io { .. })));
        assert_eq!(fs::read(&tensors).ok().as_deref(), old.map(|old| &old[..]));
        assert_eq!(names(folder.path()).len(), 1 + usize::from(old.is_some()), "nothing else is left");
    }
}

#[test]
fn files_of_two_different_saves_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    sample().save(folder.path()).unwrap();
    let other = safetensors::write_many([("chrome", network(1.0).weights())], [21, 21]);
    fs::write(folder.path().join("library.safetensors"), &other).unwrap();
    let error = Library::load(folder.path()).unwrap_err();
    assert!(matches!(error, LibraryError::Mismatch(_)), "{error}");
    fs::remove_file(folder.path().join("library.safetensors")).unwrap();
    assert!(Library::load(folder.path()).unwrap_err().to_string().contains("library.safetensors"));
}

#[test]
fn a_save_stopped_between_its_two_renames_is_read_as_finished() {
    let [old, new] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    sample().save(old.path()).unwrap();
    let after = Library::new(Provenance::default(), None, vec![Entry::new("chrome", "c.h5", network(1.0))]).unwrap();
    after.save(new.path()).unwrap();
    // Staged, and stopped before the first rename: the old library.
    fs::copy(new.path().join("manifest.json"), old.path().join(".manifest.json.new")).unwrap();
    assert_eq!(Library::load(old.path()).unwrap(), sample());
    // Stopped after it: the new one.
    fs::copy(new.path().join("library.safetensors"), old.path().join("library.safetensors")).unwrap();
    assert_eq!(Library::load(old.path()).unwrap(), after);
    // The next save leaves nothing of that.
    sample().save(old.path()).unwrap();
    assert_eq!(Library::load(old.path()).unwrap(), sample());
    assert_eq!(names(old.path()), ["library.safetensors", "manifest.json"]);
}

#[test]
fn a_folder_with_files_of_something_else_is_not_for_a_library() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    let told = || Library::check_folder(folder.path()).map_err(|error| error.to_string());
    assert_eq!(told(), Ok(()));
    fs::write(file("notes.txt"), "stays").unwrap();
    fs::write(file("manifest.json"), r#"{"name": "a web page"}"#).unwrap();
    assert!(told().unwrap_err().contains("found manifest.json alone: name another folder"), "{told:?}", told = told());
    fs::write(file("library.safetensors"), "weights of another program").unwrap();
    assert!(told().unwrap_err().contains("schema none"), "{told:?}", told = told());
    sample().save(folder.path()).unwrap();
    assert_eq!(told(), Ok(()));
    fs::rename(file("manifest.json"), file(".manifest.json.new")).unwrap();
    assert_eq!(told(), Ok(()), "a save that was stopped is a library");
    assert_eq!(Library::check_folder(&file("new")).map_err(|error| error.to_string()), Ok(()));
}

#[test]
fn a_manifest_and_tensors_that_disagree_are_refused() {
    let row = r#"{"name": "chrome", "database": "merl", "held_out": true, "source_file": "f"}"#;
    let manifest = |schema: u32, rows: &str| {
        format!(
            r#"{{"schema": {schema}, "title": "", "command": "", "seed": 0, "derived_from": [],
                "shared_start": false, "materials": [{rows}]}}"#
        )
    };
    let one = safetensors::write_many([("chrome", network(1.0).weights())], [21, 21]);
    let load = |tensors: &[u8], manifest: &str| Library::from_bytes(tensors, manifest.as_bytes());
    assert_eq!(load(&one, &manifest(1, row)).unwrap().len(), 1);
    let none = safetensors::write_many([], [21, 21]);
    assert!(matches!(load(&none, &manifest(1, row)), Err(LibraryError::Mismatch(_))));
    assert!(matches!(load(&one, &manifest(1, "")), Err(LibraryError::Mismatch(_))));
    assert!(matches!(load(&one, &manifest(1, &format!("{row}, {row}"))), Err(LibraryError::Entry(_))));
    assert!(matches!(load(&one, &manifest(2, row)), Err(LibraryError::Manifest(_))));
    assert!(matches!(load(&one, "{"), Err(LibraryError::Manifest(_))));
    assert!(matches!(load(b"junk", &manifest(1, row)), Err(LibraryError::Tensors(_))));
    assert!(matches!(load(&one, &"[".repeat(100_000)), Err(LibraryError::Manifest(_))));
}

#[test]
fn a_name_not_there_brings_the_nearest() {
    let library = sample();
    assert_eq!(library.get("chrome").unwrap().name, "chrome");
    let error = library.get("chrme").unwrap_err();
    assert_eq!(error.to_string(), "no material `chrme` in the library of 3: did you mean `chrome`?");
    assert_eq!(library.get("paper-white").unwrap_err().suggestions, ["rgl/paper_white"]);
    let error = library.get("zzzzzzzz").unwrap_err();
    assert_eq!(error.to_string(), "no material `zzzzzzzz` in the library of 3: `nbrdf list` names them all");
}

#[test]
fn archives_folders_and_files_hold_the_same_networks() {
    let npz = npy::write_npz(&network(1.0));
    let tensors = safetensors::write_safetensors(&network(2.0));
    let set = npy::write_npy(&network(3.0));
    let mut files: Vec<(String, Vec<u8>)> = crate::nbrdf::ARRAYS
        .iter()
        .zip(&set)
        .map(|(array, bytes)| (format!("paper_white_rgb_{array}.npy"), bytes.clone()))
        .collect();
    files.push(("my-paint.npz".into(), npz.clone()));
    files.push(("chrome.safetensors".into(), tensors));
    files.push(("chrome.json".into(), b"never read".to_vec()));
    files.push(("._chrome.h5".into(), b"never read".to_vec()));
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in &files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    let in_archive: Vec<(String, &[u8])> = files.iter().map(|(n, b)| (format!("deep/er/{n}"), b.as_slice())).collect();
    let in_archive: Vec<(&str, &[u8])> = in_archive.iter().map(|(n, b)| (n.as_str(), *b)).collect();
    let (_keep, archive) = written("a.zip", &zip_of(&in_archive));
    for path in [folder.path(), archive.as_path()] {
        let library = Library::load(path).unwrap();
        let found: Vec<_> = library.iter().map(|e| (e.name.as_str(), e.network.clone())).collect();
        let expected = [("chrome", network(2.0)), ("rgl/paper_white", network(3.0)), ("my-paint", network(1.0))];
        assert_eq!(found, expected);
    }
    for (file, name) in [("paper_white_rgb_b1.npy", "rgl/paper_white"), ("my-paint.npz", "my-paint")] {
        let library = Library::load(&folder.path().join(file)).unwrap();
        assert_eq!(library.iter().map(|e| e.name.as_str()).collect::<Vec<_>>(), [name]);
    }
}

#[test]
fn one_bad_file_stops_a_load_and_is_one_line_of_a_scan() {
    let good = npy::write_npz(&network(1.0));
    let (_keep, path) = written("a.zip", &zip_of(&[("bad.h5", b"junk"), ("good.npz", &good), ("set_b1.npy", b"")]));
    let error = Library::load(&path).unwrap_err().to_string();
    assert!(error.contains("a.zip: bad.h5: not an HDF5 file"), "{error}");
    let scanned = scan(&path).unwrap();
    assert_eq!(
        scanned.iter().map(|scanned| (scanned.source.as_str(), scanned.entry.is_ok())).collect::<Vec<_>>(),
        [("good.npz", true), ("bad.h5", false), ("set_fc1.npy", false)]
    );
    assert!(scanned[2].entry.as_ref().unwrap_err().to_string().contains("arrays [fc1, fc2, b2, fc3, b3] are missing"));
}

#[test]
fn two_files_for_one_material_are_refused() {
    let npz = npy::write_npz(&network(1.0));
    let (_keep, path) = written("a.zip", &zip_of(&[("a/chrome.npz", &npz), ("b/chrome.npz", &npz)]));
    let error = Library::load(&path).unwrap_err();
    assert!(matches!(&error, LibraryError::Entry(e) if matches!(e.problem, ReadProblem::Duplicate(_))), "{error}");
}

#[test]
fn archives_with_names_that_lead_outside_are_refused() {
    for name in ["../chrome.npz", "a/../../chrome.npz", "/etc/chrome.npz", "a\\..\\chrome.npz", "C:chrome.npz"] {
        let (_keep, path) = written("a.zip", &zip_of(&[(name, &npy::write_npz(&network(1.0)))]));
        let error = Library::load(&path).unwrap_err();
        assert!(matches!(error, LibraryError::Archive { .. }), "{name}: {error}");
    }
}

#[test]
fn a_bomb_is_stopped_at_the_limit_of_one_file() {
    let zeros = vec![0; 64 << 20];
    let bytes = zip_of(&[("bomb.h5", &zeros)]);
    assert!(bytes.len() < 1 << 20);
    let (_keep, path) = written("a.zip", &bytes);
    let error = Library::load(&path).unwrap_err();
    assert!(error.to_string().contains("bomb.h5: more than 4194304 bytes"), "{error}");
}

#[test]
fn many_small_bombs_are_stopped_at_the_limit_of_an_archive() {
    let zeros = vec![0; 4 << 20];
    let names: Vec<String> = (0..65).map(|i| format!("{i}.h5")).collect();
    let files: Vec<(&str, &[u8])> = names.iter().map(|name| (name.as_str(), zeros.as_slice())).collect();
    let (_keep, path) = written("a.zip", &zip_of(&files));
    assert!(matches!(scan(&path), Err(LibraryError::TooLarge { .. })));
}

#[test]
fn entries_that_share_their_bytes_unpack_to_no_more_than_the_archive_could_hold() {
    let single = zip_of(&[("00.h5", &vec![0; 4 << 20])]);
    // The central directory again and again: 40 entries of 4 MB each in 7 kB.
    let head = single.windows(4).rposition(|bytes| bytes == b"PK\x01\x02").unwrap();
    let end = single.windows(4).rposition(|bytes| bytes == b"PK\x05\x06").unwrap();
    let mut shared = single[..head].to_vec();
    for i in 0..40_u8 {
        let mut entry = single[head..end].to_vec();
        entry[46..48].copy_from_slice(&[b'0' + i / 10, b'0' + i % 10]);
        shared.extend(entry);
    }
    let mut tail = single[end..].to_vec();
    tail[8..12].copy_from_slice(&[40, 0, 40, 0]);
    tail[12..16].copy_from_slice(&(40 * (end - head) as u32).to_le_bytes());
    shared.extend(tail);
    assert!(shared.len() < 10_000);
    let error = scan_archive("shared.zip", &shared).unwrap_err();
    assert!(matches!(&error, LibraryError::TooLarge { limit, .. } if *limit < 10 << 20), "{error}");
}

#[test]
fn more_entries_than_a_library_has_are_refused() {
    let names: Vec<String> = (0..=MAX_ENTRIES).map(|i| format!("{i}.json")).collect();
    let files: Vec<(&str, &[u8])> = names.iter().map(|name| (name.as_str(), &b""[..])).collect();
    let (_keep, path) = written("a.zip", &zip_of(&files));
    assert!(matches!(scan(&path), Err(LibraryError::TooLarge { .. })));
}

#[test]
fn an_archive_cut_anywhere_is_an_error_that_names_it() {
    let bytes = zip_of(&[("chrome.npz", &npy::write_npz(&network(1.0)))]);
    for length in (0..bytes.len()).step_by(37) {
        let (_keep, path) = written("cut.zip", &bytes[..length]);
        let error = Library::load(&path).unwrap_err();
        assert!(error.to_string().contains("cut.zip: not a readable zip archive"), "{error}");
    }
}

#[test]
fn an_entry_marked_encrypted_or_of_unknown_compression_is_an_error_of_its_own() {
    let plain = zip_of(&[("chrome.npz", &npy::write_npz(&network(1.0)))]);
    let central = plain.windows(4).position(|w| w == b"PK\x01\x02").unwrap();
    // Flags are at 6 (local) and 8 (central), the method at 8 and 10.
    for (local, value) in [(6, 1_u8), (8, 12)] {
        let mut bytes = plain.clone();
        bytes[local] = value;
        bytes[central + local + 2] = value;
        let (_keep, path) = written("a.zip", &bytes);
        let error = Library::load(&path).unwrap_err();
        assert!(error.to_string().contains("chrome.npz: cannot be unpacked"), "{error}");
    }
}

#[test]
fn a_place_without_networks_is_an_error_that_says_what_is_read() {
    let folder = tempfile::tempdir().unwrap();
    assert!(matches!(Library::load(folder.path()), Err(LibraryError::Empty { .. })));
    let (_keep, path) = written("a.zip", &zip_of(&[("chrome.json", b"{}")]));
    assert!(matches!(Library::load(&path), Err(LibraryError::Empty { .. })));
    assert!(matches!(Library::load(&folder.path().join("none.zip")), Err(LibraryError::Io { .. })));
    assert!(matches!(Library::load(&folder.path().join("none")), Err(LibraryError::Io { .. })));
    let (_keep, path) = written("notes.txt", b"hello");
    assert!(Library::load(&path).unwrap_err().to_string().contains("expected the extension .h5, "));
}

#[test]
fn names_no_material_can_have_are_refused() {
    let long = "x".repeat(MAX_NAME + 1);
    for name in ["@shared_start", "", "a\nb", &long] {
        let entry = Entry::new(name, "f", network(0.0));
        assert!(Library::new(Provenance::default(), None, vec![entry]).is_err(), "{name}");
    }
}

#[test]
fn a_file_written_on_its_own_is_a_library_of_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.safetensors");
    file::write(&path, &network(1.0)).unwrap();
    let library = Library::load(&path).unwrap();
    assert_eq!(library.get("mine").unwrap().database, Database::Other);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn changed_archives_and_libraries_never_panic(
        changes in proptest::collection::vec((any::<usize>(), any::<u8>()), 1..6),
    ) {
        let npz = npy::write_npz(&Nbrdf::new([2, 2], vec![0.5; crate::nbrdf::weight_count([2, 2])]).unwrap());
        let mut archive = zip_of(&[("a/chrome.npz", &npz), ("b.h5", b"junk")]);
        let (mut tensors, mut json) = manifest::to_bytes(&sample()).unwrap();
        for (place, value) in changes {
            for bytes in [&mut archive, &mut tensors, &mut json] {
                let place = place % bytes.len();
                bytes[place] = value;
            }
        }
        let (_keep, path) = written("a.zip", &archive);
        let _ = scan(&path);
        let _ = Library::from_bytes(&tensors, &json);
        let (good, _) = manifest::to_bytes(&sample()).unwrap();
        let _ = Library::from_bytes(&good, &json);
    }
}
