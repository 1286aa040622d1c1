//! What all shading models are made of: the half vector's cosines, GGX, and Fresnel reflectances.

use crate::brdf::microfacet::{ggx_distribution, ggx_visibility};
use crate::{Directions, Rgb, Vec3};

/// Cosines below are taken as this, so that every lobe is finite.
const GRAZING: f32 = 1e-6;
/// The same of α.
const SMOOTHEST: f32 = 1e-3;
/// Cosine of the angle, about 82°, at which the edge tint of metals is given.
const EDGE: f32 = 1.0 / 7.0;

/// A pair above the surface in what lobes read of it.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    pub half: Vec3,
    /// cos θ_i, cos θ_o and the cosine between view and half vector.
    pub light: f32,
    pub view: f32,
    pub diff: f32,
}

impl Pair {
    /// None below the surface.
    pub fn of(at: Directions) -> Option<Self> {
        let half = (at.light + at.view).normalize_or(Vec3::Z);
        let [light, view] = [at.light.z, at.view.z].map(|cos| cos.clamp(GRAZING, 1.0));
        at.is_above().then(|| Self { half, light, view, diff: at.view.dot(half).clamp(0.0, 1.0) })
    }

    /// D G / (4 cos θ_i cos θ_o) with the height-correlated G.
    pub fn ggx(self, alpha: f32) -> f32 {
        let alpha = alpha.max(SMOOTHEST);
        ggx_distribution(self.half, alpha) * ggx_visibility(self.light, self.view, alpha)
    }

    /// The same with G = G₁(ω_i) G₁(ω_o), as glTF has it.
    pub fn ggx_separable(self, alpha: f32) -> f32 {
        let alpha = alpha.max(SMOOTHEST);
        let a2 = alpha * alpha;
        let side = |cos: f32| cos + (a2 + (1.0 - a2) * cos * cos).sqrt();
        ggx_distribution(self.half, alpha) / (side(self.light) * side(self.view))
    }
}

/// (1 − cos)⁵.
pub(super) fn fifth(cos: f32) -> f32 {
    (1.0 - cos).clamp(0.0, 1.0).powi(5)
}

/// Reflectance of a smooth dielectric of index `ior` ≥ 1 in air (Walter et al. 2007, eq. 22).
pub(super) fn dielectric(ior: f32, cos: f32) -> f32 {
    let g = (ior * ior - 1.0 + cos * cos).max(0.0).sqrt();
    let across = (g - cos) / (g + cos).max(1e-9);
    let along = (cos * (g + cos) - 1.0) / (cos * (g - cos) + 1.0);
    0.5 * across * across * (1.0 + along * along)
}

/// A metal's reflectance by its colour facing and at 82° relative to Schlick's.
///
/// C. Kutz, M. Hašan, L. Edmondson, *Novel Aspects of the Adobe Standard Material* (2021), the "F82-tint" model.
#[derive(Clone, Copy)]
pub(super) struct Metal {
    f0: Rgb,
    dip: Rgb,
}

impl Metal {
    pub fn new(f0: Rgb, tint: Rgb) -> Self {
        let at_edge = f0.map(|f0| f0 + (1.0 - f0) * fifth(EDGE));
        let dip = at_edge.zip(tint, |edge, tint| edge * (1.0 - tint) / (EDGE * (1.0 - EDGE).powi(6)));
        Self { f0, dip }
    }

    /// F at the cosine between view and half vector.
    pub fn fresnel(self, cos: f32) -> Rgb {
        let grazing = (1.0 - cos).clamp(0.0, 1.0);
        let (fifth, sixth) = (grazing.powi(5), grazing.powi(6));
        self.f0.zip(self.dip, |f0, dip| (f0 + (1.0 - f0) * fifth - dip * cos * sixth).clamp(0.0, 1.0))
    }

    /// 2 ∫ F cos d cos, its mean over the hemisphere.
    pub fn mean(self) -> Rgb {
        self.f0.zip(self.dip, |f0, dip| (f0 + (1.0 - f0) / 21.0 - dip / 126.0).clamp(0.0, 1.0))
    }
}
