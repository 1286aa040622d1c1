//! Names that come near one that was asked for.

use strsim::normalized_damerau_levenshtein as likeness;

/// Least likeness of a name that may have been meant.
const LEAST: f64 = 0.6;
/// Most names that are suggested.
const MOST: usize = 3;
/// Shortest word that may stand for a part of a name \[bytes\].
const SHORTEST: usize = 3;

/// The names that may have been meant, nearest first, three at most. Case, `_` and blanks make no difference, and folders of
/// either name may be wrong (`merl/chrome`, `paper-white` for `rgl/paper_white`). Where nothing is alike, a word stands for the
/// names that it begins a part of (`gold` for `gold-paint`), the shortest first.
pub fn near<'a>(asked: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let names: Vec<&str> = names.into_iter().collect();
    let wanted = plain(asked);
    let alike = best(&names, |name| {
        let known = plain(name);
        let pairs = [(&*wanted, &*known), (&*wanted, last(&known)), (last(&wanted), last(&known))];
        Some(pairs.map(|(a, b)| likeness(a, b)).into_iter().fold(0.0, f64::max)).filter(|score| *score >= LEAST)
    });
    if !alike.is_empty() || wanted.len() < SHORTEST {
        return alike;
    }
    best(&names, |name| {
        let known = plain(name);
        last(&known).split('-').any(|part| part.starts_with(&wanted)).then(|| 1.0 / known.len() as f64)
    })
}

/// Those of the highest scores, each once.
fn best<'a>(names: &[&'a str], score: impl Fn(&str) -> Option<f64>) -> Vec<&'a str> {
    let mut scored: Vec<(f64, &str)> = names.iter().filter_map(|name| Some((score(name)?, *name))).collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    scored.dedup();
    scored.into_iter().take(MOST).map(|(_, name)| name).collect()
}

fn plain(name: &str) -> String {
    name.to_lowercase().replace(['_', ' '], "-")
}

/// Without folders.
fn last(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_wrong_folders_and_first_words_are_understood() {
        let names = ["chrome", "gold-metallic-paint", "gold-paint", "rgl/paper_white", "marigold"];
        assert_eq!(near("chrme", names), ["chrome"]);
        assert_eq!(near("merl/chrome", names), ["chrome"]);
        assert_eq!(near("Paper-White", names), ["rgl/paper_white"]);
        assert_eq!(near("paint", names), ["gold-paint", "gold-metallic-paint"]);
        assert_eq!(near("chrom", [&names[..], &["chrome-steel"]].concat()), ["chrome"]);
        assert_eq!(near("gold", names), ["gold-paint", "gold-metallic-paint"]);
        assert!(near("foo", names).is_empty() && near("a/b/c", names).is_empty() && near("", names).is_empty());
    }

    #[test]
    fn a_name_that_is_listed_twice_is_suggested_once() {
        assert_eq!(near("znbrf", ["znbrdf", "znbrdf", "nbrdf"])[0], "znbrdf");
        assert_eq!(near("znbrf", ["znbrdf", "znbrdf"]), ["znbrdf"]);
    }
}
