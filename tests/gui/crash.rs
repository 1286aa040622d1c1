//! What a crash leaves: other materials, and the session.

use std::sync::Arc;

use nbrdf::gui::store::{self, Found};
use nbrdf_core::{Brdf, Directions, Material, Rgb};

use super::*;

/// A material that nobody can look at.
struct Torn;

impl Brdf for Torn {
    fn eval(&self, _: Directions) -> Rgb {
        panic!("torn to pieces")
    }
}

#[test]
fn a_panicking_material_is_a_notice_and_later_requests_work() {
    let mut stock = Stock::built_in();
    stock.materials.insert(0, Material::new("torn", Arc::new(Torn)));
    let mut session = quick();
    session.blend.choose(0, "torn");
    let mut harness = open(stock, session, [1200.0, 800.0]);
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere A: failed").is_some());
    // The thumbnail of the first material has failed, and all others are rendered.
    until(&mut harness, "there are thumbnails", |bench| bench.gallery.thumbnail("chrome").is_some());
    let said = |bench: &Workbench| bench.gallery.notices.iter().filter(|told| told.contains("torn to pieces")).count();
    assert!(said(harness.state()) >= 2, "{:?}", harness.state().gallery.notices);
    assert!(harness.state().gallery.thumbnail("torn").is_none());
    harness.state_mut().session.blend.choose(0, "chrome");
    harness.run_steps(2);
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere A: shown").is_some());
    assert!(harness.query_by_label("Sphere raw_weights: shown").is_some());
}

#[test]
fn a_session_survives_a_crash() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("session.json");
    let workbench = Workbench::new(Stock::built_in(), quick()).keeping(file.clone());
    let harness = Harness::builder().with_size([1200.0, 800.0]);
    let mut harness = harness.build_ui_state(|ui, workbench: &mut Workbench| workbench.ui(ui), workbench);
    harness.run_steps(2);
    harness.state_mut().session.blend.choose(1, "chrome");
    harness.state_mut().session.blend.go_to(0.3125);
    harness.state_mut().session.export.name = "mine".to_owned();
    let wanted = harness.state().session.clone();
    let kept = || matches!(store::read(&file), Found::Session(saved) if saved.session == wanted);
    until(&mut harness, "the session is kept", |_| kept());
    // Nobody says goodbye.
    drop(harness);
    assert!(kept());
}
