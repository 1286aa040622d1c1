//! The present state as a line for the shell.

use nbrdf_core::axis::Axis;
use nbrdf_core::image::Tone;
use nbrdf_core::library::builtin;
use nbrdf_core::render::Frame;

use super::Session;
use super::session::{LAMP, What};
use crate::worker::export::{Goods, PictureForm, SAMPLES};
use crate::worker::{Card, Lighting, Shape, Timing, Tour};

/// What is said of an explored card.
const EXPLORED: &str = "a place of the latent map has no command";

/// A line for the shell, and what it cannot say.
#[derive(Default)]
struct Line {
    words: Vec<String>,
    remarks: Vec<String>,
}

/// The command that draws what the window shows.
pub fn command(session: &Session) -> String {
    let methods = &session.methods.0;
    let mut line = blend(session, At::Here, methods, 128, "blend.png");
    if methods.is_empty() {
        line.remarks.push("without a method, all of them are drawn".to_owned());
    }
    if session.explored.is_some() {
        line.remarks.push(format!("left out: {EXPLORED}"));
    }
    line.seen(session, At::Here, PictureForm::Png);
    line.text()
}

/// The command that makes what is written to files, or comes near it.
///
/// # Errors
/// Why there is none.
pub fn export(session: &Session, goods: &Goods) -> Result<String, String> {
    let name = session.export_name();
    let picture = |form: PictureForm| format!("{name}.{}", form.extension());
    let mut line = match *goods {
        Goods::Picture { card: Card::End(end), form, size } => render(session, end, size, &picture(form)),
        Goods::Picture { card: Card::Method(method), form, size } => {
            let mut line = blend(session, At::Here, &[method], size, &picture(form));
            if form == PictureForm::Png {
                line.remarks.push("its PNG has labels".to_owned());
            }
            line
        }
        Goods::Material { card: Card::Explored, .. } | Goods::Picture { card: Card::Explored, .. } => {
            return Err(EXPLORED.to_owned());
        }
        Goods::Strip { form, size, steps } => {
            blend(session, At::Steps(steps), &session.methods.0, size, &picture(form))
        }
        Goods::Material { card: Card::End(end), .. } => render(session, end, 512, &picture(PictureForm::Png)),
        Goods::Material { card: Card::Method(method), .. } => {
            blend(session, At::Here, &[method], 128, &picture(PictureForm::Png))
        }
        Goods::Steps { method, steps, .. } => {
            blend(session, At::Steps(steps), &[method], 128, &picture(PictureForm::Png))
        }
        Goods::Curve { steps } => blend(session, At::Steps(steps), &session.methods.0, 128, &picture(PictureForm::Png)),
    };
    let what = session.export.what;
    if !matches!(what, What::Picture | What::Strip) {
        line.remarks
            .insert(0, format!("a picture of it, the command line writes no {}", what.about()[0].to_lowercase()));
    }
    match *goods {
        Goods::Picture { form, .. } => line.seen(session, At::Here, form),
        Goods::Strip { form, steps, .. } => line.seen(session, At::Steps(steps), form),
        // Materials and figures are the same however they are looked at.
        Goods::Material { .. } | Goods::Steps { .. } | Goods::Curve { .. } => {}
    }
    Ok(line.text())
}

/// Where on the path.
#[derive(Clone, Copy)]
enum At {
    Here,
    Steps(u16),
}

fn blend(session: &Session, at: At, methods: &[&str], size: u16, output: &str) -> Line {
    let blend = &session.blend;
    let mut line = Line::default();
    line.say("blend");
    let mut options = Line::default();
    match at {
        At::Steps(steps) => options.option("steps", steps),
        At::Here if blend.ends.len() == 2 => options.option("at", blend.t),
        At::Here => {
            let weights: Vec<String> = blend.weights().as_slice().iter().map(f32::to_string).collect();
            options.option("at", weights.join(","));
        }
    }
    methods.iter().for_each(|method| options.option("method", method));
    match session.look.scenery.lighting {
        lighting @ (Lighting::Studio | Lighting::Point(_)) => options.lamps(lighting),
        Lighting::Around { .. } => {
            options.option("light", "studio");
            options.remarks.push("light from all around: see nbrdf render --environment".to_owned());
        }
    }
    options.remarks.extend(walked(session, at));
    options.picture(session, size, output);
    line.with_materials(&blend.ends, options)
}

