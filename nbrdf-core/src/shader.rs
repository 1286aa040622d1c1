//! Materials as source code: one function with the weights of the network in it, to be pasted into a renderer.
//!
//! Every language has a template (`shader/f_r.*`) that reads the network as [`Nbrdf`] does: A. Sztrajman et al., *Neural BRDF
//! Representation and Importance Sampling* (2021), section 3. Units that never fire and the input h.y, which is 0 of
//! isotropic materials, are left out ([`Nbrdf::compact`]). Shading languages have no `fma` to rely on, so that the difference
//! vector is made from light − view, which subtracts nothing that is close: of the same quality as the library's.
//!
//! ```
//! use nbrdf_core::library::builtin;
//! use nbrdf_core::shader::{Language, Shader};
//!
//! let chrome = Shader::new("chrome", &builtin::shared().get("chrome")?.network);
//! let source = chrome.source(Language::Glsl);
//! assert!(source.contains("vec3 f_r_chrome(vec3 light, vec3 view) {"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod header;
mod identifier;
mod language;
mod numbers;
mod page;
mod read;
mod source_error;
mod template;

pub use language::Language;
pub use read::read;
pub use source_error::SourceError;

use crate::Nbrdf;
use crate::brdf::Azimuth;
use crate::hash::sha256;
use crate::nbrdf::INPUTS;
use crate::nbrdf::anisotropic::AnisotropicNbrdf;

/// A network that is to become source code.
#[derive(Clone, Debug)]
pub struct Shader {
    /// The material's name.
    name: String,
    /// Hidden widths as they were given.
    hidden: [usize; 2],
    /// SHA-256 of the weights as they were given.
    sha256: String,
    /// What is written: without units that never fire.
    network: Nbrdf,
    azimuth: Azimuth,
}

impl Shader {
    /// Of an isotropic material. Takes some milliseconds, unless the network was pruned.
    pub fn new(name: impl Into<String>, network: &Nbrdf) -> Self {
        Self::of(name.into(), network, network.compact(), Azimuth::Dropped)
    }

    /// Of a material that changes when it is turned.
    pub fn turning(name: impl Into<String>, network: &AnisotropicNbrdf) -> Self {
        Self::of(name.into(), network.network(), network.network().clone(), Azimuth::Kept)
    }

    fn of(name: String, given: &Nbrdf, network: Nbrdf, azimuth: Azimuth) -> Self {
        let bytes: Vec<u8> = given.weights().iter().flat_map(|weight| weight.to_le_bytes()).collect();
        Self { name, hidden: given.hidden(), sha256: sha256(&bytes), network, azimuth }
    }

    /// The material's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// SHA-256 of the network's weights, all of them, as little-endian f32 in their flattened order
    /// ([`Layout`](crate::nbrdf::Layout)).
    pub fn weights_sha256(&self) -> &str {
        &self.sha256
    }

    /// The function's name: `f_r_` and the material's in lower case, `_` for whatever is no ASCII letter or digit.
    pub fn function(&self) -> String {
        identifier::of("f_r", &self.name)
    }

    /// The whole file: what it is, units, conventions, checksum and terms as a comment, then the function. Of the pair
    /// (light, view), unit vectors in the shading frame with the normal +z, it gives f_r \[1/sr\], linear RGB, without the
    /// cosine; 0 below either horizon, never negative.
    pub fn source(&self, language: Language) -> String {
        header::of(self, language) + "\n" + &self.code(language)
    }

    /// A page that needs nothing else: a sphere of the material drawn by WebGL 2 with the GLSL of [`source`](Self::source).
    ///
    /// Orthographic as [`Sphere`](crate::render::Sphere), under the lamps of [`Light`](crate::render::Light), shown as
    /// clip(L, 0, 1)^(1/2.2). `?light=point` or `studio` is the light to begin with; under `?test=N` the page becomes a PNG of
    /// N × N pixels on black, without antialiasing, to be compared with pictures from elsewhere.
    pub fn page(&self) -> String {
        page::of(self)
    }

