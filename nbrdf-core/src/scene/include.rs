//! A scene's file and those it includes, in the order in which they count.

use std::path::{Path, PathBuf};

use super::keys::SceneFile;
use super::{SceneError, SceneProblem};
use crate::bounded;

/// Largest file \[bytes\].
const MAX_BYTES: u64 = 1 << 20;
/// Most files.
const MAX_FILES: usize = 64;

/// Every file once for every time it is included, those that are included before those that include them.
pub(super) fn read(path: &Path) -> Result<Vec<(PathBuf, SceneFile)>, SceneError> {
    let mut files = Vec::new();
    follow(path, &mut Vec::new(), &mut files)?;
    Ok(files)
}

fn follow(path: &Path, way: &mut Vec<PathBuf>, files: &mut Vec<(PathBuf, SceneFile)>) -> Result<(), SceneError> {
    let of = |problem: SceneProblem| problem.of(path);
    let real = path.canonicalize().map_err(|error| of(error.into()))?;
    let is_circle = way.contains(&real);
    way.push(real);
    if is_circle {
        let names = way.iter().map(|file| file.file_name().unwrap_or_default().to_string_lossy().into_owned());
        return Err(of(SceneProblem::Circle(names.collect::<Vec<_>>().join(" → "))));
    }
    if files.len() + way.len() > MAX_FILES {
        return Err(of(SceneProblem::value("include", format!("at most {MAX_FILES} files"), "more")));
    }
    let bytes = bounded::read(path, MAX_BYTES).map_err(|error| of(error.into()))?;
    let bytes = bytes.ok_or_else(|| of(SceneProblem::value("size", format!("at most {MAX_BYTES} bytes"), "more")))?;
    let text = String::from_utf8(bytes).map_err(|error| of(SceneProblem::Syntax(format!("expected TOML: {error}"))))?;
    let file: SceneFile = toml::from_str(&text)
        .map_err(|error| of(SceneProblem::Syntax(format!("expected a scene in TOML:\n{error}"))))?;
    let folder = path.parent().unwrap_or_else(|| Path::new(""));
    for included in &file.include {
        follow(&folder.join(included), way, files)?;
    }
    way.pop();
    files.push((folder.to_owned(), file));
    Ok(())
}
