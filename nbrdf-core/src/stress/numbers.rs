//! Numbers out of the ordinary: weights in disguise, codes far away, materials of next to no and of too much light.

use rand::RngExt;

use super::hazard::{BY_HALF, Group, Hazard, WITHIN_A_FIFTH};
use crate::brdf::lambert::Lambert;
use crate::nbrdf::fit::generator;
use crate::nbrdf::precision::Precision;
use crate::nbrdf::symmetry::{permute, rescale};
use crate::sampling::{evaluate, rus32k};
use crate::{Brdf, Directions, Nbrdf, Rgb};

/// A hazard, and the network that encoding is given in place of another one.
pub struct Retold {
    /// The hazard.
    pub hazard: Hazard,
    /// The other network.
    pub network: fn(&Nbrdf, u64) -> Nbrdf,
}

const ADDED: &str = "log_error against the network given, less that of encoding it by its usual weights";

/// The same materials, told by other weights.
pub const RETOLD: [Retold; 3] = [
    Retold {
        hazard: Hazard { holds: 5e-4, ..shift("disguised", "Hidden units reordered and rescaled: the same function") },
        network: disguised,
    },
    Retold {
        hazard: shift("half_weights", "Weights in half precision"),
        network: |network, _| Precision::Half.round(network),
    },
    Retold { hazard: shift("byte_weights", "Weights in bytes"), network: |network, _| Precision::Byte.round(network) },
];

/// Materials of which nothing but their brightness is changed, by these factors.
pub const BRIGHTNESS: [(Hazard, f32); 2] = [
    (relative("dim", "A hundredth of the reflectance"), 0.01),
    (relative("bright", "A hundred times the reflectance: more than nature allows"), 100.0),
];

/// Materials that networks with dead units stand for: the same everywhere.
pub const CONSTANT: Hazard = Hazard {
    measure: "log_error, the worst of black, grey and white",
    holds: 0.002,
    ..shift("constant", "Networks without a living unit: black, grey and white everywhere")
};

/// Codes times this, and worse.
pub const FAR_CODES: [f32; 5] = [3.0, 30.0, 1e4, 1e30, f32::INFINITY];

/// Codes that no material has.
pub const FAR: Hazard = Hazard {
    measure: "share of answers that are not finite, or negative",
    holds: 0.0,
    fails: 0.0,
    ..shift("far_codes", "Codes times 3, 30, 10⁴, 10³⁰; nothing but zeros; the largest numbers there are")
};

/// Reflectances at the lower end of what numbers can be.
pub const DENORMAL: Hazard = Hazard {
    measure: "share of answers that are not finite, or negative",
    holds: 0.0,
    fails: 0.0,
    ..shift("denormal", "Reflectances of 10⁻⁴⁰, which are no normal numbers")
};

const fn shift(name: &'static str, title: &'static str) -> Hazard {
    Hazard { name, group: Group::Numbers, title, measure: ADDED, holds: 0.002, fails: 0.01 }
}

const fn relative(name: &'static str, title: &'static str) -> Hazard {
    Hazard {
        measure: "mean |ln(f cos + 0.001) − ln(g cos + 0.001)|, brightness undone",
        holds: WITHIN_A_FIFTH,
        fails: BY_HALF,
        ..shift(name, title)
    }
}

/// The same function by other weights.
fn disguised(network: &Nbrdf, seed: u64) -> Nbrdf {
    let rng = &mut generator(seed, 20);
    let mut order = |count: usize| {
        let mut order: Vec<usize> = (0..count).collect();
        (1..count).rev().for_each(|last| order.swap(last, rng.random_range(0..=last)));
        order
    };
    let orders = network.hidden().map(&mut order);
    let permuted = permute(network, [&orders[0], &orders[1]]);
    // Powers of two: the function stays the same to the bit.
    let mut factors = |count: usize| (0..count).map(|_| 2f32.powi(rng.random_range(-3..=3))).collect::<Vec<_>>();
    let factors = network.hidden().map(&mut factors);
    rescale(&permuted, [&factors[0], &factors[1]])
}

/// The materials of [`CONSTANT`], with their names.
pub fn constants() -> [(&'static str, Lambert); 3] {
    [("black", 0.0), ("grey", 0.5), ("white", 1.0)].map(|(name, v)| (name, Lambert { albedo: Rgb::splat(v) }))
}

/// A reflectance times a factor.
pub struct Scaled<B> {
    /// The reflectance.
    pub inner: B,
    /// For each channel.
    pub scale: Rgb,
}

impl<B: AsRef<dyn Brdf> + Send + Sync + 'static> Brdf for Scaled<B> {
    fn eval(&self, at: Directions) -> Rgb {
        self.inner.as_ref().eval(at).zip(self.scale, |f, scale| f * scale)
    }

    fn eval_into(&self, at: &[Directions], out: &mut [Rgb]) {
        self.inner.as_ref().eval_into(at, out);
        out.iter_mut().for_each(|f| *f = f.zip(self.scale, |f, scale| f * scale));
    }
}

/// Share of directions at which a reflectance is not finite, or negative.
pub fn unsound_share(brdf: &dyn Brdf) -> f64 {
    let at = &rus32k()[..2048];
    let wrong = evaluate(brdf, at).into_iter().filter(|f| !(f.is_finite() && f.min() >= 0.0)).count();
    wrong as f64 / at.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::library::builtin;
    use crate::metric::{LogError, Metric};

    #[test]
    fn a_disguise_changes_the_weights_and_not_the_function() {
        let chrome = &builtin::shared().get("chrome").unwrap().network;
        for seed in 0..4 {
            let other = disguised(chrome, seed);
            assert_ne!(&other, chrome);
            assert!(LogError.distance(chrome, &other) < 1e-6);
        }
    }

    #[test]
    fn what_is_not_a_reflectance_is_counted() {
        let grey: std::sync::Arc<dyn Brdf> = std::sync::Arc::new(constants()[1].1);
        let times = |scale: f32| unsound_share(&Scaled { inner: grey.clone(), scale: Rgb([scale, 1.0, 1.0]) });
        assert_eq!([1.0, -1.0, f32::INFINITY].map(times), [0.0, 1.0, 1.0]);
    }
}
