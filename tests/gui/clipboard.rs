//! Codes and commands on the clipboard.

use std::sync::Arc;

use egui::{Event, OutputCommand};
use nbrdf::catalog::{Catalog, Reference};
use nbrdf::material::{self, parse_code};
use nbrdf_core::library::builtin;
use nbrdf_core::{Directions, Weights};

use super::*;

/// A key in a frame of its own, so that what the frame puts out is seen.
fn with_command_and_shift(key: Key) -> Event {
    let modifiers = Modifiers::COMMAND | Modifiers::SHIFT;
    Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }
}

/// What is put on the clipboard in the next frames.
fn copied(harness: &mut Harness<'_, Workbench>) -> String {
    let patience = Instant::now() + Duration::from_secs(120);
    loop {
        for command in &harness.output().platform_output.commands {
            if let OutputCommand::CopyText(text) = command {
                return text.clone();
            }
        }
        assert!(Instant::now() < patience, "nothing was copied: {:?}", harness.state().gallery.notices);
        std::thread::sleep(Duration::from_millis(5));
        harness.step();
    }
}

#[test]
fn a_copied_code_is_the_present_point_and_comes_back_when_pasted() {
    let mut harness = built_in(Session { methods: Methods(vec!["latent"]), ..quick() });
    settle(&mut harness);
    harness.event(with_command_and_shift(Key::C));
    let text = copied(&mut harness);
    let code = parse_code("clipboard", text.as_bytes()).unwrap();
    assert_eq!(code.code.len(), 32);
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let ends = ["gold-paint", "blue-acrylic"].map(|name| builtin::shared().get(name).unwrap().material());
    let point = catalog.interpolation("latent").unwrap().between(&ends).unwrap().at(&Weights::two(0.5)).unwrap();
    let decoded = material::decoded(&catalog, code, "clipboard").unwrap().material;
    let at = Directions::new(nbrdf_core::Vec3::new(0.6, 0.0, 0.8), nbrdf_core::Vec3::new(0.0, 0.6, 0.8));
    assert_eq!(decoded.brdf.eval(at), point.eval(at));
    let before = harness.state().gallery.names.len();
    harness.event(Event::Paste(text));
    harness.step();
    until(&mut harness, "the code is listed", |bench| bench.gallery.names.len() > before);
    let name = harness.state().gallery.names[before].clone();
    assert_eq!(name, "0.50 gold-paint + 0.50 blue-acrylic");
    harness.state_mut().session.blend.choose(0, &name);
    harness.run_steps(2);
    settle(&mut harness);
    assert!(harness.query_by_label("Sphere A: shown").is_some());
    harness.event(Event::Paste("no code".to_owned()));
    harness.step();
    until(&mut harness, "what is no code is a notice", |bench| {
        bench.gallery.notices.iter().any(|notice| notice.contains("expected a code"))
    });
}

#[test]
fn a_method_that_fails_hides_no_code_of_another() {
    let catalog = Catalog::new(Arc::new(Reference::built_in()));
    let interpolation = move |name: &str| {
        assert_ne!(name, "latent_even", "out of paint");
        catalog.interpolation(name)
    };
    let stock = Stock { interpolation: Box::new(interpolation), ..Stock::built_in() };
    let session = Session { methods: Methods(vec!["latent_even", "latent"]), ..quick() };
    let mut harness = open(stock, session, [1200.0, 800.0]);
    harness.run_steps(2);
    harness.event(with_command_and_shift(Key::C));
    let code = parse_code("clipboard", copied(&mut harness).as_bytes()).unwrap();
    assert_eq!(code.code.len(), 32);
}

#[test]
fn the_command_is_copied() {
    let mut harness = built_in(quick());
    harness.run_steps(2);
    harness.event(with_command_and_shift(Key::X));
    let text = copied(&mut harness);
    assert!(text.starts_with("nbrdf blend gold-paint blue-acrylic --at=0.5 --method=raw_weights"), "{text}");
}
