//! What a fit sees of a material.

use std::sync::OnceLock;

use crate::brdf::Prepared;
use crate::sampling::{even_shares, half_difference};
use crate::simd::logarithms;
use crate::{Brdf, Directions, Rgb};

/// Pairs of directions.
const PAIRS: usize = 3072;

/// Where reflectances are compared.
pub(super) struct Places {
    /// Pairs above the surface.
    pub at: Prepared,
    /// cos θ_i.
    pub cosines: Vec<f32>,
    /// What each counts; they sum to 1.
    pub weights: Vec<f32>,
}

/// The same for all materials. θ_half is spaced as u², as MERL's cells are (W. Matusik et al. 2003, section 3), so that highlights narrower than a degree
/// are seen; each pair counts as much as it stands for among even angles, so that the loss is the metric's.
/// None of the pairs is one of the metric's.
fn places() -> &'static Places {
    static PLACES: OnceLock<Places> = OnceLock::new();
    PLACES.get_or_init(|| {
        let spaced = even_shares().map(|[u, diff, around]| (half_difference([u * u, diff, around]), u));
        let found: Vec<(Directions, f32)> = spaced.filter(|(at, _)| at.is_above()).take(PAIRS).collect();
        let (at, counts) = found.into_iter().unzip();
        Places::new(at, counts)
    })
}

impl Places {
    /// Pairs and what each counts, in any unit.
    pub fn new(at: Vec<Directions>, mut counts: Vec<f32>) -> Self {
        let sum: f32 = counts.iter().sum();
        counts.iter_mut().for_each(|count| *count /= sum);
        Self { cosines: at.iter().map(|at| at.light.z).collect(), weights: counts, at: Prepared::new(at) }
    }

    /// ln(1 + f_r cos θ_i), channel by channel within each pair.
    pub fn logs(&self, values: &[Rgb]) -> Vec<f32> {
        let pairs = values.iter().zip(&self.cosines);
        let mut logs: Vec<f32> = pairs.flat_map(|(f, cos)| f.map(|f| 1.0 + f.max(0.0) * cos).0).collect();
        logarithms(&mut logs);
        logs
    }
}

/// A material at some places.
pub struct Target<'a> {
    pub(super) places: &'a Places,
    /// f_r \[1/sr\].
    pub values: Vec<Rgb>,
    /// ln(1 + f_r cos θ_i), channel by channel within each pair.
    pub logs: Vec<f32>,
}

impl<'a> Target<'a> {
    /// Looks at a material; none where it is not finite.
    pub(crate) fn of(brdf: &dyn Brdf) -> Option<Self> {
        let mut values = vec![Rgb::BLACK; PAIRS];
        brdf.eval_prepared(&places().at, &mut values);
        values.iter().all(|f| f.is_finite()).then(|| Self::measured(places(), values))
    }

    /// What was measured at these places, finite.
    pub(super) fn measured(places: &'a Places, values: Vec<Rgb>) -> Self {
        Self { logs: places.logs(&values), values, places }
    }

    /// About the reflectance of the base: what a fifth of the pairs with tilted half vectors are below, per channel.
    pub(crate) fn base(&self) -> Rgb {
        let tilted = self.places.at.directions().iter().map(|at| at.rusinkiewicz().theta_half > 0.5);
        let seen: Vec<Rgb> = self.values.iter().zip(tilted).filter(|(_, tilted)| *tilted).map(|(f, _)| *f).collect();
        Rgb([0, 1, 2].map(|channel| {
            let mut values: Vec<f32> = seen.iter().map(|f| f[channel]).collect();
            values.sort_by(f32::total_cmp);
            values.get(values.len() / 5).copied().unwrap_or_default().max(0.0)
        }))
    }

    /// k_d of such a base, to begin with: a black channel would not move from its logarithm.
    pub(crate) fn albedo(base: Rgb) -> Rgb {
        (base * std::f32::consts::PI).map(|albedo| albedo.max(1e-3))
    }

    /// How bright a lobe of this shape is that stands for what is above the base: least squares of f cos θ_i, per channel.
    pub(crate) fn brightness(&self, base: Rgb, shape: &dyn Brdf) -> Rgb {
        let places = self.places;
        let mut lobe = vec![Rgb::BLACK; places.at.len()];
        shape.eval_prepared(&places.at, &mut lobe);
        Rgb([0, 1, 2].map(|channel| {
            let (mut both, mut own) = (0.0, 0.0);
            for (i, (f, lobe)) in self.values.iter().zip(&lobe).enumerate() {
                let counts = f64::from(places.weights[i]) * f64::from(places.cosines[i]).powi(2);
                let lobe = f64::from(lobe[channel]);
                both += counts * lobe * f64::from((f[channel] - base[channel]).max(0.0));
                own += counts * lobe * lobe;
            }
            if own > 0.0 { (both / own) as f32 } else { 0.0 }
        }))
    }
}
