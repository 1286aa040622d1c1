use std::{collections::HashMap, fs, io::Read};

use hdf5_pure::FileBuilder;
use proptest::prelude::*;

use super::*;
use crate::data::published_or_skip;

/// A Keras-like file: layers `(name, kernel rows, kernel columns, bias length)`, every number `value`.
fn keras_file(layers: &[(&str, u64, u64, u64)], value: f32) -> Vec<u8> {
    let mut file = FileBuilder::new();
    for &(name, rows, columns, bias) in layers {
        let mut outer = file.create_group(name);
        let mut inner = outer.create_group(name);
        let kernel = vec![value; (rows * columns) as usize];
        inner.create_dataset("kernel:0").with_f32_data(&kernel).with_shape(&[rows, columns]);
        inner.create_dataset("bias:0").with_f32_data(&vec![value; bias as usize]).with_shape(&[bias]);
        outer.add_group(inner.finish());
        file.add_group(outer.finish());
    }
    file.finish().unwrap()
}

/// The published files of an archive: stem and bytes.
fn published(archive: &str) -> Option<HashMap<String, Vec<u8>>> {
    let path = published_or_skip(archive)?;
    let mut zip = zip::ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    let mut files = HashMap::new();
    for index in 0..zip.len() {
        let mut entry = zip.by_index(index).unwrap();
        let name = entry.name().unwrap().rsplit('/').next().unwrap().to_owned();
        if let Some(stem) = name.strip_suffix(".h5") {
            let mut bytes = Vec::new();
            entry.read_to_end(&mut bytes).unwrap();
            files.insert(stem.to_owned(), bytes);
        }
    }
    Some(files)
}

#[test]
fn the_weights_of_all_published_merl_networks_sum_to_3766() {
    let Some(files) = published("merl_nbrdf.zip") else { return };
    assert_eq!(files.len(), 100);
    let sum: f64 = files.values().flat_map(|bytes| read_keras(bytes).unwrap().into_weights()).map(f64::from).sum();
    assert!((sum - 3766.335698).abs() < 1e-5, "{sum}");
}

#[test]
fn all_published_rgl_networks_are_6_21_21_3() {
    let Some(files) = published("rgl_nbrdf_subset.zip") else { return };
    assert_eq!(files.len(), 34);
    assert!(files.values().all(|bytes| read_keras(bytes).unwrap().hidden() == [21, 21]));
}

#[test]
fn layers_are_ordered_by_number_not_by_spelling() {
    let network = read_keras(&keras_file(&[("dense_10", 6, 4, 4), ("dense_9", 4, 3, 3), ("dense_11", 4, 5, 5)], 0.5));
    assert!(matches!(network, Err(KerasError::Shape(_))), "dense_9 comes first: {network:?}");
    let network = read_keras(&keras_file(&[("dense_10", 4, 5, 5), ("dense_9", 6, 4, 4), ("dense_11", 5, 3, 3)], 0.5));
    assert_eq!(network.unwrap().hidden(), [4, 5]);
}

#[test]
fn the_first_layer_may_have_no_number() {
    let layers = [("dense_2", 5, 3, 3), ("dense", 6, 4, 4), ("dense_1", 4, 5, 5)];
    assert_eq!(read_keras(&keras_file(&layers, 0.5)).unwrap().hidden(), [4, 5]);
}

#[test]
fn what_is_no_network_is_refused_with_what_was_found() {
    let two = keras_file(&[("dense_1", 6, 21, 21), ("dense_2", 21, 3, 3)], 0.0);
    assert_eq!(
        read_keras(&two).unwrap_err().to_string(),
        "expected 3 Dense layers (kernel and bias each), found 2: [dense_1/dense_1, dense_2/dense_2]"
    );
    let wrong = keras_file(&[("dense_1", 5, 21, 21), ("dense_2", 21, 21, 21), ("dense_3", 21, 3, 3)], 0.0);
    assert!(matches!(read_keras(&wrong), Err(KerasError::Shape(_))));
    let wide = keras_file(&[("dense_1", 6, 300, 300), ("dense_2", 300, 21, 21), ("dense_3", 21, 3, 3)], 0.0);
    assert!(matches!(read_keras(&wide), Err(KerasError::Shape(_))));
    for bad in [f32::NAN, f32::INFINITY] {
        let bad = keras_file(&[("dense_1", 6, 21, 21), ("dense_2", 21, 21, 21), ("dense_3", 21, 3, 3)], bad);
        assert!(matches!(read_keras(&bad), Err(KerasError::Network(NbrdfError::NotFinite { index: 0, .. }))));
    }
    assert!(matches!(read_keras(b"PK\x03\x04"), Err(KerasError::NotHdf5)));
    assert!(matches!(read_keras(b""), Err(KerasError::NotHdf5)));
}

#[test]
fn a_file_cut_anywhere_is_an_error() {
    let Some(files) = published("merl_nbrdf.zip") else { return };
    let bytes = &files["chrome"];
    let whole = read_keras(bytes).unwrap();
    for length in (0..bytes.len()).step_by(61) {
        if let Ok(network) = read_keras(&bytes[..length]) {
            assert_eq!(network, whole, "cut at {length}");
        }
    }
}

proptest! {
    #[test]
    fn garbage_never_panics(bytes in proptest::collection::vec(any::<u8>(), 0..2048)) {
        let _ = read_keras(&bytes);
        let signed: Vec<u8> = b"\x89HDF\r\n\x1a\n".iter().copied().chain(bytes).collect();
        let _ = read_keras(&signed);
    }

    #[test]
    fn changed_bytes_never_panic(changes in proptest::collection::vec((any::<usize>(), any::<u8>()), 1..8)) {
        let layers = [("dense_1", 6, 4, 4), ("dense_2", 4, 4, 4), ("dense_3", 4, 3, 3)];
        let mut bytes = keras_file(&layers, 0.5);
        for (place, value) in changes {
            let place = place % bytes.len();
            bytes[place] = value;
        }
        let _ = read_keras(&bytes);
    }
}
