//! Sheen of upright fibres: D = (2 + 1/α) sin^(1/α) θ_half / (2π), G by a fit of Λ.
//!
//! A. Conty Estevez, C. Kulla, *Production Friendly Microfacet Sheen BRDF* (2017), sections 2 and 3; as KHR_materials_sheen
//! has it, with α the square of its roughness.

use std::f32::consts::{PI, TAU};

use super::albedo::ByCosine;
use super::lobe::Pair;
use crate::direction::spherical;
use crate::{Directions, Vec3};

/// Lights of [`Charlie::albedo`] by cosine, spaced as its square, and by azimuth over one half.
const RINGS: u32 = 24;
const AROUND: u32 = 16;

/// A sheen of one roughness.
#[derive(Clone, Copy)]
pub(super) struct Charlie {
    alpha: f32,
    /// a, b, c, d, e of the fit of Λ.
    fit: [f32; 5],
}

impl Charlie {
    pub fn new(roughness: f32) -> Self {
        let alpha = (roughness * roughness).max(5e-3);
        let share = (1.0 - alpha) * (1.0 - alpha);
        let rough = [21.5473, 3.82987, 0.19823, -1.97760, -4.32054];
        let smooth = [25.3245, 3.32435, 0.16801, -1.27393, -4.85967];
        let fit = std::array::from_fn(|i| rough[i] + (smooth[i] - rough[i]) * share);
        Self { alpha, fit }
    }

    /// D G / (4 cos θ_i cos θ_o).
    pub fn eval(&self, pair: Pair) -> f32 {
        let inverse = 1.0 / self.alpha;
        let sine2 = pair.half.x * pair.half.x + pair.half.y * pair.half.y;
        let density = (2.0 + inverse) * sine2.min(1.0).powf(0.5 * inverse) / TAU;
        let hidden = 1.0 + self.lambda(pair.view) + self.lambda(pair.light);
        density / (hidden * 4.0 * pair.light * pair.view)
    }

    /// The share of light that it reflects when white, by the view.
    pub fn albedo(&self) -> ByCosine {
        ByCosine::of(|cosine| {
            let view = Vec3::new((1.0 - cosine * cosine).max(0.0).sqrt() as f32, 0.0, cosine as f32);
            let mut sum = 0.0;
            for place in 0..RINGS * AROUND {
                let t = ((place / AROUND) as f32 + 0.5) / RINGS as f32;
                let around = PI * ((place % AROUND) as f32 + 0.5) / AROUND as f32;
                let light = spherical((t * t).acos(), around);
                if let Some(pair) = Pair::of(Directions::new(light, view)) {
                    // dω cos θ_i = 2 t dt · cos θ_i dφ with cos θ_i = t².
                    sum += f64::from(self.eval(pair) * 2.0 * t * t * t);
                }
            }
            (sum * f64::from(TAU) / f64::from(RINGS * AROUND)).min(1.0)
        })
    }

    fn lambda(&self, cosine: f32) -> f32 {
        let [a, b, c, d, e] = self.fit;
        let fitted = |x: f32| a / (1.0 + b * x.powf(c)) + d * x + e;
        if cosine < 0.5 { fitted(cosine).exp() } else { (2.0 * fitted(0.5) - fitted(1.0 - cosine)).exp() }
    }
}
