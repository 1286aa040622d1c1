//! Scenes: opened, planned, slid, stopped.

use std::path::{Path, PathBuf};

use nbrdf::gui::Session;
use nbrdf::gui::pane::Pane;
use nbrdf::worker::scene::{Planned, Row, Source};
use nbrdf_core::plan::By;

use super::*;

/// Two spheres, one in the middle of the picture.
const TWO: &str = r#"
tolerance = 0.02
[image]
width = 48
height = 32
samples = 4
[camera]
from = [0.0, 0.0, 5.0]
to = [0.0, 0.0, 0.0]
field = 40.0
[[light]]
kind = "point"
at = [2.0, 3.0, 5.0]
intensity = [30.0, 30.0, 30.0]
[[object]]
name = "ball"
material = "blue-rubber"
sphere = { centre = [0.0, 0.0, 0.0], radius = 1.0 }
[[object]]
name = "bead"
material = "pink-felt"
sphere = { centre = [2.0, 0.0, 0.0], radius = 0.6 }
"#;

fn written(folder: &Path, text: &str) -> PathBuf {
    let file = folder.join("scene.toml");
    std::fs::write(&file, text).unwrap();
    file
}

/// The plan of the scene's own picture, once nothing is left to do.
fn plan(workbench: &Workbench) -> Option<&Planned> {
    let scene = &workbench.gallery.scene;
    scene.plan.as_ref().filter(|plan| !plan.is_draft && !scene.is_busy())
}

fn planned(harness: &mut Harness<'_, Workbench>) {
    until(harness, "there is a plan", |bench| plan(bench).is_some());
}

fn rows(harness: &Harness<'_, Workbench>) -> Vec<Row> {
    plan(harness.state()).unwrap().rows.clone()
}

#[test]
fn a_scene_that_is_opened_gets_a_model_within_the_tolerance_for_every_object() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = built_in(quick());
    harness.state().open(written(folder.path(), TWO));
    planned(&mut harness);
    assert!(harness.query_by_label_contains("ball, blue-rubber: ").is_some());
    let found = rows(&harness);
    assert_eq!(found.iter().map(|row| row.object.as_str()).collect::<Vec<_>>(), ["ball", "bead"]);
    let tolerance = plan(harness.state()).unwrap().tolerance;
    assert_eq!(tolerance, 0.02, "that of the scene");
    for row in &found {
        assert!(row.error <= tolerance && row.ns > 0.0 && !row.reason.is_empty(), "{row:?}");
    }
    // The middle of the picture is the ball.
    harness.get_by_label_contains("Picture of the scene").click();
    harness.run_steps(2);
    assert_eq!(harness.state().session.scene.selected.as_deref(), Some("ball"));
    harness.get_by_label("Put blue-rubber at A").click();
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.ends[0], "blue-rubber");
    // The stage has a button of this name, too, before it.
    let differences: Vec<_> = harness.get_all_by_label("Difference").collect();
    differences[differences.len() - 1].click();
    harness.run_steps(2);
    assert!(harness.query_by_label("Picture of the scene, difference, ball selected").is_some());
}

#[test]
fn a_larger_tolerance_costs_no_more_bytes_and_undo_brings_the_smaller_one_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = quick();
    session.scene.by = By::Bytes;
    let mut harness = built_in(session);
    harness.state().open(written(folder.path(), TWO));
    planned(&mut harness);
    let bytes = |harness: &Harness<'_, Workbench>| plan(harness.state()).unwrap().totals.bytes;
    let before = bytes(&harness);
    harness.state_mut().session.scene.tolerance = Some(0.4);
    harness.step();
    until(&mut harness, "there is a coarser plan", |bench| plan(bench).is_some_and(|plan| plan.tolerance == 0.4));
    let after = bytes(&harness);
    assert!(after < before, "{before} and {after} bytes: what may look unlike is a formula");
    assert!(rows(&harness).iter().all(|row| row.error <= 0.4));
    harness.state_mut().act(nbrdf::gui::action::Action::Undo, &egui::Context::default());
    harness.step();
    until(&mut harness, "the first plan is back", |bench| plan(bench).is_some_and(|plan| plan.tolerance == 0.02));
    assert!(bytes(&harness) > after);
}

#[test]
fn a_broken_scene_is_a_notice_and_a_whole_one_is_planned_afterwards() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = built_in(quick());
    let file = written(folder.path(), &TWO.replace("pink-felt", "pink-felk"));
    harness.state().open(file.clone());
    until(&mut harness, "there is a notice", |bench| !bench.gallery.notices.is_empty());
    let notice = harness.state().gallery.notices[0].clone();
    assert!(notice.contains("scene.toml") && notice.contains("'bead'") && notice.contains("pink-felk"), "{notice}");
    until(&mut harness, "nothing is left to do", |bench| !bench.gallery.scene.is_busy());
    assert!(plan(harness.state()).is_none());
    written(folder.path(), TWO);
    harness.get_by_label("Open").click();
    harness.step();
    planned(&mut harness);
    assert_eq!(harness.state().session.scene.source, Some(Source::File(file)));
}

#[test]
fn cancel_stops_a_plan_and_it_goes_on_when_asked() {
    let mut harness = built_in(quick());
    harness.state_mut().bring(Pane::Scene);
    harness.run_steps(2);
    harness.get_by_label("Example: shelf").click();
    harness.run_steps(2);
    harness.get_by_label("Cancel").click();
    until(&mut harness, "it has stopped", |bench| bench.gallery.scene.is_stopped && !bench.gallery.scene.is_busy());
    assert!(plan(harness.state()).is_none());
    harness.get_by_label("Plan").click();
    harness.run_steps(2);
    until(&mut harness, "there is a draft", |bench| bench.gallery.scene.plan.is_some());
    assert_eq!(harness.state().gallery.scene.plan.as_ref().map(|plan| plan.rows.len()), Some(14));
    harness.state_mut().session.scene = Session::default().scene;
    harness.run_steps(2);
}
