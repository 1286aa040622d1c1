//! The encoder's first layer: a network, whatever its neuron order and scale, becomes its values at fixed directions.

use std::f32::consts::{FRAC_PI_2, TAU};

use nbrdf_core::brdf::Prepared;
use nbrdf_core::nbrdf::objective::DARKEST;
use nbrdf_core::{Brdf, Directions, Rgb, Rusinkiewicz};

/// Probed directions.
pub const PROBES: usize = 192;
/// Share of the probes that crowd towards small θ_half, where glossy materials differ.
const WARPED: f64 = 0.6;

/// The directions, a deterministic low-discrepancy set (R₃, M. Roberts 2018), all above the horizon.
pub fn probe_directions() -> Vec<Directions> {
    const G: f64 = 1.220_744_084_605_759_6;
    let fraction = |k: usize, power: i32| (0.5 + (k as f64) * G.powi(-power)).fract();
    let candidate = |k: usize, warped: bool| {
        let t = fraction(k, 1) as f32;
        Rusinkiewicz {
            theta_half: FRAC_PI_2 * if warped { t * t * t } else { t },
            theta_diff: FRAC_PI_2 * fraction(k, 2) as f32,
            phi_diff: TAU * fraction(k, 3) as f32,
            phi_half: 0.0,
        }
        .directions()
    };
    let warped = (PROBES as f64 * WARPED).round() as usize;
    let above = |warped| (1..).map(move |k| candidate(k, warped)).filter(|at: &Directions| at.is_above());
    above(true).take(warped).chain(above(false).take(PROBES - warped)).collect()
}

/// The probes, ready to be asked of many materials.
pub struct Probes {
    at: Prepared,
}

impl Probes {
    /// At [`probe_directions`].
    pub fn new() -> Self {
        Self { at: Prepared::new(probe_directions()) }
    }

    /// Reflectance at every probe.
    pub fn probe(&self, brdf: &dyn Brdf) -> Vec<Rgb> {
        let mut values = vec![Rgb::BLACK; self.at.len()];
        brdf.eval_prepared(&self.at, &mut values);
        values
    }

    /// Encoder input \[3, 3 · probes\]: for each channel its own t, the channels' mean, their mean absolute deviation,
    /// with t = (ln(f cos θ_i + 10⁻³) + 3.5) / 2.
    pub fn features(&self, values: &[Rgb]) -> Vec<f32> {
        let scaled = |(at, f): (&Directions, &Rgb)| f.map(|f| ((f.max(0.0) * at.light.z + DARKEST).ln() + 3.5) * 0.5);
        let t: Vec<Rgb> = self.at.directions().iter().zip(values).map(scaled).collect();
        let [mean, deviation]: [Vec<f32>; 2] =
            [t.iter().map(|t| t.mean()).collect(), t.iter().map(|t| t.map(|v| (v - t.mean()).abs()).mean()).collect()];
        let mut features = Vec::with_capacity(9 * t.len());
        for channel in 0..3 {
            features.extend(t.iter().map(|t| t[channel]));
            features.extend_from_slice(&mean);
            features.extend_from_slice(&deviation);
        }
        features
    }
}