/// What the command cannot say of the way between the ends.
fn walked(session: &Session, at: At) -> Vec<String> {
    let blend = &session.blend;
    let mut remarks = Vec::new();
    match (blend.timing, blend.ends.len()) {
        (Timing::Even, 2) => remarks.push("even timing: see latent_even".to_owned()),
        (Timing::Even, _) if !blend.is_polygon() => {
            remarks.push("even timing between more than two materials: the command keeps straight timing".to_owned());
        }
        (Timing::Even | Timing::Straight, _) => {}
    }
    match (at, blend.tour()) {
        (At::Steps(_), Tour::Around) => {
            remarks.push("steps around the polygon: the command goes along a smooth curve".to_owned());
        }
        (At::Steps(_), Tour::Beyond) => {
            remarks.push("steps from -0.5 to 1.5: the command goes from 0 to 1".to_owned());
        }
        // What lies along a path is not edited.
        (At::Steps(_), Tour::Along) => {}
        (At::Here, _) => {
            let edits = Axis::ALL.iter().zip(blend.edits).filter(|(_, amount)| *amount != 0.0);
            let edits: Vec<String> = edits.map(|(axis, amount)| format!("{} by {amount}", axis.name())).collect();
            if !edits.is_empty() {
                remarks.push(format!("edited: see nbrdf edit, {}", edits.join(" ")));
            }
        }
    }
    remarks
}

fn render(session: &Session, end: usize, size: u16, output: &str) -> Line {
    let mut line = Line::default();
    line.say("render");
    let mut options = Line::default();
    match session.look.scenery.lighting {
        lighting @ (Lighting::Studio | Lighting::Point(_)) => options.lamps(lighting),
        Lighting::Around { map, turn } => {
            options.option("environment", "softboxes");
            options.option("rotate", turn.to_degrees());
            options.option("samples", SAMPLES);
            if map > 0 {
                options.remarks.push("name the file of the map in place of softboxes".to_owned());
            }
        }
    }
    options.picture(session, size, output);
    line.with_materials(&session.blend.ends[end..=end], options)
}

impl Line {
    fn say(&mut self, word: &str) {
        self.words.push(quoted(word));
    }

    /// With `=`, so that a negative value is no switch.
    fn option(&mut self, name: &str, value: impl ToString) {
        self.say(&format!("--{name}={}", value.to_string()));
    }

    fn lamps(&mut self, lighting: Lighting) {
        self.option("light", if lighting == Lighting::Studio { "studio" } else { "point" });
        if let Lighting::Point(to) = lighting
            && lighting != LAMP
        {
            self.remarks.push(format!("the lamp is at {:.3} {:.3} {:.3}", to.x, to.y, to.z));
        }
    }

    fn picture(&mut self, session: &Session, size: u16, output: &str) {
        self.option("size", size);
        if session.look.exposure != 0.0 {
            self.option("exposure", session.look.exposure);
        }
        self.option("output", output);
    }

    /// What the command cannot say of how it is looked at: it draws whole spheres through the clip curve.
    fn seen(&mut self, session: &Session, at: At, form: PictureForm) {
        let look = &session.look;
        match look.scenery.shape {
            Shape::Sphere => {}
            Shape::Plane => self.remarks.push("on a plane: the command draws spheres".to_owned()),
            Shape::Mesh(_) => self.remarks.push("on a mesh: the command draws spheres".to_owned()),
        }
        let Frame { zoom, centre: [x, y] } = look.scenery.frame;
        // Film strips show the whole shape.
        if look.scenery.frame != Frame::WHOLE && matches!(at, At::Here) {
            self.remarks.push(format!("zoomed {zoom:.2} times at {x:.3} {y:.3}: the command draws the whole"));
        }
        if look.tone != Tone::Clip && form == PictureForm::Png {
            self.remarks.push(format!("tone curve {}: the command clips", look.tone.title()));
        }
    }

    fn with_materials(mut self, ends: &[String], options: Self) -> Self {
        self.remarks.extend(options.remarks);
        let own = ends.iter().filter(|end| builtin::shared().get(end).is_err());
        self.remarks.extend(own.map(|end| format!("name the file of {end}")));
        // A name that begins as a switch does goes where there are none any more.
        let is_odd = ends.iter().any(|end| end.starts_with('-'));
        let odd = is_odd.then(|| "--".to_owned());
        let ends: Vec<String> = odd.into_iter().chain(ends.iter().map(|end| quoted(end))).collect();
        let parts = if is_odd { [options.words, ends] } else { [ends, options.words] };
        self.words.extend(parts.into_iter().flatten());
        self
    }

    fn text(&self) -> String {
        let command = format!("nbrdf {}", self.words.join(" "));
        // Some shells know no remarks where one types, and a line break ends any: nothing in them may be run.
        let is_harmless = |letter: char| letter.is_alphanumeric() || " .,:-_/".contains(letter);
        let remarks = self.remarks.join(", ").replace(|letter: char| !is_harmless(letter), " ");
        if remarks.is_empty() { command } else { format!("{command} # {remarks}") }
    }
}

/// A word that a shell takes as it is.
fn quoted(word: &str) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./,=+:@%".contains(letter);
    match !word.is_empty() && word.chars().all(is_plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;
    use crate::gui::session::{Methods, Way};
    use crate::worker::{Explored, Projection};

    /// Words as a shell makes them of what [`quoted`] quotes.
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
        session.look.scenery.lighting = Lighting::Around { map: 1, turn: 0.5 };
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
                    let around = turn.map(|turn| Lighting::Around { map: 0, turn });
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
}
