//! The latent map.

use egui::{Event, MouseWheelUnit, Vec2, vec2};
use nbrdf::gui::action::Action;
use nbrdf::gui::pane::Pane;
use nbrdf::gui::session::{MapView, Tint};
use nbrdf::worker::{Explored, Projection};
use nbrdf_core::axis::Axis;
use nbrdf_core::library::builtin;

use super::*;

/// A map of a few materials, the ends among them.
fn mapped(session: Session) -> Harness<'static, Workbench> {
    let mut stock = Stock::built_in();
    let is_one = |name: &str| ["gold-paint", "blue-acrylic", "chrome", "rgl/paper_white"].contains(&name);
    let mut place = 0;
    stock.materials.retain(|material| {
        place += 1;
        place % 10 == 1 || is_one(&material.name)
    });
    let projection = session.map.projection;
    let mut harness = open(stock, session, [1200.0, 800.0]);
    harness.state_mut().bring(Pane::Map);
    let is_drawn = |bench: &Workbench| bench.gallery.atlas.track(projection).is_some();
    until(&mut harness, "the map is drawn", is_drawn);
    harness.run_steps(2);
    harness
}

fn place(bench: &Workbench, projection: Projection, name: &str) -> Option<[f32; 2]> {
    bench.gallery.atlas.spots(projection).iter().find(|spot| spot.name == name).map(|spot| spot.at)
}

#[test]
fn a_click_on_the_map_is_for_a_and_the_key_b_for_b() {
    let mut harness = mapped(quick());
    harness.get_by_label("chrome on the map").click_accesskit();
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.ends, ["chrome", "blue-acrylic"]);
    harness.get_by_label("rgl/paper_white on the map").focus();
    harness.run_steps(2);
    harness.key_press(Key::B);
    harness.run_steps(2);
    assert_eq!(harness.state().session.blend.ends, ["chrome", "rgl/paper_white"]);
}

#[test]
fn the_path_runs_from_one_end_to_the_other_and_the_dot_follows_t() {
    let mut harness = mapped(quick());
    let here = |bench: &Workbench| bench.gallery.atlas.track(Projection::Pca).map(|track| track.courses[0].here);
    let ends = ["gold-paint", "blue-acrylic"].map(|end| place(harness.state(), Projection::Pca, end).unwrap());
    let away = |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let curve = harness.state().gallery.atlas.track(Projection::Pca).unwrap().courses[0].curve.clone();
    let length = away(ends[0], ends[1]);
    assert!(away(curve[0].1, ends[0]) < 0.01 * length && away(curve.last().unwrap().1, ends[1]) < 0.01 * length);
    harness.state_mut().session.blend.go_to(1.0);
    until(&mut harness, "the dot is at B", |bench| here(bench).is_some_and(|here| away(here, ends[1]) < 0.01 * length));
}

#[test]
fn colours_have_a_bar_with_figures() {
    let mut harness = mapped(quick());
    assert!(harness.query_by_label_contains("Gloss from").is_none());
    harness.state_mut().session.map.tint = Tint::Quality(Axis::Gloss);
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("Gloss from 0.").is_some());
    harness.state_mut().session.map.tint = Tint::Error;
    harness.run_steps(2);
    assert!(harness.query_by_label_contains("Encoding error from 0.00").is_some());
    assert!(harness.query_by_label_contains("Gloss from").is_none());
}

