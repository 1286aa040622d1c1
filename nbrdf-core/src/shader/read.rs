//! The network back from source code: what the numbers in the text say, whatever the language.

use super::SourceError;
use crate::Nbrdf;
use crate::brdf::Azimuth;
use crate::nbrdf::INPUTS;

/// The network in a text that [`Shader::source`](super::Shader::source) or [`Shader::page`](super::Shader::page) has written,
/// and whether it reads how the material is turned. Units that were left out are not there; values are the same to the bit.
///
/// Only the six lists of numbers are read: whoever has changed the code around them has changed the material, and not this.
///
/// # Errors
/// If a list is missing, holds something that is no number, or does not fit the others.
pub fn read(source: &str) -> Result<(Nbrdf, Azimuth), SourceError> {
    // What a title or a comment says before is none of it: a material's name may be anything.
    let (_, layers) =
        source.rsplit_once(LAYERS).ok_or_else(|| SourceError::new(format!("the line `{LAYERS}`"), "none"))?;
    let [w1, b1, w2, b2, w3, b3] = NAMES.map(|name| numbers(layers, name));
    let (w1, b1, w2, b2, w3, b3) = (w1?, b1?, w2?, b2?, w3?, b3?);
    let (first, second) = (b1.len(), b2.len());
    let inputs = match w1.len().checked_div(first) {
        Some(inputs @ (5 | INPUTS)) => inputs,
        _ => return Err(SourceError::new("5 or 6 weights for each number of b1", w1.len())),
    };
    for (name, found, rows, columns) in
        [("w1", &w1, inputs, first), ("w2", &w2, first, second), ("w3", &w3, second, 3), ("b3", &b3, 1, 3)]
    {
        if found.len() != rows * columns {
            return Err(SourceError::new(format!("{} numbers of {name}", rows * columns), found.len()));
        }
    }
    let mut weights = kernel(&w1, first);
    let azimuth = if inputs == INPUTS { Azimuth::Kept } else { Azimuth::Dropped };
    if azimuth == Azimuth::Dropped {
        // h.y, which is 0.
        weights.splice(first..first, std::iter::repeat_n(0.0, first));
    }
    for part in [b1, kernel(&w2, second), b2, kernel(&w3, 3), b3] {
        weights.extend(part);
    }
    let network = Nbrdf::new([first, second], weights);
    Ok((network.map_err(|error| SourceError::new("a network's weights", error))?, azimuth))
}

/// What stands above the lists in every language.
const LAYERS: &str = "// The network's layers: for each unit a row of weights.";
/// Names of the lists, in capitals where the language wants constants so.
const NAMES: [&str; 6] = ["w1", "b1", "w2", "b2", "w3", "b3"];

/// The list of this name: the numbers between the last bracket that opens after its `=` and the next that closes.
fn numbers(source: &str, name: &str) -> Result<Vec<f32>, SourceError> {
    let list = assigned(source, name).ok_or_else(|| SourceError::new(format!("a list of numbers {name}"), "none"))?;
    let number = |text: &str| {
        let digits = text.trim();
        let digits = digits.strip_suffix('f').unwrap_or(digits);
        digits.parse().map_err(|_| SourceError::new(format!("numbers of {name}"), format!("`{}`", text.trim())))
    };
    list.trim_end().trim_end_matches(',').split(',').map(number).collect()
}

/// What stands between the brackets.
fn assigned<'a>(source: &'a str, name: &str) -> Option<&'a str> {
    let declares = |line: &&str| {
        let (left, _) = line.split_once('=').unwrap_or_default();
        left.split(|c: char| !c.is_ascii_alphanumeric()).any(|word| word.eq_ignore_ascii_case(name))
    };
    let line = source.lines().find(declares)?;
    // Lines are parts of the text: how far into it this one begins is the difference of where they lie.
    let start = line.as_ptr() as usize - source.as_ptr() as usize;
    let (_, right) = source[start..].split_once('=')?;
    let (statement, _) = right.split_once(';')?;
    let (_, list) = statement.rsplit_once(['(', '{', '['])?;
    Some(list.split_once([')', '}', ']'])?.0)
}

/// Rows of units as the kernel's (in, out) order.
fn kernel(rows: &[f32], units: usize) -> Vec<f32> {
    let inputs = rows.len() / units;
    (0..inputs).flat_map(|input| (0..units).map(move |unit| rows[unit * inputs + input])).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::{Language, Shader};
    use super::*;
    use crate::library::builtin;
    use crate::nbrdf::anisotropic::AnisotropicNbrdf;
    use crate::nbrdf::fit::random_hidden;
    use crate::sampling::{evaluate, rus32k};

    #[test]
    fn what_is_written_in_any_language_is_the_network_again() {
        for (name, called) in
            [("chrome", "chrome"), ("alum-bronze", "w1=0.3; b1 = {0.5}"), ("pink-felt", "const w1 = (")]
        {
            let network = &builtin::shared().get(name).unwrap().network;
            let shader = Shader::new(called, network);
            for text in Language::ALL.map(|language| shader.source(language)).into_iter().chain([shader.page()]) {
                let (read, azimuth) = super::read(&text).unwrap();
                assert_eq!(azimuth, Azimuth::Dropped);
                assert_eq!(evaluate(&read, rus32k()), evaluate(network, rus32k()), "{name}");
            }
        }
    }

    #[test]
    fn one_that_turns_keeps_every_weight() {
        let network = random_hidden(3, 0, [4, 7]);
        let shader = Shader::turning("brushed", &AnisotropicNbrdf::of(network.clone()));
        for language in Language::ALL {
            let (read, azimuth) = super::read(&shader.source(language)).unwrap();
            assert_eq!((read.weights(), azimuth), (network.weights(), Azimuth::Kept));
        }
    }

    #[test]
    fn what_is_missing_or_too_short_is_told() {
        let source = Shader::new("a", &random_hidden(1, 0, [2, 3])).source(Language::C);
        let told = |text: &str| super::read(text).unwrap_err().to_string();
        assert_eq!(told(""), format!("expected the line `{LAYERS}`, found none"));
        assert_eq!(told(LAYERS), "expected a list of numbers w1, found none");
        assert_eq!(told(&source.replace("b2[3]", "c2[3]")), "expected a list of numbers b2, found none");
        let (before, after) = source.split_once("b3[3] = {").unwrap();
        let (_, after) = after.split_once(',').unwrap();
        assert_eq!(told(&format!("{before}b3[3] = {{{after}")), "expected 3 numbers of b3, found 2");
        assert!(told(&format!("{before}b3[3] = {{x,{after}")).ends_with("numbers of b3, found `x`"));
    }

    proptest! {
        #[test]
        fn no_text_is_too_strange(text in "[wb123=(){};, .\n0-9ef-]{0,80}", cut in 0_usize..4000) {
            let _ = super::read(&text);
            let source = Shader::new("a", &random_hidden(1, 0, [2, 3])).source(Language::Glsl);
            let cut = cut.min(source.len());
            let _ = super::read(&format!("{}{text}{}", &source[..cut], &source[cut..]));
        }
    }
}
