//! What is written.

use std::any::Any;

use nbrdf_core::direction::turned;
use nbrdf_core::nbrdf::anisotropic::AnisotropicNbrdf;
use nbrdf_core::sampling::{evaluate, rus32k};
use nbrdf_core::{Code, Directions, Material, Nbrdf, Rgb};

/// Every so many pairs of directions are turned.
const EVERY: usize = 256;
/// By how much they are turned \[rad\].
const ANGLES: [f32; 3] = [0.7, 1.6, 2.6];
/// Relative differences that are those of rounded directions.
const ROUNDING: f32 = 0.01;

/// What is written.
pub struct Subject<'a> {
    /// The material.
    pub material: &'a Material,
    /// Its code, where it has one.
    pub code: Option<&'a Code>,
}

impl Subject<'_> {
    /// The network behind the material, if it is one.
    pub fn network(&self) -> Option<&Nbrdf> {
        self.material.network.as_ref().or_else(|| self.behind())
    }

    /// The network of a material that changes when it is turned.
    pub fn turning(&self) -> Option<&AnisotropicNbrdf> {
        self.behind()
    }

    /// Whether the reflectance changes when the material is turned: a network that does may be mixed into others, so some
    /// pairs are asked.
    pub fn changes_when_turned(&self) -> bool {
        let brdf = self.material.brdf.as_ref();
        let at: Vec<Directions> = rus32k().iter().step_by(EVERY).copied().collect();
        let plain = evaluate(brdf, &at);
        let differs = |angle: f32| {
            let turned: Vec<Directions> = at.iter().map(|&at| turned(at, angle)).collect();
            let values = evaluate(brdf, &turned);
            Rgb::flat(&values).iter().zip(Rgb::flat(&plain)).any(|(a, b)| (a - b).abs() > ROUNDING * (a.max(*b) + 0.01))
        };
        self.turning().is_some() || ANGLES.into_iter().any(differs)
    }

    fn behind<T: 'static>(&self) -> Option<&T> {
        let brdf: &dyn Any = self.material.brdf.as_ref();
        brdf.downcast_ref()
    }
}