    /// The function alone.
    fn code(&self, language: Language) -> String {
        template::fill(language.template(), &|key| self.value(language, key))
    }

    /// What stands in a template under this name.
    fn value(&self, language: Language, key: &str) -> Option<String> {
        let [first, second] = self.network.hidden();
        let inputs = self.inputs();
        let numbers = |layer: usize| numbers::kernel(&self.network, layer, &inputs, language.suffix());
        let biases = |layer: usize| numbers::biases(&self.network, layer, language.suffix());
        Some(match key {
            "function" => self.function(),
            "inputs" => inputs.len().to_string(),
            "h1" => first.to_string(),
            "h2" => second.to_string(),
            "w1" => (inputs.len() * first).to_string(),
            "w2" => (first * second).to_string(),
            "w3" => (second * 3).to_string(),
            "rows1" => numbers(0),
            "rows2" => numbers(1),
            "rows3" => numbers(2),
            "biases1" => biases(0),
            "biases2" => biases(1),
            "biases3" => biases(2),
            "coordinates" => COORDINATES.to_owned(),
            "half" => language.half(self.azimuth).to_owned(),
            _ => return None,
        })
    }

    /// Which of the six inputs are read.
    fn inputs(&self) -> Vec<usize> {
        let is_read = |&input: &usize| self.azimuth == Azimuth::Kept || input != 1;
        (0..INPUTS).filter(is_read).collect()
    }
}

/// A comment, the same in every language.
const COORDINATES: &str = "    \
    // The half vector h of light and view, and d, the light in the frame of h: half of light - view in that frame, but
    // for d.z. So nothing cancels, also where light and view are close.";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::library::builtin;
    use crate::nbrdf::fit::random_network;

    fn alum_bronze() -> Shader {
        Shader::new("alum-bronze", &builtin::shared().get("alum-bronze").unwrap().network)
    }

    #[test]
    fn every_source_says_what_it_is_and_whose_and_leaves_no_place_unfilled() {
        for language in Language::ALL {
            let source = alum_bronze().source(language);
            let (comment, code) = source.split_once("\n\n").unwrap();
            assert!(comment.lines().all(|line| line.starts_with("// ") && line.len() <= 125), "{comment}");
            for what in
                ["alum-bronze", env!("CARGO_PKG_VERSION"), "1/sr", "+z", "6-21-21-3", "MERL", "10.1111/cgf.14335"]
            {
                assert!(comment.contains(what), "{language:?}: {what}");
            }
            assert!(comment.contains(alum_bronze().weights_sha256()));
            assert!(code.contains("f_r_alum_bronze(") && !code.contains('@'), "{language:?}");
            assert!(code.lines().all(|line| line.len() <= 120), "{language:?}");
        }
    }

    #[test]
    fn the_checksum_is_of_all_weights_and_units_that_never_fire_are_not_written() {
        let network = &builtin::shared().get("alum-bronze").unwrap().network;
        let (whole, pruned) = (Shader::new("a", network), Shader::new("a", &network.pruned()));
        assert_eq!(whole.source(Language::C), pruned.source(Language::C));
        let [first, second] = network.compact().hidden();
        assert!(second < 21 && whole.source(Language::C).contains(&format!("float w2[{}]", first * second)));
        let bytes: Vec<u8> = network.weights().iter().flat_map(|weight| weight.to_le_bytes()).collect();
        assert_eq!(whole.weights_sha256(), sha256(&bytes));
    }

    #[test]
    fn what_changes_when_it_is_turned_reads_the_whole_half_vector() {
        let turning = Shader::turning("brushed", &AnisotropicNbrdf::of(random_network(1, 0)));
        let source = turning.source(Language::Wgsl);
        assert!(source.contains("array<f32, 126>") && source.contains("s.y * inverse, s.z * inverse"));
        assert!(!alum_bronze().source(Language::Wgsl).contains("s.y * inverse"));
    }
}
