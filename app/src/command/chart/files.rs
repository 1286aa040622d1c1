//! What tells points of two checkpoints apart.

use std::path::PathBuf;

use crate::measure::point::Point;

/// Most letters of a file that a title keeps.
const LONGEST: usize = 32;

/// A short name for each file: its stem, or its path where another has that stem.
pub fn names(paths: &[PathBuf]) -> Vec<String> {
    let is_alone = |path: &PathBuf| paths.iter().filter(|other| other.file_stem() == path.file_stem()).count() == 1;
    let name = |path: &PathBuf| {
        let whole = path.with_extension("");
        let name = path.file_stem().filter(|_| is_alone(path)).unwrap_or(whole.as_os_str());
        let printable = name.to_string_lossy().replace(char::is_control, "?");
        // What differs between long paths is rather at their ends.
        match printable.char_indices().rev().nth(LONGEST - 1) {
            Some((at, _)) if at > 0 => format!("…{}", &printable[at..]),
            _ => printable,
        }
    };
    paths.iter().map(name).collect()
}

/// Keeps the file of a point only where another point has its name and variant.
pub fn tell_apart(points: &mut [Point]) {
    let models: Vec<(String, String)> =
        points.iter().map(|point| (point.name.clone(), point.variant.clone())).collect();
    for (point, own) in points.iter_mut().zip(&models) {
        if models.iter().filter(|model| *model == own).count() == 1 {
            point.file = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_named_by_what_differs() {
        let of = |paths: &[&str]| names(&paths.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert_eq!(of(&["a/one.safetensors", "two"]), ["one", "two"]);
        assert_eq!(of(&["a/same.safetensors", "b/same.safetensors", "c\n"]), ["a/same", "b/same", "c?"]);
        let long = of(&[&"é".repeat(200)]);
        assert_eq!(long[0].chars().count(), LONGEST + 1);
        assert!(long[0].starts_with('…'));
    }
}
