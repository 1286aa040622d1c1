//! Two spheres in one large picture, and the picked point.

use egui::{Event, OutputCommand, PointerButton, Pos2, vec2};
use nbrdf::gui::pane::Pane;
use nbrdf::gui::session::{Compare, Mode, Pair};
use nbrdf::worker::{Asset, Point};
use nbrdf_core::render::{Light, Model, Place};

use super::*;

const METHOD: Card = Card::Method("raw_weights");

fn in_mode(mode: Mode, cards: [Card; 2]) -> Session {
    Session { compare: Compare { mode, pair: Pair(cards), ..Compare::default() }, ..quick() }
}

/// Presses at one place, moves to another, lets go.
fn drag(harness: &mut Harness<'_, Workbench>, from: Pos2, to: Pos2, modifiers: Modifiers) {
    let button = |pos, pressed| Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers };
    harness.hover_at(from);
    harness.event(Event::ModifiersChanged(modifiers));
    harness.event(button(from, true));
    harness.hover_at(to);
    harness.event(button(to, false));
    harness.event(Event::ModifiersChanged(Modifiers::NONE));
    harness.run_steps(2);
}

fn undo(harness: &mut Harness<'_, Workbench>) {
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
}

#[test]
fn modes_are_chosen_by_key_and_by_button() {
    let mut harness = built_in(quick());
    settle(&mut harness);
    harness.key_press(Key::Num2);
    harness.run_steps(2);
    settle(&mut harness);
    assert_eq!(harness.state().session.compare.mode, Mode::Swipe);
    assert!(harness.query_by_label("Swipe, A gold-paint: shown, Raw weights: shown").is_some());
    assert!(harness.query_by_label("Sphere A: shown").is_none(), "one picture alone");
    for mode in [Mode::Flicker, Mode::Difference, Mode::SideBySide] {
        harness.get_by_role_and_label(Role::Button, mode.title()).click();
        harness.run_steps(2);
        assert_eq!(harness.state().session.compare.mode, mode);
    }
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere A: shown").is_some());
}

#[test]
fn any_two_cards_can_be_chosen() {
    let mut harness = built_in(in_mode(Mode::Swipe, [Card::End(0), METHOD]));
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::ComboBox, "Right").click();
    harness.run_steps(2);
    harness.get_by_label("B blue-acrylic").click();
    harness.run_steps(2);
    assert_eq!(harness.state().session.compare.pair, Pair([Card::End(0), Card::End(1)]));
}

#[test]
fn the_divider_moves_by_keys_and_by_dragging_and_comes_back() {
    let mut harness = built_in(in_mode(Mode::Swipe, [Card::End(0), METHOD]));
    let divider = |harness: &Harness<'_, Workbench>| harness.state().session.compare.divider;
    settle(&mut harness);
    let place = harness.get_by_label("Divider").rect().center();
    drag(&mut harness, place, place + vec2(40.0, 0.0), Modifiers::NONE);
    let dragged = divider(&harness);
    assert!(dragged > 0.52, "{dragged}");
    assert_eq!(harness.state().session.look, Look::default(), "the light stays");
    harness.get_by_label("Divider").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(2);
    assert!(divider(&harness) < dragged);
    assert_eq!(harness.state().session.blend.t, 0.5, "the arrows are the divider's");
    undo(&mut harness);
    assert_eq!(divider(&harness), dragged);
    undo(&mut harness);
    assert_eq!(divider(&harness), 0.5);
}

#[test]
fn dragging_a_large_picture_moves_the_light() {
    for mode in [Mode::Swipe, Mode::Difference, Mode::Flicker] {
        let mut harness = built_in(in_mode(mode, [Card::End(0), METHOD]));
        settle(&mut harness);
        let picture = harness.get_by(|node| {
            let label = node.label().unwrap_or_default();
            ["Swipe, ", "Difference of", "Flicker, "].iter().any(|start| label.starts_with(start))
        });
        let (from, across) = (picture.rect().center() + vec2(60.0, 30.0), vec2(10.0, 0.0));
        drag(&mut harness, from, from + across, Modifiers::NONE);
        let highlight = harness.state().session.look.highlight();
        assert!(highlight.is_some_and(|[x, y]| x > 0.0 && y < 0.0), "{mode:?}: {highlight:?}");
    }
}

#[test]
fn a_card_does_not_differ_from_itself_and_two_ends_do() {
    let mut harness = built_in(in_mode(Mode::Difference, [Card::End(0); 2]));
    settle(&mut harness);
    let largest = |harness: &Harness<'_, Workbench>| harness.state().gallery.heat.as_ref().map(|heat| heat.largest);
    assert_eq!(largest(&harness), Some(0.0));
    harness.state_mut().session.compare.pair = Pair([Card::End(0), Card::End(1)]);
    harness.run_steps(2);
    settle(&mut harness);
    let heat = harness.state().gallery.heat.as_ref().unwrap();
    assert!(heat.largest > 10.0 && heat.mean > 1.0 && heat.mean < heat.largest, "{} {}", heat.mean, heat.largest);
    assert!(f32::from(heat.top) >= heat.largest, "the scale fits");
    assert!(heat.texture.size()[0] > 200, "in the large size: {:?}", heat.texture.size());
    let scale = format!("Scale from 0 to {} ΔE_ITP", heat.top);
    assert!(harness.query_by_label(&scale).is_some());
}

#[test]
fn only_the_two_that_are_compared_are_large() {
    let mut harness = built_in(in_mode(Mode::Flicker, [Card::End(0), METHOD]));
    settle(&mut harness);
    let size = |card| {
        let view = harness.state().gallery.view(card).unwrap();
        view.texture.as_ref().unwrap().size()[0]
    };
    assert!(size(Card::End(0)) > 200 && size(METHOD) > 200, "{} {}", size(Card::End(0)), size(METHOD));
    assert!(size(Card::End(1)) <= 128, "{}", size(Card::End(1)));
}

