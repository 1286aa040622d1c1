use safetensors::tensor::{Dtype, TensorView};

use super::*;

fn sample() -> TensorFile {
    TensorFile::new("model", "sample".to_owned())
        .with("single", &[2, 3], Numbers::F32(vec![1.5, -2.0, 0.0, 3.0, 1e-30, 1e30]))
        .with("double", &[2], Numbers::F64(vec![0.1, f64::MAX]))
        .with("index", &[1], Numbers::U32(vec![u32::MAX]))
}

#[test]
fn what_is_written_is_read_and_the_same_tensors_give_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["a", "b"].map(|name| folder.path().join(name));
    let [first, second] = paths.each_ref().map(|path| {
        sample().save(path).unwrap();
        TensorFile::read(path, 4096).unwrap()
    });
    assert_eq!(first, second);
    let first = TensorFile::parse("a", &first).unwrap();
    assert_eq!(first.metadata("model"), Some("sample"));
    assert_eq!(first.rows::<f32>("single", 3).unwrap(), [[1.5, -2.0, 0.0], [3.0, 1e-30, 1e30]]);
    assert_eq!(first.tensor::<f64>("double", &[2]).unwrap(), [0.1, f64::MAX]);
    assert_eq!(first.tensor::<u32>("index", &[1]).unwrap(), [u32::MAX]);
}

#[test]
fn errors_say_what_was_expected_and_what_was_found() {
    let of = |error: TensorFileError| error.to_string();
    assert!(of(sample().shape("other").unwrap_err()).contains("expected tensor 'other', found none"));
    assert!(of(sample().tensor::<f32>("single", &[6]).unwrap_err()).contains("[6], found shape [2, 3]"));
    assert!(of(sample().tensor::<f32>("double", &[2]).unwrap_err()).contains("of F32"));
    assert!(
        of(sample().check_within("single", 1e29).unwrap_err()).contains("within ±1e29 in tensor 'single', found 1")
    );
    assert!(sample().check_within("single", 1.1e30).is_ok());
    assert!(of(sample().rows::<f32>("single", 2).unwrap_err()).contains("[rows, 2], found shape [2, 3]"));
}

#[test]
fn numbers_that_are_not_finite_other_kinds_and_large_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    let saved = |numbers: Numbers| {
        TensorFile::new("k", String::new()).with("t", &[1], numbers).save(&path).unwrap();
        TensorFile::parse("a", &TensorFile::read(&path, 4096)?).map(|_| ())
    };
    assert!(saved(Numbers::F32(vec![f32::NAN])).unwrap_err().to_string().contains("finite numbers in tensor 't'"));
    assert!(saved(Numbers::F64(vec![f64::INFINITY])).unwrap_err().to_string().contains("finite"));
    assert!(TensorFile::read(&path, 10).unwrap_err().to_string().contains("at most 10 bytes"));
    let half = TensorView::new(Dtype::F16, vec![1], &[0, 0]).unwrap();
    let half = serialize([("t", half)], None).unwrap();
    assert!(TensorFile::parse("x", &half).unwrap_err().to_string().contains("found F16"));
    assert!(TensorFile::parse("x", b"{}").unwrap_err().to_string().contains("a safetensors file"));
}
