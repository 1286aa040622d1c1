//! Codes that were pasted, over a restart.

use std::sync::Arc;

use egui::Event;
use nbrdf::catalog::{Catalog, Reference};
use nbrdf::gui::store::{self, Found};
use nbrdf_core::Code;
use nbrdf_core::Representation as _;
use nbrdf_core::library::builtin;

use super::*;

/// A code of gold paint under another name, as text.
fn code(name: &str) -> String {
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let gold = builtin::shared().get("gold-paint").unwrap().material();
    let code = catalog.autoencoder().encode(&gold).unwrap();
    serde_json::to_string(&Code { material: Some(name.to_owned()), ..code }).unwrap()
}

fn paste(harness: &mut Harness<'_, Workbench>, text: String) -> String {
    let before = harness.state().gallery.names.len();
    harness.event(Event::Paste(text));
    harness.step();
    until(harness, "the code is listed", |bench| bench.gallery.names.len() > before);
    let name = harness.state().gallery.names[before].clone();
    until(harness, "the code is kept", |bench| bench.session.pasted.has(&name));
    name
}

/// Ends a session and reads it again.
fn restarted(mut harness: Harness<'static, Workbench>, file: &std::path::Path) -> Session {
    harness.state_mut().finish(None);
    drop(harness);
    let Found::Session(saved) = store::read(file) else { panic!("no session") };
    saved.session
}

#[test]
fn pasted_codes_and_blends_of_them_come_back_after_a_restart_and_a_damaged_one_is_a_notice() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("session.json");
    let bench = Workbench::new(Stock::built_in(), quick()).keeping(file.clone());
    let mut harness =
        Harness::builder().with_size([1200.0, 800.0]).build_ui_state(|ui, bench: &mut Workbench| bench.ui(ui), bench);
    let own = paste(&mut harness, code("own"));
    let second = paste(&mut harness, code("own"));
    assert_eq!([own.as_str(), second.as_str()], ["own", "own (pasted)"]);
    harness.state_mut().session.blend.choose(0, &second);
    harness.run_steps(2);
    let session = restarted(harness, &file);
    assert_eq!(session.pasted.codes().len(), 2);
    // Whatever happens to one of them harms no other.
    let mut text: serde_json::Value = serde_json::to_value(&session).unwrap();
    text["pasted"][0]["text"] = "{\"schema\": 1}".into();
    let session: Session = serde_json::from_value(text).unwrap();
    let mut harness = built_in(session);
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere A: shown").is_some());
    let Workbench { session, gallery, .. } = harness.state();
    assert!(gallery.names.contains(&second) && !gallery.names.contains(&own));
    assert!(gallery.notices.iter().any(|notice| notice.contains("pasted code of the last session")));
    let kept: Vec<&str> = session.pasted.codes().iter().map(|code| code.name.as_str()).collect();
    assert_eq!(kept, [own.as_str(), second.as_str()], "another version may read it");
}
