//! What the materials are seen on: shapes, zoom, tone curves.

use nbrdf::worker::{Asset, Shape};
use nbrdf_core::image::Tone;
use nbrdf_core::render::Frame;

use super::*;

fn on(shape: Shape, lighting: Lighting) -> Session {
    let mut look = under(lighting);
    look.show_on(shape);
    Session { look, ..quick() }
}

fn small(session: Session) -> Harness<'static, Workbench> {
    open(Stock::built_in(), session, [900.0, 600.0])
}

fn figures(harness: &Harness<'_, Workbench>) -> Option<nbrdf::worker::Figures> {
    harness.state().gallery.view(Card::Method("raw_weights")).and_then(|view| view.figures)
}

#[test]
fn figures_are_those_of_the_sphere_whatever_is_shown() {
    let mut harness = small(quick());
    settle(&mut harness);
    let on_sphere = figures(&harness);
    assert!(on_sphere.is_some());
    let look = &mut harness.state_mut().session.look;
    look.show_on(Shape::Mesh(Asset::BuiltIn));
    look.scenery.frame = Frame::WHOLE.zoomed(2.0, [0.3, 0.1]);
    look.tone = Tone::Filmic;
    settle(&mut harness);
    assert_eq!(figures(&harness), on_sphere);
    assert!(harness.query_by_label("Sphere raw_weights: shown").is_some());
}

#[test]
fn every_shape_is_shown_under_a_map() {
    for shape in [Shape::Plane, Shape::Mesh(Asset::BuiltIn)] {
        let session = on(shape, Lighting::Around { map: Asset::BuiltIn, turn: 0.0 });
        let mut harness = open(Stock::built_in(), session, [640.0, 480.0]);
        settle(&mut harness);
        assert!(harness.query_by_label("Sphere A: shown").is_some(), "{shape:?}");
    }
}

#[test]
fn a_mesh_that_is_opened_is_shown_and_one_that_is_none_is_a_notice() {
    let folder = tempfile::tempdir().unwrap();
    let seeds = concat!(env!("CARGO_MANIFEST_DIR"), "/../fuzz/seeds");
    for (name, seed) in [("square.gltf", "gltf/square"), ("square.glb", "gltf/binary"), ("cube.obj", "obj/cube")] {
        std::fs::copy(format!("{seeds}/{seed}"), folder.path().join(name)).unwrap();
    }
    std::fs::write(folder.path().join("none.glb"), b"glTF").unwrap();
    let mut harness = small(quick());
    for (count, name) in [(2, "square.gltf"), (3, "square.glb"), (4, "cube.obj")] {
        let path = folder.path().join(name);
        harness.state().open(path.clone());
        until(&mut harness, "the mesh is listed", |bench| bench.gallery.meshes.len() == count);
        assert_eq!(harness.state().session.look.scenery.shape, Shape::Mesh(Asset::of_file(&path)));
    }
    settle(&mut harness);
    harness.state().open(folder.path().join("none.glb"));
    until(&mut harness, "there is a notice", |bench| !bench.gallery.notices.is_empty());
    assert!(harness.state().gallery.notices[0].contains("none.glb"), "{:?}", harness.state().gallery.notices);
}

#[test]
fn the_wheel_zooms_about_the_pointer_and_a_double_click_shows_all_again() {
    let mut harness = small(quick());
    settle(&mut harness);
    let rect = harness.get_by_label("Sphere A: shown").rect();
    let pointer = rect.center() + egui::vec2(0.25 * rect.width(), 0.0);
    harness.event(egui::Event::PointerMoved(pointer));
    harness.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Point,
        delta: egui::vec2(0.0, 240.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    harness.run_steps(20);
    let frame = harness.state().session.look.scenery.frame;
    assert!(frame.zoom > 1.2 && (frame.place([0.5, 0.0])[0] - 0.5).abs() < 1e-3, "{frame:?}");
    // A step of the harness is a quarter of a second.
    harness.ctx.options_mut(|options| options.input_options.max_double_click_delay = 10.0);
    for is_down in [true, false, true, false] {
        let button = egui::PointerButton::Primary;
        harness.event(egui::Event::PointerButton {
            pos: pointer,
            button,
            pressed: is_down,
            modifiers: Modifiers::NONE,
        });
        harness.step();
    }
    harness.run_steps(2);
    assert_eq!(harness.state().session.look.scenery.frame, Frame::WHOLE);
}
