//! `nbrdf app`: how the window opens.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::pane::Pane;
use super::renderer::Renderer;
use super::session::LAMP;
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
    /// Eleven lamps: three keys and a ring of fills.
    Studio,
    /// One lamp at 45°.
    Point,
    /// A room with soft boxes all around.
    Softboxes,
}

impl Light {
    pub(super) fn lighting(self) -> Lighting {
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
}