#[test]
fn dragging_the_dot_explores_as_one_step_and_escape_ends_it() {
    let mut harness = mapped(quick());
    settle(&mut harness);
    let from = harness.get_by_label("Present place on the map").rect().center();
    harness.hover_at(from);
    harness.step();
    harness.drag_at(from);
    harness.step();
    for step in 1..=4 {
        harness.hover_at(from + vec2(12.0, 5.0) * step as f32);
        harness.step();
    }
    harness.drop_at(from + vec2(48.0, 20.0));
    harness.run_steps(2);
    assert!(harness.state().session.explored.is_some());
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere explored: shown").is_some());
    let is_judged = |bench: &Workbench| bench.gallery.atlas.explored().0.is_some();
    until(&mut harness, "the distance is known", is_judged);
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    assert_eq!(harness.state().session.explored, None);
    assert!(harness.query_by_label("Sphere explored: shown").is_none());
    let context = harness.ctx.clone();
    harness.state_mut().act(Action::Undo, &context);
    assert!(harness.state().session.explored.is_some(), "ending is a step");
    harness.state_mut().act(Action::Undo, &context);
    assert_eq!(harness.state().session.explored, None, "the whole drag is one step");
}

#[test]
fn a_material_is_found_again_at_its_own_place_and_far_away_is_a_warning() {
    let mut harness = mapped(quick());
    let at = place(harness.state(), Projection::Pca, "chrome").unwrap();
    let explored = |place| Some(Explored { projection: Projection::Pca, place });
    harness.state_mut().session.explored = explored(at);
    let own = harness.state().gallery.atlas.spots(Projection::Pca).iter().find(|spot| spot.name == "chrome").cloned();
    let own = own.and_then(|spot| spot.distance).unwrap();
    let is_own = |bench: &Workbench| bench.gallery.atlas.explored().0.is_some_and(|found| (found - own).abs() < 1e-2);
    until(&mut harness, "the code is that of chrome", is_own);
    assert_eq!(harness.state().gallery.atlas.explored().1, None);
    harness.state_mut().session.explored = explored([1e3, 1e3]);
    until(&mut harness, "there is a warning", |bench| bench.gallery.atlas.explored().1.is_some());
    assert!(harness.query_by_label_contains("Explored: ").is_some());
}

#[test]
fn an_opened_material_gets_a_place_beside_its_like() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.npz");
    let network = &builtin::shared().get("gold-paint").unwrap().network;
    std::fs::write(&path, npy::write_npz(network)).unwrap();
    let mut harness = mapped(quick());
    assert_eq!(place(harness.state(), Projection::Pca, "mine"), None);
    harness.state().open(path);
    until(&mut harness, "it has a place", |bench| place(bench, Projection::Pca, "mine").is_some());
    let [own, like] = ["mine", "gold-paint"].map(|name| place(harness.state(), Projection::Pca, name).unwrap());
    assert!((own[0] - like[0]).hypot(own[1] - like[1]) < 0.01, "{own:?} {like:?}");
    assert!(harness.query_by_label("mine on the map").is_some());
}

#[test]
fn charting_places_every_material_and_what_lies_between() {
    let map = MapView { projection: Projection::Charting, ..MapView::default() };
    let mut harness = mapped(Session { map, ..quick() });
    let bench = harness.state();
    let spots = bench.gallery.atlas.spots(Projection::Charting);
    assert_eq!(spots.len(), bench.gallery.names.len(), "{:?}", bench.gallery.notices);
    assert!(spots.iter().all(|spot| spot.at.iter().all(|v| v.is_finite())));
    let explored = spots[0].at.map(|v| 0.9 * v);
    harness.state_mut().session.explored = Some(Explored { projection: Projection::Charting, place: explored });
    harness.run_steps(2);
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere explored: shown").is_some());
}

#[test]
fn the_wheel_enlarges_about_the_pointer_and_the_button_shows_everything_again() {
    let mut harness = mapped(quick());
    let rect = harness.get_by_label("Latent map").rect();
    harness.hover_at(rect.left_top() + vec2(30.0, 30.0));
    harness.step();
    harness.event(Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: Vec2::new(0.0, 120.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    harness.run_steps(20);
    let MapView { zoom, centre, .. } = harness.state().session.map;
    assert!(zoom > 1.2 && centre[0] < 0.0 && centre[1] > 0.0, "{zoom} {centre:?}");
    harness.get_by_label("Whole map").click();
    harness.run_steps(2);
    assert_eq!(harness.state().session.map, MapView::default());
}
