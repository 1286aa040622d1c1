//! The start of the app: what is asked of a session, where it is kept, and who draws the window.

use anyhow::{Result, anyhow};
use nbrdf_core::library::builtin;

use super::args::{Light, Theme};
use super::session::Way;
use super::store::{self, Found};
use super::window::{self, Failures, Opening};
use super::{App, Layout, Session, renderer};
use crate::output;

impl App {
    /// Opens the window; returns when it is closed.
    ///
    /// # Errors
    /// If a material is unknown, or there is no display to open a window on.
    pub fn run(&self) -> Result<()> {
        // Names and places are checked before anything is opened.
        self.session(Session::default())?;
        self.check_outputs()?;
        if !has_display() {
            return Err(no_display("neither DISPLAY nor WAYLAND_DISPLAY is set"));
        }
        // Pictures of the window are of a new session or of one that was named, and leave no trace.
        let named = if self.is_filmed() { store::named() } else { store::file() };
        let file = named.clone().filter(|_| !self.is_filmed());
        let mut opening = Opening { file, ..Opening::default() };
        match named.as_deref().filter(|_| !self.new).map(store::read) {
            Some(Found::Session(saved)) => {
                opening.session = saved.session;
                opening.layout = saved.layout.filter(Layout::is_whole);
                opening.size = saved.window;
            }
            Some(Found::Damaged(why)) => opening.notices.push(why),
            Some(Found::Stuck(why)) => {
                opening.file = None;
                opening.notices.push(why);
            }
            Some(Found::Nothing) | None => {}
        }
        if let Some(file) = opening.file.as_deref().filter(|file| self.new && file.exists()) {
            match store::put_aside(file, "before.json") {
                Ok(aside) => opening.notices.push(format!("The session before is kept as {}.", aside.display())),
                Err(error) => {
                    let why = format!("{}: could not be put aside ({error})", file.display());
                    opening.notices.push(format!("{why}, so that this session is not saved."));
                    opening.file = None;
                }
            }
        }
        opening.session = self.session(opening.session)?;
        opening.size = self.size.map(|size| size.map(f32::from)).or(opening.size);
        if let Some(why) = &self.instead {
            opening.notices.push(renderer::notice(why));
        }
        let failures = Failures::default();
        let Err(error) = window::open(self.clone(), opening, &failures) else {
            return failures.first().map_or(Ok(()), |why| Err(anyhow!(why)));
        };
        let why = reason(&error);
        if self.instead.is_some() || !self.renderer.has_second(&error) {
            return Err(no_display(&why));
        }
        let ended = renderer::again(&why).map_err(|error| no_display(&format!("{why}; {error}")))?;
        if ended.success() {
            return Ok(());
        }
        // It has said itself what was wrong.
        std::process::exit(ended.code().unwrap_or(1))
    }

    /// Refuses places where pictures and reports cannot be written, before the work.
    fn check_outputs(&self) -> Result<()> {
        [&self.screenshot, &self.report].into_iter().flatten().try_for_each(|path| output::check_writable(path))?;
        self.film.as_deref().map_or(Ok(()), output::make_folder)
    }

    /// What the command line asks of a session: the last one, or a new one.
    fn session(&self, last: Session) -> Result<Session> {
        let mut session = last;
        let look = &mut session.look;
        look.scenery.lighting = self.light.map_or(look.scenery.lighting, Light::lighting);
        for (end, name) in [&self.a, &self.b].into_iter().enumerate() {
            if let Some(name) = name {
                session.blend.choose(end, &builtin::shared().get(name)?.name);
            }
        }
        if self.b.is_some() {
            // It is the material at t = 1, also where the last session had more.
            session.blend.ends.truncate(2);
        }
        if let Some(t) = self.t {
            (session.blend.way, session.blend.t) = (Way::Keys, t);
        }
        session.theme = match self.theme {
            Some(Theme::Dark) => egui::ThemePreference::Dark,
            Some(Theme::Light) => egui::ThemePreference::Light,
            None => session.theme,
        };
        Ok(session)
    }

    /// Whether pictures of the window are taken.
    pub(super) fn is_filmed(&self) -> bool {
        self.screenshot.is_some() || self.film.is_some() || self.drive.is_some()
    }
}

/// What the window system said, without the place in the source that it said it from.
fn reason(error: &eframe::Error) -> String {
    let text = match error {
        // What was tried to no avail fills half a window.
        eframe::Error::NoGlutinConfigs(_, why) => why.to_string(),
        error => error.to_string(),
    };
    text.rsplit(".rs:")
        .next()
        .unwrap_or_default()
        .trim_start_matches(|c: char| c.is_ascii_digit() || c == ':')
        .trim()
        .to_owned()
}

fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(all(unix, not(target_os = "macos"))) || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")
}

fn no_display(why: &str) -> anyhow::Error {
    anyhow!(
        "there is no display to open a window on ({why}); \
         without one, try `nbrdf blend gold-paint blue-acrylic`"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_material_is_refused_before_a_window_opens() {
        let app = App { a: Some("crome".to_owned()), ..App::default() };
        assert!(app.session(Session::default()).unwrap_err().to_string().contains("did you mean `chrome`"));
    }
}
