//! The OpenPBR surface without transmission, subsurface, fuzz, thin film and anisotropy.
//!
//! Academy Software Foundation, *OpenPBR Surface specification*, version 1.1: coat over mix(glossy-diffuse, metal). Modelled:
//! the exact Fresnel reflectance of the glossy base and the coat, F82-tint metals, GGX with height-correlated masking,
//! energy-preserving rough diffuse (EON), the base's rougher look and lower contrast of indices under the coat. Approximated, as the
//! specification leaves it open: layers by albedo scaling, 1 − E(ω_o) of the upper one for the lower one, which is not reciprocal;
//! light scattered more than once between facets by the factor 1 + F (1 − E)/E (E. Turquin, *Practical Multiple
//! Scattering Compensation for Microfacet Models*, 2019, eq. 16), with the F of the pair, as MaterialX has it. Fixed:
//! `specular_weight` 1, `coat_ior` 1.6, `coat_color` white, `coat_darkening` 0.

mod file;

use super::albedo::{ByCosine, directional};
use super::eon::Eon;
use super::lobe::{Metal, Pair, dielectric};
use super::{Parameter, Sequence, ShadingModel};
use crate::{Brdf, Directions, Rgb};

/// `coat_ior`.
const COAT_IOR: f32 = 1.6;

/// An OpenPBR surface; every field is the input of the same name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenPbr {
    /// `base_color`, 0..1.
    pub base_color: Rgb,
    /// `base_metalness`, 0..1.
    pub metalness: f32,
    /// `specular_roughness`, 0..1.
    pub roughness: f32,
    /// `base_diffuse_roughness`, 0..1.
    pub diffuse_roughness: f32,
    /// `specular_color`, 0..1: of a dielectric's reflection as a whole, of a metal's at 82°.
    pub specular_color: Rgb,
    /// `specular_ior`, from 1.
    pub ior: f32,
    /// `coat_weight`, 0..1.
    pub coat: f32,
    /// `coat_roughness`, 0..1.
    pub coat_roughness: f32,
}

impl ShadingModel for OpenPbr {
    const NAME: &'static str = "open_pbr";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::core("base_color", [0.0, 1.0]).color(),
        Parameter::core("base_metalness", [0.0, 1.0]),
        Parameter::core("specular_roughness", [0.03, 1.0]),
        Parameter::of("diffuse", "base_diffuse_roughness", [0.0, 1.0], 0.0, [0.3, 0.8]),
        Parameter::of("specular", "specular_color", [0.0, 1.0], 1.0, [0.9, 0.6]).color(),
        Parameter::of("specular", "specular_ior", [1.0, 3.0], 1.5, [1.4, 1.9]),
        Parameter::of("coat", "coat_weight", [0.0, 1.0], 0.0, [0.5, 0.5]),
        Parameter::of("coat", "coat_roughness", [0.03, 1.0], 0.0, [0.15, 0.5]),
    ];

    fn from_values(values: &[f32]) -> Self {
        let mut next = Sequence::new(values);
        Self {
            base_color: next.color(),
            metalness: next.number(),
            roughness: next.number(),
            diffuse_roughness: next.number(),
            specular_color: next.color(),
            ior: next.number(),
            coat: next.number(),
            coat_roughness: next.number(),
        }
    }

    fn values(&self) -> Vec<f32> {
        let parts: [&[f32]; 4] = [
            &self.base_color.0,
            &[self.metalness, self.roughness, self.diffuse_roughness],
            &self.specular_color.0,
            &[self.ior, self.coat, self.coat_roughness],
        ];
        parts.concat()
    }

    fn brdf(&self) -> Box<dyn Brdf> {
        let fourth = (self.roughness.powi(4) + 2.0 * self.coat_roughness.powi(4)).min(1.0).powf(0.25);
        let roughness = self.roughness + (fourth - self.roughness) * self.coat;
        let ratio = self.ior / COAT_IOR;
        let under_coat = if ratio < 1.0 { 1.0 / ratio } else { ratio };
        let ior = self.ior + (under_coat - self.ior) * self.coat;
        Box::new(Evaluated {
            diffuse: Eon::new(self.base_color, self.diffuse_roughness),
            tint: self.specular_color,
            glossy: Glossy::new(roughness, ior),
            metal: Metal::new(self.base_color, self.specular_color),
            metalness: self.metalness,
            coat: (self.coat > 0.0).then(|| (self.coat, Glossy::new(self.coat_roughness, COAT_IOR))),
        })
    }
}

/// A rough dielectric interface, reflection only.
struct Glossy {
    alpha: f32,
    ior: f32,
    /// E of a white lobe.
    white: ByCosine,
    /// E of this one before compensation.
    own: ByCosine,
}

impl Glossy {
    fn new(roughness: f32, ior: f32) -> Self {
        let alpha = roughness * roughness;
        let own = directional(alpha, |cos| dielectric(ior, cos));
        Self { alpha, ior, white: directional(alpha, |_| 1.0), own }
    }

    /// What each once reflected share comes back with from further facets, over F.
    fn more(&self, view: f32) -> f32 {
        let white = self.white.at(view).clamp(1e-2, 1.0);
        (1.0 - white) / white
    }

    fn eval(&self, pair: Pair) -> f32 {
        let fresnel = dielectric(self.ior, pair.diff);
        fresnel * pair.ggx(self.alpha) * (1.0 + fresnel * self.more(pair.view))
    }

    /// What passes to the layer below.
    fn passes(&self, view: f32) -> f32 {
        let mean = self.own.at(view) / self.white.at(view).max(1e-2);
        (1.0 - self.own.at(view) * (1.0 + mean * self.more(view))).clamp(0.0, 1.0)
    }
}

struct Evaluated {
    diffuse: Eon,
    tint: Rgb,
    glossy: Glossy,
    metal: Metal,
    metalness: f32,
    /// Its weight.
    coat: Option<(f32, Glossy)>,
}

impl Brdf for Evaluated {
    fn eval(&self, at: Directions) -> Rgb {
        let Some(pair) = Pair::of(at) else { return Rgb::BLACK };
        let dielectric = self.diffuse.eval(at) * self.glossy.passes(pair.view) + self.tint * self.glossy.eval(pair);
        let (lobe, more) = (pair.ggx(self.glossy.alpha), self.glossy.more(pair.view));
        let metal = self.metal.fresnel(pair.diff).map(|fresnel| fresnel * lobe * (1.0 + fresnel * more));
        let mut value = dielectric.zip(metal, |dielectric, metal| dielectric + (metal - dielectric) * self.metalness);
        if let Some((weight, coat)) = &self.coat {
            let (passes, own) = (1.0 - weight * (1.0 - coat.passes(pair.view)), weight * coat.eval(pair));
            value = value.map(|value| value * passes + own);
        }
        value.map(|value| value.max(0.0))
    }
}
