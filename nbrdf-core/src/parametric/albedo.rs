//! Shares of light that a rough layer reflects, by the cosine of the view: what is left for the layer below.
//!
//! E(μ) = ∫ D G / (4 μ cos θ_i) cos θ_i dω_i of a white GGX lobe, and the same with a Fresnel factor, as means of G₂/G₁
//! over the normals that are seen (E. Heitz, *Sampling the GGX Distribution of Visible Normals*, 2018, section 3).

use glam::DVec3;

use crate::brdf::microfacet::ggx_visibility;
use crate::sampler::visible_normals::VisibleNormals;

/// Cosines of the view; between them values are interpolated in √μ.
const NODES: usize = 16;
/// Visible normals for each of them, by polar angle and by azimuth over one half: E is within 0.008 for α up to 1.
const POLAR: u32 = 24;
const AROUND: u32 = 6;
/// Taken for the cosine 0.
const GRAZING: f64 = 1e-3;

/// A function of the cosine of a direction, 0..1.
#[derive(Clone, Copy)]
pub(super) struct ByCosine([f32; NODES]);

impl ByCosine {
    /// Of a function of the cosine.
    pub fn of(function: impl FnMut(f64) -> f64) -> Self {
        let cosine = |node: usize| (node as f64 / (NODES - 1) as f64).powi(2).max(GRAZING);
        let nodes: [usize; NODES] = std::array::from_fn(|node| node);
        Self(nodes.map(cosine).map(function).map(|value| value as f32))
    }

    /// Its value.
    pub fn at(&self, cosine: f32) -> f32 {
        let place = cosine.clamp(0.0, 1.0).sqrt() * (NODES - 1) as f32;
        let below = (place as usize).min(NODES - 2);
        let share = place - below as f32;
        self.0[below] * (1.0 - share) + self.0[below + 1] * share
    }

    /// 2 ∫ f μ dμ: the mean over the hemisphere.
    pub fn mean(&self) -> f32 {
        const STEPS: u32 = 64;
        let middle = |step: u32| (step as f32 + 0.5) / STEPS as f32;
        2.0 / STEPS as f32 * (0..STEPS).map(middle).map(|cos| self.at(cos) * cos).sum::<f32>()
    }
}

/// Share of light that a GGX lobe of roughness `alpha` reflects whose facets reflect `fresnel` of the cosine between
/// view and facet; by the view.
pub(super) fn directional(alpha: f32, fresnel: impl Fn(f32) -> f32) -> ByCosine {
    let alpha = f64::from(alpha).max(1e-3);
    ByCosine::of(|cosine| {
        let view = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
        let mut sum = 0.0;
        for place in 0..POLAR * AROUND {
            let u = (f64::from(place / AROUND) + 0.5) / f64::from(POLAR);
            let v = 0.5 * (f64::from(place % AROUND) + 0.5) / f64::from(AROUND);
            let normal = VisibleNormals { alpha }.normal(view, [u, v]);
            let facing = view.dot(normal);
            let light = 2.0 * facing * normal.z - view.z;
            if light > 0.0 {
                sum += f64::from(fresnel(facing as f32)) * passed(light, cosine, alpha);
            }
        }
        sum / f64::from(POLAR * AROUND)
    })
}

/// G₂ / G₁(ω_o): what of the light that a visible facet reflects is not shadowed.
fn passed(light: f64, view: f64, alpha: f64) -> f64 {
    let a2 = alpha * alpha;
    let masking = 2.0 * view / (view + (a2 + (1.0 - a2) * view * view).sqrt());
    4.0 * light * view * f64::from(ggx_visibility(light as f32, view as f32, alpha as f32)) / masking
}