#[test]
fn while_its_key_is_held_the_second_is_shown() {
    let mut harness = built_in(in_mode(Mode::Flicker, [Card::End(0), METHOD]));
    settle(&mut harness);
    assert!(harness.query_by_label("Flicker, A gold-paint: shown").is_some());
    harness.key_down(Key::C);
    harness.run_steps(2);
    assert!(harness.query_by_label("Flicker, Raw weights: shown").is_some());
    harness.key_up(Key::C);
    harness.run_steps(2);
    assert!(harness.query_by_label("Flicker, A gold-paint: shown").is_some());
}

/// Picks a place of the first sphere and waits for what there is.
fn picked(harness: &mut Harness<'_, Workbench>) -> Point {
    let sphere = harness.get_by_label("Sphere A: shown").rect();
    let at = sphere.center() + 0.25 * sphere.width() * vec2(0.6, -0.8);
    drag(harness, at, at, Modifiers::ALT);
    let [x, y] = harness.state().session.pick.at.unwrap();
    assert!((x - 0.3).abs() < 0.02 && (y - 0.4).abs() < 0.02, "{x} {y}");
    until(harness, "the point is known", |bench| {
        bench.gallery.point.as_ref().is_some_and(|point| point.readings.iter().all(|(_, reading)| reading.is_ok()))
    });
    harness.state().gallery.point.clone().unwrap()
}

#[test]
fn a_picked_point_lists_every_card_as_evaluated_directly() {
    let mut harness = built_in(quick());
    settle(&mut harness);
    let point = picked(&mut harness);
    assert_eq!(harness.state().session.look, Look::default(), "picking does not move the light");
    let cards: Vec<_> = point.readings.iter().map(|(card, _)| *card).collect();
    assert!([Card::End(0), Card::End(1), METHOD].iter().all(|card| cards.contains(card)), "{cards:?}");
    assert!(point.lamps.len() > 3);
    for (card, reading) in &point.readings {
        let reading = reading.as_ref().unwrap();
        assert_eq!(reading.values.len(), point.lamps.len());
        assert!(reading.values.iter().all(|value| value.is_finite()) && reading.radiance.unwrap().is_finite());
        assert!(reading.radiance.unwrap().max() > 0.0, "{card:?}");
    }
    let stock = Stock::built_in();
    let gold = stock.materials.iter().find(|material| material.name == "gold-paint").unwrap();
    let (place, light) = (Place::on(&Model::Sphere, point.at).unwrap(), Light::studio());
    let (_, reading) = point.readings.iter().find(|(card, _)| *card == Card::End(0)).unwrap();
    for (lamp, value) in point.lamps.iter().zip(&reading.as_ref().unwrap().values) {
        let expected = gold.brdf.eval(place.under(light.lamps[lamp.lamp].direction));
        assert_eq!(*value, expected);
    }
}

#[test]
fn a_picked_point_is_copied_and_undone() {
    let mut harness = built_in(quick());
    settle(&mut harness);
    assert!(harness.query_by_label("Copy table").is_none());
    let point = picked(&mut harness);
    harness.run_steps(2);
    harness.get_by_label("Copy table").click();
    harness.step();
    let copied = harness.output().platform_output.commands.iter().find_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let lines: Vec<_> = copied.as_deref().unwrap().lines().map(|line| line.split('\t').count()).collect();
    assert_eq!(lines, vec![18; 1 + 3 * point.lamps.len()]);
    undo(&mut harness);
    assert_eq!(harness.state().session.pick.at, None);
}

#[test]
fn with_the_tool_a_drag_picks_and_without_it_the_light_moves() {
    let mut harness = built_in(quick());
    settle(&mut harness);
    harness.key_press(Key::P);
    harness.run_steps(2);
    assert!(harness.query_by_label("Click on a sphere.").is_some(), "the pane comes to the front");
    let middle = harness.get_by_label("Sphere A: shown").rect().center();
    drag(&mut harness, middle, middle + vec2(10.0, 0.0), Modifiers::NONE);
    assert!(harness.state().session.pick.at.is_some());
    assert_eq!(harness.state().session.look, Look::default());
    harness.key_press(Key::P);
    harness.run_steps(2);
    drag(&mut harness, middle, middle + vec2(10.0, 0.0), Modifiers::NONE);
    assert_ne!(harness.state().session.look, Look::default());
}

#[test]
fn under_a_map_the_point_has_the_mirrored_view_and_the_pixels_radiance() {
    let around = Lighting::Around { map: Asset::BuiltIn, turn: 0.0 };
    let mut harness = open(Stock::built_in(), Session { look: under(around), ..quick() }, [900.0, 600.0]);
    until(&mut harness, "there is a picture", |bench| {
        bench.gallery.view(METHOD).is_some_and(|view| view.texture.is_some())
    });
    harness.state_mut().bring(Pane::Point);
    harness.state_mut().session.pick.put([0.1, 0.2]);
    until(&mut harness, "the radiance is known", |bench| {
        let readings = bench.gallery.point.iter().flat_map(|point| &point.readings);
        let known = readings.filter(|(_, reading)| reading.as_ref().is_ok_and(|reading| reading.radiance.is_some()));
        known.count() == 3
    });
    let lamps = &harness.state().gallery.point.as_ref().unwrap().lamps;
    let at = lamps[0].directions;
    assert!(lamps.len() == 1 && (at.light.z - at.view.z).abs() < 1e-6, "{at:?}");
}
