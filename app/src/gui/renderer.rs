//! How the window is drawn, and what is done where that opens none.

use std::ffi::OsString;
use std::process::{Command, ExitStatus};

use clap::ValueEnum;

/// How the window is drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum Renderer {
    /// By OpenGL, or by what else there is where that opens no window.
    #[default]
    Auto,
    /// By OpenGL.
    Glow,
    /// By Vulkan, Metal, Direct3D or OpenGL ES, in software where there is no GPU.
    #[cfg(feature = "wgpu")]
    Wgpu,
}

impl Renderer {
    /// What the window is drawn by; `is_second` where OpenGL was tried before.
    #[cfg_attr(not(feature = "wgpu"), expect(unused_variables, reason = "there is one only"))]
    pub const fn drawn_by(self, is_second: bool) -> eframe::Renderer {
        #[cfg(feature = "wgpu")]
        if matches!(self, Self::Wgpu) || (matches!(self, Self::Auto) && is_second) {
            return eframe::Renderer::Wgpu;
        }
        eframe::Renderer::Glow
    }

    /// Whether there is something else to try after this error: without a window system there is not.
    pub const fn has_second(self, error: &eframe::Error) -> bool {
        let is_about_drawing =
            matches!(error, eframe::Error::Glutin(_) | eframe::Error::NoGlutinConfigs(..) | eframe::Error::OpenGL(_));
        cfg!(feature = "wgpu") && matches!(self, Self::Auto) && is_about_drawing
    }
}

/// What the window says of its being the second.
pub fn notice(why: &str) -> String {
    format!("OpenGL opens no window here ({why}), so this one is drawn without; --renderer wgpu does so at once.")
}

/// Starts the program again, told why: a process has one loop of events only, whatever became of it. How it ended.
pub fn again(why: &str) -> std::io::Result<ExitStatus> {
    let words = words(std::env::args_os().skip(1), why);
    Command::new(std::env::current_exe()?).args(words).status()
}

/// The words of the first start and why there is a second.
fn words(first: impl Iterator<Item = OsString>, why: &str) -> Vec<OsString> {
    let mut words: Vec<OsString> = first.collect();
    // Without a command there are none but global switches, and these may follow it.
    let place = words.iter().position(|word| word == "app").unwrap_or_else(|| {
        words.insert(0, "app".into());
        0
    });
    words.insert(place + 1, format!("--instead={why}").into());
    words
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;

    #[test]
    fn the_second_start_is_told_why_and_keeps_what_was_asked_for() {
        let given: [&[&str]; 4] = [&[], &["--threads", "2"], &["app", "a.npz", "--t", "0.5"], &["app", "--", "-x.npz"]];
        for first in given {
            let words = words(first.iter().map(OsString::from), "no GL, -1");
            assert!(first.iter().all(|word| words.iter().any(|kept| kept == word)), "{words:?}");
            let told = format!("{:?}", Cli::of(std::iter::once("nbrdf".into()).chain(words)).unwrap());
            assert!(told.contains(r#"instead: Some("no GL, -1")"#), "{told}");
        }
    }

    #[test]
    fn only_auto_has_a_second_and_only_where_drawing_failed() {
        let creation = eframe::Error::AppCreation("no".into());
        assert!(!Renderer::Auto.has_second(&creation));
        assert_eq!(Renderer::Auto.drawn_by(false), eframe::Renderer::Glow);
        assert_eq!(Renderer::Glow.drawn_by(true), eframe::Renderer::Glow);
        #[cfg(feature = "wgpu")]
        assert_eq!(Renderer::Auto.drawn_by(true), eframe::Renderer::Wgpu);
    }
}
