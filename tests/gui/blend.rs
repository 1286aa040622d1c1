//! Blends: which materials, where between them, and what is moved on the way.

use nbrdf::gui::session::{Blend, Way};
use nbrdf::worker::Timing;
use nbrdf_core::axis::Axis;

use super::*;

const RAW: Card = Card::Method("raw_weights");

fn three(way: Way) -> Session {
    let ends = ["gold-paint", "blue-acrylic", "chrome"].map(str::to_owned).to_vec();
    Session { blend: Blend { ends, way, ..Blend::default() }, ..quick() }
}

fn distance(harness: &Harness<'_, Workbench>, card: Card) -> Option<f64> {
    harness.state().gallery.view(card).and_then(|view| view.figures).map(|figures| figures.to_mix)
}

#[test]
fn materials_are_added_changed_and_taken_out_by_clicks() {
    let mut harness = built_in(quick());
    harness.run_steps(2);
    assert!(harness.query_by_label("Remove A").is_none(), "two stay");
    harness.get_by_label("Add a material").click();
    harness.run_steps(3);
    harness.get_by_label("Take alumina-oxide").click();
    harness.run_steps(3);
    assert_eq!(harness.state().session.blend.ends, ["gold-paint", "blue-acrylic", "alumina-oxide"]);
    harness.get_by_label("Remove A").click();
    harness.run_steps(3);
    assert_eq!(harness.state().session.blend.ends, ["blue-acrylic", "alumina-oxide"]);
}

#[test]
fn a_chip_that_is_dragged_onto_another_takes_its_place() {
    let mut harness = built_in(three(Way::Keys));
    harness.run_steps(2);
    let [from, to] = ["Slot A: gold-paint", "Slot C: chrome"].map(|label| harness.get_by_label(label).rect().center());
    harness.drag_at(from);
    harness.step();
    harness.hover_at(from + egui::vec2(20.0, 0.0));
    harness.step();
    harness.hover_at(to);
    harness.step();
    harness.drop_at(to);
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.ends, ["blue-acrylic", "chrome", "gold-paint"]);
}

#[test]
fn the_place_in_the_polygon_moves_by_keyboard_and_pointer() {
    let mut harness = built_in(three(Way::Polygon));
    settle(&mut harness);
    assert!(["A", "B", "C"].iter().all(|end| harness.query_by_label(&format!("Sphere {end}: shown")).is_some()));
    let (before, picture) = (harness.state().session.blend.weights(), distance(&harness, RAW));
    harness.get_by_label("Place in the polygon").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowUp);
    harness.run_steps(2);
    let after = harness.state().session.blend.weights();
    assert!(after.as_slice()[0] > before.as_slice()[0], "{before:?} {after:?}");
    settle(&mut harness);
    assert_ne!(distance(&harness, RAW), picture);
    harness.get_by_label("Place in the polygon").click();
    harness.run_steps(2);
    let middle = harness.state().session.blend.weights();
    assert!(middle.as_slice().iter().all(|weight| (weight - 1.0 / 3.0).abs() < 0.02), "{middle:?}");
}

#[test]
fn a_strip_around_a_polygon_goes_to_its_rim() {
    let mut harness = built_in(Session { strips: true, ..three(Way::Polygon) });
    settle(&mut harness);
    assert!((0..10).all(|step| harness.state().gallery.frame(RAW, step).is_some()));
    harness.get_by_label("Raw weights at 0.333").click();
    harness.run_steps(2);
    assert!(harness.state().session.blend.weights().as_slice()[1] > 0.999);
}

#[test]
fn even_timing_changes_a_quarter_of_the_way_and_leaves_keys_alone() {
    let mut session = three(Way::Keys);
    session.blend.t = 0.25;
    let mut harness = built_in(session);
    settle(&mut harness);
    let straight = distance(&harness, RAW);
    harness.get_by_label("Even").click();
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.timing, Timing::Even);
    settle(&mut harness);
    assert_ne!(distance(&harness, RAW), straight);
    let at_key = |harness: &mut Harness<'_, Workbench>, timing| {
        harness.state_mut().session.blend.timing = timing;
        harness.state_mut().session.blend.go_to(0.5);
        harness.run_steps(2);
        settle(harness);
        distance(harness, RAW).unwrap()
    };
    let [even, straight] = [Timing::Even, Timing::Straight].map(|timing| at_key(&mut harness, timing));
    assert!((even - straight).abs() < 1e-3, "{even} {straight}");
}

#[test]
fn a_quality_moves_the_latent_sphere_and_no_other() {
    let methods = Methods(vec!["latent", "raw_weights"]);
    let mut harness = built_in(Session { methods, ..quick() });
    settle(&mut harness);
    let latent = Card::Method("latent");
    until(&mut harness, "qualities are measured", |bench| bench.gallery.measured(latent).is_some());
    let before = [latent, RAW].map(|card| distance(&harness, card));
    harness.state_mut().session.blend.edits[Axis::Lightness as usize] = 0.1;
    harness.run_steps(2);
    settle(&mut harness);
    let after = [latent, RAW].map(|card| distance(&harness, card));
    assert_ne!(before[0], after[0]);
    assert_eq!(before[1], after[1]);
    let measured = harness.state().gallery.measured(latent).unwrap();
    let moved = Axis::Lightness.difference(&measured.before, &measured.after);
    assert!((moved - 0.1).abs() < 0.03, "{moved}");
    harness.get_by_label("Reset qualities").click_accesskit();
    harness.run_steps(2);
    settle(&mut harness);
    assert_eq!(distance(&harness, latent), before[0]);
}

#[test]
fn beyond_the_ends_is_marked() {
    let mut harness = built_in(Session { strips: true, ..quick() });
    settle(&mut harness);
    assert!(harness.query_by_label("beyond the ends").is_none());
    harness.state_mut().session.blend.is_beyond = true;
    harness.state_mut().session.blend.go_to(1.25);
    harness.run_steps(2);
    assert!(harness.query_by_label("beyond the ends").is_some());
    assert!(harness.query_by_label("beyond").is_some(), "on the card");
    harness.get_by_label("Raw weights at -0.500, beyond the ends").click();
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.t, -0.5);
}

#[test]
fn a_kept_blend_comes_back_by_button_and_by_palette() {
    let mut harness = built_in(three(Way::Keys));
    let kept = harness.state().session.blend.clone();
    harness.run_steps(2);
    harness.get_by_label("Blends").click();
    harness.run_steps(3);
    harness.get_by_label("Keep").click();
    harness.run_steps(3);
    assert_eq!(harness.state().session.blends.len(), 1);
    harness.state_mut().session.blend = Blend::default();
    harness.run_steps(2);
    harness.get_by_label("Load gold-paint to chrome").click();
    harness.run_steps(3);
    assert_eq!(harness.state().session.blend, kept);
    harness.state_mut().session.blend = Blend::default();
    harness.key_press_modifiers(Modifiers { ctrl: true, command: true, ..Modifiers::NONE }, Key::P);
    harness.run_steps(3);
    harness.event(egui::Event::Text("load blend".to_owned()));
    harness.run_steps(2);
    harness.get_by_label_contains("Load blend gold-paint to chrome").click();
    harness.run_steps(3);
    assert_eq!(harness.state().session.blend, kept);
}
