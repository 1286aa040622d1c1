//! Every reader against arbitrary bytes and against changed files: it reads them or says no, and never panics. Those of
//! the fuzz targets, on the seeds of these.

#[path = "../fuzz/src/readers/mod.rs"]
mod readers;

use std::fs;
use std::path::{Path, PathBuf};

use autoencoder::{Architecture, Autoencoder};
use nbrdf_core::Representation;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use readers::Reader;

/// Seeds of one reader, by name.
fn seeds((name, _): Reader) -> Vec<(PathBuf, Vec<u8>)> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../fuzz/seeds")).join(name);
    let mut files: Vec<_> = fs::read_dir(&folder)
        .unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
        .map(|entry| entry.unwrap().path())
        .map(|path| (path.clone(), fs::read(path).unwrap()))
        .collect();
    files.sort();
    assert!(!files.is_empty(), "{name} has no seeds");
    files
}

/// Bytes with a few of them changed, put in, taken out, or cut off.
fn changed(bytes: &[u8], changes: &[(u32, u8, u8)]) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for &(at, what, value) in changes {
        let at = at as usize % bytes.len().max(1);
        match what % 8 {
            0 => bytes.truncate(at),
            1 => bytes.insert(at.min(bytes.len()), value),
            2 if !bytes.is_empty() => drop(bytes.remove(at)),
            3 => bytes.extend_from_within(at..),
            _ => {
                if let Some(byte) = bytes.get_mut(at) {
                    *byte = if what % 8 == 4 { *byte ^ (1 << (value % 8)) } else { value };
                }
            }
        }
    }
    bytes
}

/// One case after another, the same in every run.
fn each<S: Strategy>(cases: u32, strategy: S, test: impl Fn(S::Value)) {
    let mut runner = TestRunner::new_with_rng(
        Config { cases, failure_persistence: None, ..Config::default() },
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
    );
    runner
        .run(&strategy, |value| {
            test(value);
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
}

fn changes() -> impl Strategy<Value = Vec<(u32, u8, u8)>> {
    proptest::collection::vec(any::<(u32, u8, u8)>(), 1..6)
}

#[test]
fn every_reader_reads_one_of_its_seeds() {
    for reader in readers::ALL {
        // A checkpoint of this size is none; see below.
        let reads = seeds(reader).iter().any(|(_, bytes)| reader.1(bytes));
        assert_eq!(reads, reader.0 != "checkpoint", "{}", reader.0);
    }
}

#[test]
fn arbitrary_bytes_are_read_or_refused() {
    for (_, read) in readers::ALL {
        each(200, proptest::collection::vec(any::<u8>(), 0..300), |bytes| {
            read(&bytes);
        });
    }
}

#[test]
fn changed_files_are_read_or_refused() {
    for reader in readers::ALL {
        // 35 MB are looked at for every case.
        let cases = if reader.0 == "merl" { 10 } else { 200 };
        for (_, bytes) in seeds(reader) {
            each(cases, changes(), |changes| {
                reader.1(&changed(&bytes, &changes));
            });
        }
    }
}

#[test]
fn a_changed_checkpoint_is_read_or_refused() {
    let valid = include_bytes!("../autoencoder/assets/published_autoencoder.safetensors");
    assert!(readers::checkpoint(valid));
    // Header and numbers alike.
    let places = || prop_oneof![(0..4096_u32), any::<u32>()];
    each(60, proptest::collection::vec((places(), any::<u8>(), any::<u8>()), 1..4), |changes| {
        readers::checkpoint(&changed(valid, &changes));
    });
    assert_eq!(Autoencoder::built_in(Architecture::Published).dim(), 32);
}
