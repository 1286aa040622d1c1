use proptest::prelude::*;

use super::*;

fn network(hidden: [usize; 2]) -> Nbrdf {
    let count = crate::nbrdf::weight_count(hidden);
    Nbrdf::new(hidden, (0..count).map(|i| (i as f32 * 0.37).sin()).collect()).unwrap()
}

/// An `.npy` file with any header text and body.
fn raw_npy(header: &str, body: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(body);
    bytes
}

fn header(descr: &str, fortran: &str, shape: &str) -> String {
    format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}\n")
}

fn read_with_first(first: &[u8]) -> Result<Nbrdf, NpyError> {
    let files = write_npy(&network([21, 21]));
    let [_, b, c, d, e, f] = &files;
    read_npy([first, b, c, d, e, f])
}

#[test]
fn arrays_written_are_read_back_exactly() {
    for hidden in [[21, 21], [1, 1], [5, 256]] {
        let network = network(hidden);
        let files = write_npy(&network);
        assert_eq!(read_npy(files.each_ref().map(Vec::as_slice)).unwrap(), network);
        assert_eq!(read_npz(&write_npz(&network)).unwrap(), network);
    }
}

#[test]
fn the_same_network_gives_the_same_npz() {
    assert_eq!(write_npz(&network([21, 21])), write_npz(&network([21, 21])));
}

#[test]
fn headers_are_those_numpy_writes() {
    let [kernel, bias, ..] = write_npy(&network([21, 21]));
    let text = |bytes: &[u8]| String::from_utf8_lossy(&bytes[10..]).into_owned();
    assert!(text(&kernel).contains("'descr': '<f4'") && text(&kernel).contains("(6, 21"), "{}", text(&kernel));
    assert!(text(&bias).contains("(21,"), "{}", text(&bias));
}

#[test]
fn doubles_either_byte_order_and_fortran_order_are_read() {
    let network = network([21, 21]);
    let kernel = &network.weights()[..126];
    let transposed: Vec<f32> = (0..21).flat_map(|column| (0..6).map(move |row| kernel[row * 21 + column])).collect();
    let little = |v: &[f32]| v.iter().flat_map(|&v| f64::from(v).to_le_bytes()).collect::<Vec<_>>();
    let big = |v: &[f32]| v.iter().flat_map(|&v| v.to_be_bytes()).collect::<Vec<_>>();
    for (header, body) in [
        (header("<f8", "False", "(6, 21)"), little(kernel)),
        (header(">f4", "False", "(6, 21)"), big(kernel)),
        (header("<f8", "True", "(6, 21)"), little(&transposed)),
    ] {
        assert_eq!(read_with_first(&raw_npy(&header, &body)).unwrap(), network, "{header}");
    }
}

#[test]
fn hostile_headers_are_refused_before_anything_is_allocated() {
    let nested = format!("{{'shape': {}{} }}", "(".repeat(400), ")".repeat(400));
    let mut long = b"\x93NUMPY\x02\x00".to_vec();
    long.extend(u32::MAX.to_le_bytes());
    for file in [
        raw_npy(&header("<f4", "False", "(4294967296, 4294967296)"), &[]),
        raw_npy(&header("<f4", "False", "(9999, 9999)"), &[]),
        raw_npy(&header("<f4", "False", "(6, 21, 9999, 9999, 9999, 9999)"), &[]),
        raw_npy(&header("<f4", "False", "(-6, 21)"), &[0; 504]),
        raw_npy(&header("|O", "False", "(6, 21)"), &[0; 504]),
        raw_npy(&header("<c16", "False", "(6, 21)"), &[0; 126 * 16]),
        raw_npy(&header("<i4", "False", "(6, 21)"), &[0; 504]),
        raw_npy(&header("|V99999999999999999999", "False", "(6, 21)"), &[0; 504]),
        raw_npy("{'descr': [('a', '<f4', (9999, 9999))], 'fortran_order': False, 'shape': (6, 21)}", &[0; 504]),
        raw_npy(&nested, &[]),
        long,
        Vec::new(),
        b"\x93NUMPY\x01\x00".to_vec(),
    ] {
        let error = read_with_first(&file).unwrap_err();
        assert!(matches!(error, NpyError::Header { .. } | NpyError::Shape(_) | NpyError::Length { .. }), "{error}");
    }
}

#[test]
fn missing_surplus_and_non_finite_numbers_are_refused() {
    let plain = header("<f4", "False", "(6, 21)");
    assert!(matches!(read_with_first(&raw_npy(&plain, &[0; 500])), Err(NpyError::Length { .. })));
    assert!(matches!(read_with_first(&raw_npy(&plain, &[0; 508])), Err(NpyError::Length { .. })));
    let nan: Vec<u8> = (0..126).flat_map(|_| f32::NAN.to_le_bytes()).collect();
    assert!(matches!(read_with_first(&raw_npy(&plain, &nan)), Err(NpyError::Network(_))));
    // Finite as f64, infinite as f32.
    let huge: Vec<u8> = (0..126).flat_map(|_| 1e300_f64.to_le_bytes()).collect();
    let doubles = header("<f8", "False", "(6, 21)");
    assert!(matches!(read_with_first(&raw_npy(&doubles, &huge)), Err(NpyError::Network(_))));
}

#[test]
fn an_npz_without_an_array_names_it() {
    use std::io::Write;
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    zip.start_file("fc1.npy", zip::write::SimpleFileOptions::default()).unwrap();
    zip.write_all(&write_npy(&network([21, 21]))[0]).unwrap();
    let error = read_npz(&zip.finish().unwrap().into_inner()).unwrap_err().to_string();
    assert!(error.starts_with("arrays [b1, fc2, b2, fc3, b3] are missing"), "{error}");
}

#[test]
fn an_npz_bomb_is_refused() {
    use std::io::Write;
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for name in ARRAYS {
        zip.start_file(format!("{name}.npy"), zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(&vec![0; 1 << 24]).unwrap();
    }
    let bytes = zip.finish().unwrap().into_inner();
    assert!(bytes.len() < 1 << 18);
    assert!(read_npz(&bytes).unwrap_err().to_string().contains("unpacks to more"));
}

#[test]
fn an_npz_cut_anywhere_is_an_error() {
    let bytes = write_npz(&network([21, 21]));
    assert!((0..bytes.len()).step_by(7).all(|length| read_npz(&bytes[..length]).is_err()));
}

proptest! {
    #[test]
    fn garbage_never_panics(bytes in proptest::collection::vec(any::<u8>(), 0..512), text in "[-{}()\\[\\]0-9x,' ]{0,64}") {
        let _ = read_npz(&bytes);
        let _ = read_with_first(&bytes);
        let _ = read_with_first(&raw_npy(&text, &bytes));
        let _ = read_with_first(&raw_npy(&header("<f4", "False", &text), &bytes));
    }

    #[test]
    fn changed_bytes_never_panic(changes in proptest::collection::vec((any::<usize>(), any::<u8>()), 1..8)) {
        let network = network([4, 4]);
        let mut npz = write_npz(&network);
        let [mut npy, ..] = write_npy(&network);
        for (place, value) in changes {
            let (in_npz, in_npy) = (place % npz.len(), place % npy.len());
            npz[in_npz] = value;
            npy[in_npy] = value;
        }
        let _ = read_npz(&npz);
        let _ = read_with_first(&npy);
    }
}
