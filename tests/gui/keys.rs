//! Every part of the window can be reached and used by keys.

use nbrdf::gui::pane::Pane;

use super::*;

fn focused(harness: &mut Harness<'_, Workbench>, label: &str) {
    harness.get_by_label(label).focus();
    harness.run_steps(2);
}

fn press(harness: &mut Harness<'_, Workbench>, key: Key) {
    harness.key_press(key);
    harness.run_steps(3);
}

#[test]
fn every_pane_is_entered_by_keys_one_after_the_other() {
    let mut harness = built_in(quick());
    harness.run_steps(2);
    for pane in Pane::ALL.into_iter().chain([Pane::ALL[0]]) {
        press(&mut harness, Key::F6);
        let label = format!("{} pane", pane.title());
        assert!(harness.get_by_label(&label).is_focused(), "{label}");
    }
    harness.key_press_modifiers(Modifiers::SHIFT, Key::F6);
    harness.run_steps(3);
    assert!(harness.get_by_label("Point pane").is_focused());
}

#[test]
fn a_material_in_focus_goes_to_any_slot_by_its_letter_and_becomes_a_favourite() {
    let mut harness = built_in(quick());
    harness.state_mut().session.listing.search = "chrome".to_owned();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::ListItem, "chrome").focus();
    harness.run_steps(2);
    let (beyond, strips) = (harness.state().session.blend.is_beyond, harness.state().session.strips);
    [Key::B, Key::C, Key::D, Key::E, Key::F].into_iter().for_each(|key| press(&mut harness, key));
    press(&mut harness, Key::S);
    let session = &harness.state().session;
    assert_eq!(session.blend.slots_of("chrome"), [1, 2, 3, 4, 5]);
    assert_eq!((session.blend.is_beyond, session.strips), (beyond, strips), "letters are the material's");
    assert!(session.listing.favourites.contains("chrome"));
}

#[test]
fn slots_are_moved_and_taken_out_by_keys() {
    let mut harness = built_in(quick());
    harness.state_mut().session.blend.choose(2, "chrome");
    harness.run_steps(2);
    focused(&mut harness, "Slot A: gold-paint");
    press(&mut harness, Key::ArrowRight);
    press(&mut harness, Key::ArrowRight);
    assert_eq!(harness.state().session.blend.ends, ["blue-acrylic", "chrome", "gold-paint"]);
    assert!(harness.get_by_label("Slot C: gold-paint").is_focused());
    press(&mut harness, Key::Delete);
    assert_eq!(harness.state().session.blend.ends, ["blue-acrylic", "chrome"]);
}

#[test]
fn light_point_and_zoom_of_a_sphere_are_moved_by_keys() {
    let mut harness = built_in(quick());
    settle(&mut harness);
    focused(&mut harness, "Sphere A: shown");
    press(&mut harness, Key::ArrowRight);
    let light = harness.state().session.look.highlight().unwrap();
    assert!((light[0] - 0.05).abs() < 1e-4 && light[1].abs() < 1e-4, "{light:?}");
    press(&mut harness, Key::P);
    press(&mut harness, Key::ArrowUp);
    assert_eq!(harness.state().session.pick.at, Some([0.0, 0.05]));
    press(&mut harness, Key::PageUp);
    assert!(harness.state().session.look.scenery.frame.zoom > 1.4);
    press(&mut harness, Key::Home);
    assert_eq!(harness.state().session.look.scenery.frame.zoom, 1.0);
}
