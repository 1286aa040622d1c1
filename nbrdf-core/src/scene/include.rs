//! A scene's file and those it includes, in the order in which they count.

use std::path::{Path, PathBuf};

use super::keys::SceneFile;
use super::{SceneError, SceneProblem};
use crate::bounded;

/// Largest file \[bytes\].
const MAX_BYTES: u64 = 1 << 20;
/// Most files.
const MAX_FILES: usize = 64;

/// A scene's file as it stands.
pub(super) struct Read {
    /// Where it is.
    pub path: PathBuf,
    /// What it says.
    pub keys: SceneFile,
}

/// Every file once, those that are included before those that include them; `-` is standard input.
pub(super) fn read(path: &Path) -> Result<Vec<Read>, SceneError> {
    let mut files = Vec::new();
    follow(path, &mut Vec::new(), &mut Vec::new(), &mut files)?;
    Ok(files)
}

fn follow(
    path: &Path,
    way: &mut Vec<PathBuf>,
    seen: &mut Vec<PathBuf>,
    files: &mut Vec<Read>,
) -> Result<(), SceneError> {
    let of = |problem: SceneProblem| problem.of(path);
    // Pipes have no other name.
    let real = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let is_circle = way.contains(&real);
    way.push(real.clone());
    if is_circle {
        let names = way.iter().map(|file| file.file_name().unwrap_or_default().to_string_lossy().into_owned());
        return Err(of(SceneProblem::Circle(names.collect::<Vec<_>>().join(" → "))));
    }
    if !seen.contains(&real) {
        seen.push(real);
        if seen.len() > MAX_FILES {
            return Err(of(SceneProblem::value("include", format!("at most {MAX_FILES} files"), "more")));
        }
        let keys = keys(path).map_err(of)?;
        let folder = path.parent().unwrap_or_else(|| Path::new(""));
        for included in &keys.include {
            follow(&folder.join(included), way, seen, files)?;
        }
        files.push(Read { path: path.to_owned(), keys });
    }
    way.pop();
    Ok(())
}

fn keys(path: &Path) -> Result<SceneFile, SceneProblem> {
    let bytes = match path.as_os_str() == "-" {
        true => bounded::read_from(std::io::stdin().lock(), MAX_BYTES)?,
        false => bounded::read(path, MAX_BYTES)?,
    };
    let bytes = bytes.ok_or_else(|| SceneProblem::value("size", format!("at most {MAX_BYTES} bytes"), "more"))?;
    let text = String::from_utf8(bytes).map_err(|error| SceneProblem::Syntax(format!("expected TOML: {error}")))?;
    toml::from_str(&text).map_err(|error| SceneProblem::Syntax(format!("expected a scene in TOML:\n{error}")))
}
