//! Blender's Principled BSDF without subsurface, transmission, sheen, thin film and anisotropy.
//!
//! As Cycles of Blender 4.0 and newer evaluates it with distribution *Multiscatter GGX*: coat over metal mixed with specular over diffuse.
//! Modelled: GGX with height-correlated masking; F82-tint metals; the specular layer's Fresnel, from F₀ times the tint to
//! white along the exact curve of the index; light scattered more than once by 1 + F_ms (1 − E)/E (C. Kulla, A. Conty,
//! *Revisiting Physically Based Shading at Imageworks*, 2017); layers by albedo scaling with the largest channel, of the coat by its
//! Fresnel reflectance at the view's own cosine. Not reciprocal. Approximated: Cycles reads E and the specular albedo from tables,
//! here they are integrated. Fixed: *Specular IOR Level* 0.5, *Coat IOR* 1.5, *Coat Tint* white, *Diffuse Roughness* 0.

mod file;

use std::f32::consts::FRAC_1_PI;

use super::albedo::{ByCosine, directional};
use super::lobe::{Metal, Pair, dielectric};
use super::{Parameter, Sequence, ShadingModel};
use crate::brdf::microfacet::f0_from_ior;
use crate::{Brdf, Directions, Rgb};

/// *Coat IOR*.
const COAT_IOR: f32 = 1.5;

/// A Principled BSDF; every field is the input of the same name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Principled {
    /// *Base Color*, 0..1.
    pub base_color: Rgb,
    /// *Metallic*, 0..1.
    pub metallic: f32,
    /// *Roughness*, 0..1.
    pub roughness: f32,
    /// *IOR*, from 1.
    pub ior: f32,
    /// *Specular Tint*, 0..1: of a dielectric's F₀, of a metal's reflectance at 82°.
    pub specular_tint: Rgb,
    /// *Coat Weight*, 0..1.
    pub coat: f32,
    /// *Coat Roughness*, 0..1.
    pub coat_roughness: f32,
}

impl ShadingModel for Principled {
    const NAME: &'static str = "principled";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::core("Base Color", [0.0, 1.0]).color(),
        Parameter::core("Metallic", [0.0, 1.0]),
        Parameter::core("Roughness", [0.03, 1.0]),
        Parameter::of("Specular", "IOR", [1.0, 3.0], 1.5, [1.4, 1.9]),
        Parameter::of("Specular", "Specular Tint", [0.0, 1.0], 1.0, [0.9, 0.6]).color(),
        Parameter::of("Coat", "Coat Weight", [0.0, 1.0], 0.0, [0.5, 0.5]),
        Parameter::of("Coat", "Coat Roughness", [0.03, 1.0], 0.0, [0.15, 0.5]),
    ];

    fn from_values(values: &[f32]) -> Self {
        let mut next = Sequence::new(values);
        Self {
            base_color: next.color(),
            metallic: next.number(),
            roughness: next.number(),
            ior: next.number(),
            specular_tint: next.color(),
            coat: next.number(),
            coat_roughness: next.number(),
        }
    }

    fn values(&self) -> Vec<f32> {
        let parts: [&[f32]; 4] = [
            &self.base_color.0,
            &[self.metallic, self.roughness, self.ior],
            &self.specular_tint.0,
            &[self.coat, self.coat_roughness],
        ];
        parts.concat()
    }

    fn brdf(&self) -> Box<dyn Brdf> {
        let alpha = self.roughness * self.roughness;
        let white = directional(alpha, |_| 1.0);
        let f0 = self.specular_tint * f0_from_ior(self.ior);
        // The mean Fresnel reflectance of an index (the same slides, appendix).
        let mean = (self.ior - 1.0) / (4.08567 + 1.00071 * self.ior);
        let metal = Metal::new(self.base_color, self.specular_tint);
        let share = share(self.ior, mean);
        let bounces = |once: Rgb| once.map(|once| once * white.mean() / (1.0 - once * (1.0 - white.mean())));
        Box::new(Evaluated {
            material: *self,
            alpha,
            white,
            own: directional(alpha, |cos| dielectric(self.ior, cos)),
            f0,
            specular_bounces: bounces(f0.map(|f0| f0 + (1.0 - f0) * share)),
            metal,
            metal_bounces: bounces(metal.mean()),
        })
    }
}

/// How far the reflectance of an index is on its way from that facing the normal to 1.
fn share(ior: f32, fresnel: f32) -> f32 {
    let f0 = f0_from_ior(ior);
    ((fresnel - f0) / (1.0 - f0)).clamp(0.0, 1.0)
}

/// The material with what depends on it alone.
struct Evaluated {
    material: Principled,
    alpha: f32,
    /// E of a white lobe, and of one with the exact Fresnel reflectance.
    white: ByCosine,
    own: ByCosine,
    f0: Rgb,
    /// F_ms.
    specular_bounces: Rgb,
    metal: Metal,
    metal_bounces: Rgb,
}

impl Evaluated {
    /// F₀ to white by the Fresnel reflectance of the index.
    fn fresnel(&self, of_index: f32) -> Rgb {
        let share = share(self.material.ior, of_index);
        self.f0.map(|f0| f0 + (1.0 - f0) * share)
    }
}

impl Brdf for Evaluated {
    fn eval(&self, at: Directions) -> Rgb {
        let Some(pair) = Pair::of(at) else { return Rgb::BLACK };
        let Principled { base_color, metallic, ior, coat, coat_roughness, .. } = self.material;
        let lobe = pair.ggx(self.alpha);
        let white = self.white.at(pair.view).clamp(1e-2, 1.0);
        let more = (1.0 - white) / white;
        let often = |fresnel: Rgb, bounces: Rgb| fresnel.zip(bounces, |once, often| once * lobe * (1.0 + often * more));
        let metal = often(self.metal.fresnel(pair.diff), self.metal_bounces);
        let specular = often(self.fresnel(dielectric(ior, pair.diff)), self.specular_bounces);
        let kept = 1.0 - self.fresnel(self.own.at(pair.view) / white).max();
        let glossy = specular.zip(base_color, |specular, base| specular + base * kept * FRAC_1_PI);
        let mut value = glossy.zip(metal, |glossy, metal| glossy + (metal - glossy) * metallic);
        if coat > 0.0 {
            let kept = 1.0 - coat * dielectric(COAT_IOR, pair.view);
            let own = coat * dielectric(COAT_IOR, pair.diff) * pair.ggx(coat_roughness * coat_roughness);
            value = value.map(|value| value * kept + own);
        }
        value.map(|value| value.max(0.0))
    }
}
