//! Where fits begin: dielectrics and metals of several roughnesses, coloured as the material looks.

use super::ShadingModel;
use crate::Rgb;
use crate::brdf::free_fresnel::{Facets, FreeFresnel};
use crate::representation::analytic::Target;

/// Roughnesses that are tried.
const ROUGHNESSES: [f32; 6] = [0.06, 0.13, 0.25, 0.4, 0.6, 0.85];

/// All numbers of each start, those beyond the core neutral.
pub(super) fn starts<M: ShadingModel>(seen: &Target) -> Vec<Vec<f32>> {
    let base = seen.base();
    let within = |color: Rgb| color.map(|v| v.clamp(0.02, 0.95));
    let neutral = |parameter: &super::Parameter| vec![parameter.neutral; parameter.size];
    let rest: Vec<f32> = M::PARAMETERS.iter().skip(3).flat_map(neutral).collect();
    let start = |color: Rgb, metallic: f32, roughness: f32| [&color.0[..], &[metallic, roughness], &rest].concat();
    let of_roughness = |roughness: f32| {
        let white = Rgb::splat(1.0);
        let alpha = roughness * roughness;
        let lobe = FreeFresnel { diffuse: Rgb::BLACK, f0: white, f90: white, alpha, facets: Facets::Ggx };
        let metal = within(seen.brightness(Rgb::BLACK, &lobe));
        [start(within(Target::albedo(base)), 0.03, roughness), start(metal, 0.97, roughness)]
    };
    ROUGHNESSES.into_iter().flat_map(of_roughness).collect()
}
