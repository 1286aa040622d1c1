//! The metallic-roughness material of glTF 2.0 with four of its extensions.
//!
//! *glTF 2.0 Specification*, appendix B, as its layered definition has it: mix(fresnel_mix(diffuse, specular),
//! conductor_fresnel(specular), metallic) with Schlick's Fresnel term, GGX of α = roughness² and G₁(ω_i) G₁(ω_o);
//! KHR_materials_ior, _specular (fresnel_mix keeps 1 − max F for the base), _clearcoat (F by the view's own cosine), _sheen
//! (Charlie, base scaled by the smaller of both albedos' remainders). Clear coat breaks reciprocity, nothing else does.
//! Left out: textures, emission, transmission, and extensions that are not named here.

mod file;

use std::f32::consts::FRAC_1_PI;

use super::albedo::ByCosine;
use super::charlie::Charlie;
use super::lobe::{Pair, fifth};
use super::{Parameter, Sequence, ShadingModel};
use crate::brdf::microfacet::{f0_from_ior, schlick};
use crate::{Brdf, Directions, Rgb};

/// Reflectance of clear coat facing the normal: index 1.5.
const COAT: f32 = 0.04;

/// A glTF material; every field is the factor of the same name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GltfPbr {
    /// `baseColorFactor`, 0..1.
    pub base_color: Rgb,
    /// `metallicFactor`, 0..1.
    pub metallic: f32,
    /// `roughnessFactor`, 0..1.
    pub roughness: f32,
    /// `ior` of KHR_materials_ior, from 1; 1.5 without.
    pub ior: f32,
    /// `specularFactor` of KHR_materials_specular, 0..1; 1 without.
    pub specular: f32,
    /// `specularColorFactor`, from 0; white without.
    pub specular_color: Rgb,
    /// `clearcoatFactor` of KHR_materials_clearcoat, 0..1; 0 without.
    pub clearcoat: f32,
    /// `clearcoatRoughnessFactor`, 0..1.
    pub clearcoat_roughness: f32,
    /// `sheenColorFactor` of KHR_materials_sheen, 0..1; black without.
    pub sheen_color: Rgb,
    /// `sheenRoughnessFactor`, 0..1.
    pub sheen_roughness: f32,
}

impl ShadingModel for GltfPbr {
    const NAME: &'static str = "gltf";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::core("baseColorFactor", [0.0, 1.0]).color(),
        Parameter::core("metallicFactor", [0.0, 1.0]),
        Parameter::core("roughnessFactor", [0.03, 1.0]),
        Parameter::of("KHR_materials_ior", "ior", [1.0, 3.0], 1.5, [1.3, 1.9]),
        Parameter::of("KHR_materials_specular", "specularFactor", [0.0, 1.0], 1.0, [0.8, 0.3]),
        Parameter::of("KHR_materials_specular", "specularColorFactor", [0.0, 4.0], 1.0, [1.0, 2.0]).color(),
        Parameter::of("KHR_materials_clearcoat", "clearcoatFactor", [0.0, 1.0], 0.0, [0.5, 0.5]),
        Parameter::of("KHR_materials_clearcoat", "clearcoatRoughnessFactor", [0.03, 1.0], 0.0, [0.15, 0.5]),
        Parameter::of("KHR_materials_sheen", "sheenColorFactor", [0.0, 1.0], 0.0, [0.1, 0.1]).color(),
        Parameter::of("KHR_materials_sheen", "sheenRoughnessFactor", [0.1, 1.0], 0.0, [0.3, 0.7]),
    ];

    fn from_values(values: &[f32]) -> Self {
        let mut next = Sequence::new(values);
        Self {
            base_color: next.color(),
            metallic: next.number(),
            roughness: next.number(),
            ior: next.number(),
            specular: next.number(),
            specular_color: next.color(),
            clearcoat: next.number(),
            clearcoat_roughness: next.number(),
            sheen_color: next.color(),
            sheen_roughness: next.number(),
        }
    }

    fn values(&self) -> Vec<f32> {
        let parts: [&[f32]; 6] = [
            &self.base_color.0,
            &[self.metallic, self.roughness, self.ior, self.specular],
            &self.specular_color.0,
            &[self.clearcoat, self.clearcoat_roughness],
            &self.sheen_color.0,
            &[self.sheen_roughness],
        ];
        parts.concat()
    }

    fn brdf(&self) -> Box<dyn Brdf> {
        let sheen = (self.sheen_color.max() > 0.0).then(|| Charlie::new(self.sheen_roughness));
        Box::new(Evaluated { material: *self, sheen: sheen.map(|sheen| (sheen, sheen.albedo())) })
    }
}

/// The material with what depends on it alone.
struct Evaluated {
    material: GltfPbr,
    sheen: Option<(Charlie, ByCosine)>,
}

impl Evaluated {
    /// mix(dielectric_brdf, metal_brdf, metallic).
    fn base(&self, pair: Pair) -> Rgb {
        let GltfPbr { base_color, metallic, specular, specular_color, .. } = self.material;
        let lobe = pair.ggx_separable(self.material.roughness * self.material.roughness);
        let f0 = specular_color * f0_from_ior(self.material.ior);
        let fresnel = schlick(f0.map(|f0| f0.min(1.0)), pair.diff) * specular;
        let kept = (1.0 - fresnel.max()) * FRAC_1_PI;
        let dielectric = fresnel.zip(base_color, |fresnel, base| kept * base + fresnel * lobe);
        let metal = schlick(base_color, pair.diff) * lobe;
        dielectric.zip(metal, |dielectric, metal| dielectric + (metal - dielectric) * metallic)
    }
}

impl Brdf for Evaluated {
    fn eval(&self, at: Directions) -> Rgb {
        let Some(pair) = Pair::of(at) else { return Rgb::BLACK };
        let GltfPbr { clearcoat, clearcoat_roughness, sheen_color, .. } = self.material;
        let mut value = self.base(pair);
        if let Some((sheen, albedo)) = &self.sheen {
            let kept = 1.0 - sheen_color.max() * albedo.at(pair.view).max(albedo.at(pair.light));
            value = value * kept + sheen_color * sheen.eval(pair);
        }
        if clearcoat > 0.0 {
            let share = clearcoat * (COAT + (1.0 - COAT) * fifth(pair.view));
            let coat = share * pair.ggx_separable(clearcoat_roughness * clearcoat_roughness);
            value = value.map(|value| value * (1.0 - share) + coat);
        }
        value.map(|value| value.max(0.0))
    }
}
