//! `nbrdf app`: how the window opens.

use std::path::PathBuf;

use anyhow::{Result, anyhow};
use clap::{Args, ValueEnum};
use nbrdf_core::library::builtin;

use super::pane::Pane;
use super::renderer::{self, Renderer};
use super::session::{LAMP, Way};
use super::store::{self, Found};
use super::window::{self, Opening};
use super::{Layout, Session};
use crate::worker::{Asset, Lighting};

/// The desktop app: walk between two materials and watch.
#[derive(Debug, Clone, Default, Args)]
pub struct App {
    /// Libraries, archives, networks, measurements or codes to show beside the built-in materials, environment maps (.hdr,
    /// .exr), meshes (.obj, .gltf, .glb), and a scene to plan (.toml).
    pub files: Vec<PathBuf>,
    /// Material at t = 0.
    #[arg(long, short, value_name = "MATERIAL")]
    pub a: Option<String>,
    /// Material at t = 1.
    #[arg(long, short, value_name = "MATERIAL")]
    pub b: Option<String>,
    /// Where on the path to start, 0..1.
    #[arg(long, value_parser = share, value_name = "T")]
    pub t: Option<f32>,
    /// Light to start with.
    #[arg(long, value_enum)]
    pub light: Option<Light>,
    /// Colours of the window; those of the system by default.
    #[arg(long, value_enum)]
    pub theme: Option<Theme>,
    /// Begin anew instead of where the last session ended.
    #[arg(long)]
    pub new: bool,
    /// How the window is drawn.
    #[arg(long, value_enum, default_value_t)]
    pub renderer: Renderer,
    /// Why OpenGL opened no window, where this is the second start.
    #[arg(long, value_name = "WHY", hide = true)]
    pub instead: Option<String>,
    /// Size of the window, such as 1600x900.
    #[arg(long, value_parser = size, value_name = "WxH")]
    pub size: Option<[u16; 2]>,
    /// Bring this pane to the front.
    #[arg(long, value_name = "PANE", hide = true, value_parser = pane)]
    pub pane: Option<Pane>,
    /// Write a picture of the window once everything is shown, and leave.
    #[arg(long, value_name = "FILE", hide = true)]
    pub screenshot: Option<PathBuf>,
    /// Write pictures of a walk from A to B and back into this folder, and leave.
    #[arg(long, value_name = "FOLDER", hide = true, conflicts_with = "screenshot")]
    pub film: Option<PathBuf>,
    /// How many pictures.
    #[arg(long, value_name = "N", hide = true, default_value_t = 48, value_parser = clap::value_parser!(u16).range(2..=999))]
    pub frames: u16,
    /// Write how long frames took when the window is closed.
    #[arg(long, value_name = "FILE.json", hide = true)]
    pub report: Option<PathBuf>,
    /// Move t back and forth for so many seconds, and leave.
    #[arg(long, value_name = "SECONDS", hide = true, requires = "report")]
    pub drive: Option<u16>,
}

/// Where the light comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Light {
    /// Eleven lamps, as in reports.
    Studio,
    /// One lamp at 45°.
    Point,
    /// A room with soft boxes all around.
    Softboxes,
}

impl Light {
    fn lighting(self) -> Lighting {
        match self {
            Self::Studio => Lighting::Studio,
            Self::Point => LAMP,
            Self::Softboxes => Lighting::Around { map: Asset::BuiltIn, turn: 0.0 },
        }
    }
}

/// Colours of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Theme {
    /// Light text on dark.
    Dark,
    /// Dark text on light.
    Light,
}

impl App {
    /// Opens the window; returns when it is closed.
    ///
    /// # Errors
    /// If a material is unknown, or there is no display to open a window on.
    pub fn run(&self) -> Result<()> {
        // Names are checked before anything is opened.
        self.session(Session::default())?;
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
        let Err(error) = window::open(self.clone(), opening) else { return Ok(()) };
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

fn share(text: &str) -> Result<f32, String> {
    let parsed = text.parse().ok();
    parsed.filter(|t| (0.0..=1.0).contains(t)).ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

fn pane(text: &str) -> Result<Pane, String> {
    let found = Pane::ALL.into_iter().find(|pane| pane.title().eq_ignore_ascii_case(text));
    found.ok_or_else(|| format!("expected one of {}", Pane::ALL.map(Pane::title).join(", ")))
}

fn size(text: &str) -> Result<[u16; 2], String> {
    let parsed = text.split_once('x').and_then(|(width, height)| Some([width.parse().ok()?, height.parse().ok()?]));
    parsed.filter(|size| size.iter().all(|&side| side >= 200)).ok_or_else(|| "expected such as 1600x900".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_width_x_height() {
        assert_eq!(size("1600x900"), Ok([1600, 900]));
        assert!(size("1600").is_err() && size("10x900").is_err());
    }

    #[test]
    fn a_place_on_the_path_is_a_number_from_0_to_1() {
        assert_eq!(share("0.25"), Ok(0.25));
        assert!(["nan", "inf", "-0.1", "3", ""].iter().all(|text| share(text).is_err()));
    }

    #[test]
    fn an_unknown_material_is_refused_before_a_window_opens() {
        let app = App { a: Some("crome".to_owned()), ..App::default() };
        assert!(app.session(Session::default()).unwrap_err().to_string().contains("did you mean `chrome`"));
    }
}
