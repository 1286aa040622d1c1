//! What is not written: what was stopped, what would replace a file, and what has no folder.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use nbrdf::catalog::{Catalog, Reference};

use super::*;

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
