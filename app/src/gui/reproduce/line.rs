//! A line for the shell, word by word.

use nbrdf_core::library::builtin;

use crate::gui::Session;
use crate::gui::session::LAMP;
use crate::shell::quoted;
use crate::worker::Lighting;

/// A line for the shell, and what it cannot say.
#[derive(Default)]
pub struct Line {
    pub words: Vec<String>,
    pub remarks: Vec<String>,
}

impl Line {
    pub fn say(&mut self, word: &str) {
        self.words.push(quoted(word));
    }

    /// With `=`, so that a negative value is no switch.
    pub fn option(&mut self, name: &str, value: impl ToString) {
        self.say(&format!("--{name}={}", value.to_string()));
    }

    pub fn lamps(&mut self, lighting: Lighting) {
        self.option("light", if lighting == Lighting::Studio { "studio" } else { "point" });
        if let Lighting::Point(to) = lighting
            && lighting != LAMP
        {
            self.remarks.push(format!("the lamp is at {:.3} {:.3} {:.3}", to.x, to.y, to.z));
        }
    }

    pub fn picture(&mut self, session: &Session, size: u16, output: &str) {
        self.option("size", size);
        if session.look.exposure != 0.0 {
            self.option("exposure", session.look.exposure);
        }
        self.option("output", output);
    }

    pub fn with_materials(mut self, ends: &[String], options: Self) -> Self {
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

    pub fn text(&self) -> String {
        let command = format!("nbrdf {}", self.words.join(" "));
        // Some shells know no remarks where one types, and a line break ends any: nothing in them may be run.
        let is_harmless = |letter: char| letter.is_alphanumeric() || " .,:-_/".contains(letter);
        let remarks = self.remarks.join(", ").replace(|letter: char| !is_harmless(letter), " ");
        if remarks.is_empty() { command } else { format!("{command} # {remarks}") }
    }
}
