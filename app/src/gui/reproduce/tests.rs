//! Commands are accepted, and say what they leave out.

use nbrdf_core::image::Tone;
use nbrdf_core::render::Frame;

use super::*;
use crate::cli::Cli;
use crate::gui::session::{LAMP, Methods, Way};
use crate::worker::{Asset, Explored, Lighting, Projection, Shape, Timing};

/// Words as a shell makes them of what the line quotes.
fn words(text: &str) -> Vec<String> {
    let (mut words, mut word, mut is_quoted) = (Vec::new(), String::new(), false);
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\'' => is_quoted = !is_quoted,
            '\\' if !is_quoted => word.extend(letters.next()),
            ' ' if !is_quoted => words.push(std::mem::take(&mut word)),
            '#' if !is_quoted && word.is_empty() => return words,
            other => word.push(other),
        }
    }
    words.push(word);
    words
}

fn accepted(text: &str) -> String {
    let words = words(text);
    format!("{:?}", Cli::of(&words).unwrap_or_else(|error| panic!("{text}: {error}")))
}

#[test]
fn the_command_of_the_first_state_is_short_and_accepted() {
    let text = command(&Session::default());
    let wanted = "nbrdf blend gold-paint blue-acrylic --at=0.5 --method=latent --method=raw_weights \
                  --method=pca_tables --light=studio --size=128 --output=blend.png";
    assert_eq!(text, wanted);
    accepted(&text);
}

#[test]
fn odd_names_and_places_are_quoted_and_what_cannot_be_said_is_a_remark() {
    let mut session = Session { methods: Methods(Vec::new()), ..Session::default() };
    session.blend.choose(0, "-it's; rm\n$(x)");
    session.blend.is_beyond = true;
    session.blend.go_to(-0.25);
    session.blend.timing = Timing::Even;
    session.look.exposure = -0.5;
    session.look.scenery.lighting = Lighting::Around { map: Asset::of_file("/maps/room.exr".as_ref()), turn: 0.5 };
    let text = command(&session);
    let parsed = accepted(&text);
    assert!(parsed.contains(r#"-it's; rm\n$(x)"#) && parsed.contains("exposure: -0.5"), "{parsed}");
    assert!(parsed.contains(r#"at: ["-0.25"]"#), "{parsed}");
    let remarks = text.rsplit_once(" # ").unwrap().1;
    assert!(["all around", "even timing", "name the file", "all of them"].iter().all(|say| remarks.contains(say)));
    assert!(!remarks.contains(['\n', ';', '$', '`', '\'']), "{remarks}");
}

#[test]
fn several_ends_have_weights() {
    let mut session = Session::default();
    session.blend.choose(2, "chrome");
    session.blend.way = Way::Polygon;
    let parsed = accepted(&command(&session));
    assert_eq!(parsed.matches("0.3333").count(), 3, "{parsed}");
}

#[test]
fn every_export_has_a_command_that_is_accepted() {
    let mut session = Session::default();
    for what in What::ALL {
        for card in ["A", "latent"] {
            for turn in [None, Some(0.5)] {
                session.export.what = what;
                session.export.card = card.to_owned();
                let around = turn.map(|turn| Lighting::Around { map: Asset::BuiltIn, turn });
                session.look.scenery.lighting = around.unwrap_or(LAMP);
                accepted(&export(&session, &session.goods().unwrap()).unwrap());
            }
        }
    }
}

#[test]
fn an_explored_card_has_no_command_and_is_left_out_of_others() {
    let explored = Explored { projection: Projection::ALL[0], place: [0.5, -0.25] };
    let mut session = Session { explored: Some(explored), ..Session::default() };
    assert!(command(&session).contains(EXPLORED));
    session.export.card = "explored".to_owned();
    for what in [What::Material, What::Picture] {
        session.export.what = what;
        assert_eq!(export(&session, &session.goods().unwrap()), Err(EXPLORED.to_owned()));
    }
}

#[test]
fn shape_zoom_and_tone_curve_are_remarks_of_pictures() {
    let mut session = Session::default();
    session.look.show_on(Shape::Plane);
    session.look.scenery.frame = Frame::WHOLE.zoomed(2.0, [0.0; 2]);
    session.look.tone = Tone::Filmic;
    let says = |text: &str| ["plane", "zoomed 2.00 times", "Filmic"].map(|remark| text.contains(remark));
    assert_eq!(says(&command(&session)), [true; 3]);
    let mut of = |what, form| {
        (session.export.what, session.export.picture) = (what, form);
        says(&export(&session, &session.goods().unwrap()).unwrap())
    };
    assert_eq!(of(What::Picture, PictureForm::Exr), [true, true, false], "linear");
    assert_eq!(of(What::Strip, PictureForm::Png), [true, false, true], "whole");
    assert_eq!(of(What::Curve, PictureForm::Png), [false; 3]);
}

#[test]
fn ways_that_are_not_those_of_the_command_are_remarks() {
    let mut session = Session::default();
    session.export.what = What::Strip;
    let text = |session: &Session| export(session, &session.goods().unwrap()).unwrap();
    session.blend.is_beyond = true;
    assert!(text(&session).contains("from -0.5 to 1.5"));
    session.blend.choose(2, "chrome");
    session.blend.is_beyond = false;
    session.blend.timing = Timing::Even;
    assert!(text(&session).contains("straight timing") && command(&session).contains("straight timing"));
    session.blend.way = Way::Polygon;
    assert!(text(&session).contains("around the polygon") && !text(&session).contains("timing"));
}
