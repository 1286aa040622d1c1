//! The worker alone, without panes.

use std::path::PathBuf;
use std::sync::Arc;

use nbrdf::worker::{Answer, MapAnswer, MapRequest, Origins, Projection, Request, Timing, Walk, Worker};
use nbrdf_core::Weights;

use super::library::samples;
use super::*;

/// What a worker says until something is said, that included.
fn until_said(worker: &Worker, what: &str, is_it: impl Fn(&Answer) -> bool) -> Vec<Answer> {
    let patience = Instant::now() + Duration::from_secs(120);
    let mut said = Vec::new();
    while !said.last().is_some_and(&is_it) {
        assert!(Instant::now() < patience, "still waiting until {what}");
        match worker.answers().next() {
            Some(answer) => said.push(answer),
            None => std::thread::sleep(Duration::from_millis(5)),
        }
    }
    said
}

#[test]
fn asking_for_measurements_begins_no_picture_anew() {
    let around = Lighting::Around { map: Asset::BuiltIn, turn: 0.0 };
    let session = Session { methods: Methods(vec!["latent"]), look: under(around), ..quick() };
    let mut worker = Worker::start(Stock::built_in(), || ());
    let number = worker.show(Request { size: 48, ..session.shown() });
    until_said(&worker, "all is shown", |answer| matches!(answer, Answer::Done(done) if *done == number));
    worker.measure(true);
    let card = Card::Method("latent");
    let said =
        until_said(&worker, "it is measured", |answer| matches!(answer, Answer::Measured(of, Some(_)) if *of == card));
    assert!(!said.iter().any(|answer| matches!(answer, Answer::Picture(..) | Answer::Done(_))), "{said:?}");
}

#[test]
fn a_map_that_failed_is_learned_again_only_when_there_are_other_materials() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ours.npz");
    let mut stock = Stock::built_in();
    std::fs::write(&path, npy::write_npz(stock.materials[0].network.as_ref().unwrap())).unwrap();
    let is_held_out = |name: &str| nbrdf_core::Split::of(name) == nbrdf_core::Split::HeldOut;
    stock.materials.retain(|material| is_held_out(&material.name));
    stock.materials.truncate(2);
    let ends: Arc<[String]> = stock.materials.iter().map(|material| material.name.clone()).collect();
    let worker = Worker::start(stock, || ());
    let is_learning = |answer: &&Answer| match answer {
        Answer::Map(MapAnswer::Doing(Some(doing))) => doing.contains("learning"),
        _ => false,
    };
    let tries = |t: f32| {
        worker.map(MapRequest {
            projection: Projection::Pca,
            ends: Arc::clone(&ends),
            weights: Weights::two(t),
            range: None,
            timing: Timing::Straight,
            walk: Walk::default(),
            methods: Vec::new(),
            explored: None,
        });
        let is_over = |answer: &Answer| matches!(answer, Answer::Map(MapAnswer::Doing(None)));
        let said = until_said(&worker, "the map is given up", is_over);
        said.iter().filter(is_learning).count()
    };
    assert_eq!([tries(0.1), tries(0.2), tries(0.3)], [1, 0, 0]);
    worker.open(path);
    let said = until_said(&worker, "it is open", |answer| matches!(answer, Answer::Kept(..)));
    // The last request is served anew by itself, before or after the next.
    let early = said.iter().filter(is_learning).count();
    assert_eq!(early + tries(0.4) + tries(0.5), 1);
}

#[test]
fn a_closed_worker_gives_up_fits_thumbnails_and_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = samples(folder.path());
    // Every thread shares the stock: it is gone when all of them are.
    let token = Arc::new(PathBuf::new());
    let threads = Arc::downgrade(&token);
    let dialog = Box::new(move || Ok(vec![token.as_ref().clone()]));
    let worker = Worker::start(Stock { fit_steps: 1 << 40, dialog, ..Stock::built_in() }, || ());
    worker.open(path);
    until_said(
        &worker,
        "it is being fitted",
        |answer| matches!(answer, Answer::Jobs(jobs) if jobs.iter().any(|job| job.left.is_some())),
    );
    worker.reopen(vec![folder.path().join("none.npz"); 100], Origins::new(), Vec::new());
    drop(worker);
    let patience = Instant::now() + Duration::from_secs(120);
    while threads.strong_count() > 0 {
        assert!(Instant::now() < patience, "threads are still at work");
        std::thread::sleep(Duration::from_millis(10));
    }
}
