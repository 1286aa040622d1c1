//! What a viewer sees under white light, light by light: the integrand that samplers are fitted to and judged by.
//!
//! One sample of a density p estimates L = ∫ f̄ cos θ_i dω_i by f̄ cos θ_i / p. Its second moment relative to the squared
//! mean is M = ∫ (f̄ cos θ_i)² / p dω_i / L², and M − 1 its relative variance (M. Pharr, W. Jakob, G. Humphreys,
//! *Physically Based Rendering*, 4th ed. 2023, section 2.2). f̄ is the mean of red, green and blue: which colour the
//! lights have is not known here.

use std::{
    f64::consts::{FRAC_1_PI, PI},
    sync::OnceLock,
};

use super::disk::Disk;
use crate::{Brdf, Directions, Rgb};

/// Polar angles of the viewers \[degrees\]: 0, 10, ..., 80.
pub(super) fn viewers() -> impl Iterator<Item = f64> {
    (0..=8).map(|k| f64::from(k) * 10.0)
}

/// What one viewer sees.
pub(super) struct Outgoing {
    /// Lights over the hemisphere, and the viewer.
    pub(super) at: &'static [Directions],
    /// L, the directional albedo of f̄.
    pub(super) albedo: f64,
    /// What each light adds to M if p is the cosine's, cos θ_i / π: π f̄² cos θ_i dω_i / L².
    pub(super) moments: Vec<f64>,
}

impl Outgoing {
    /// Towards every viewer that sees anything; none if any reflectance is not finite.
    pub(super) fn towards_viewers(brdf: &dyn Brdf) -> Option<Vec<Self>> {
        static DISKS: OnceLock<Vec<Disk>> = OnceLock::new();
        let disks = DISKS.get_or_init(|| viewers().map(|degrees| Disk::around_mirror(degrees.to_radians())).collect());
        let seen: Option<Vec<Self>> = disks.iter().map(|disk| Self::over(disk, brdf)).collect();
        Some(seen?.into_iter().filter(|outgoing| outgoing.albedo > 0.0).collect())
    }

    fn over(disk: &'static Disk, brdf: &dyn Brdf) -> Option<Self> {
        let mut values = vec![Rgb::BLACK; disk.at.len()];
        brdf.eval_into(&disk.at, &mut values);
        let weighed = values.iter().zip(&disk.at).zip(&disk.solid_angle);
        let (mean, projected): (Vec<f64>, Vec<f64>) =
            weighed.map(|((value, at), angle)| (f64::from(value.mean()), f64::from(at.light.z) * angle)).unzip();
        let albedo: f64 = mean.iter().zip(&projected).map(|(mean, projected)| mean * projected).sum();
        let moment = |(mean, projected): (&f64, &f64)| PI * (mean / albedo) * (mean / albedo) * projected;
        let moments = mean.iter().zip(&projected).map(moment).collect();
        albedo.is_finite().then_some(Self { at: &disk.at, albedo, moments })
    }

    /// M for a density \[1/sr\]; 1 for the perfect one.
    pub(super) fn second_moment(&self, pdf: impl Fn(Directions) -> f64) -> f64 {
        let base = |at: Directions| f64::from(at.light.z) * FRAC_1_PI;
        self.at.iter().zip(&self.moments).map(|(&at, moment)| moment * base(at) / pdf(at)).sum()
    }
}
