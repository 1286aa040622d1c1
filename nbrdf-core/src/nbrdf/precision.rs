//! Weights in fewer bits: what a network loses when it is stored in half precision or in bytes.
//!
//! Bytes are symmetric and scaled unit by unit (B. Jacob et al., *Quantization and Training of Neural Networks for Efficient
//! Integer-Arithmetic-Only Inference* (2018), section 2.1, zero point 0): each unit's incoming weights share one scale, so
//! that a unit of small weights loses no more than one of large. Biases and scales stay in half precision. Evaluation
//! is in single precision whatever is stored.

use half::f16;

use super::{Layout, Nbrdf, weight_count};

/// Largest magnitude of a byte.
const LARGEST: f32 = 127.0;

/// Bits of a stored weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// 32: as fitted.
    Single,
    /// 16: three digits.
    Half,
    /// 8, with a scale for each unit.
    Byte,
}

impl Precision {
    /// Bytes of a stored network of these hidden widths: 2700, 1350, 810 for (21, 21).
    pub const fn bytes(self, hidden: [usize; 2]) -> usize {
        let count = weight_count(hidden);
        let units = hidden[0] + hidden[1] + 3;
        match self {
            Self::Single => 4 * count,
            Self::Half => 2 * count,
            // Weights in bytes; bias and scale of every unit in two.
            Self::Byte => count - units + 2 * (2 * units),
        }
    }

    /// The network as it is read back after being stored; rounding twice is rounding once.
    pub fn round(self, network: &Nbrdf) -> Nbrdf {
        let mut weights = network.weights().to_vec();
        match self {
            Self::Single => {}
            Self::Half => weights.iter_mut().for_each(|w| *w = half(*w)),
            Self::Byte => to_bytes(&mut weights, &network.layout()),
        }
        Nbrdf::of_valid(network.hidden(), weights)
    }
}

fn to_bytes(weights: &mut [f32], layout: &Layout) {
    for (kernel, bias) in &layout.layers {
        weights[bias.clone()].iter_mut().for_each(|b| *b = half(*b));
        let units = bias.len();
        for unit in 0..units {
            let own = || kernel.clone().skip(unit).step_by(units);
            let largest = own().fold(0.0f32, |largest, i| largest.max(weights[i].abs()));
            // A scale that half precision takes for zero belongs to weights that are as good as zero.
            let scale = half(largest / LARGEST);
            let stored = |w: f32| if scale > 0.0 { (w / scale).round().clamp(-LARGEST, LARGEST) * scale } else { 0.0 };
            own().for_each(|i| weights[i] = stored(weights[i]));
        }
    }
}

/// Through half precision; what is too large for it becomes its largest.
fn half(v: f32) -> f32 {
    f16::from_f32(v.clamp(-f16::MAX.to_f32(), f16::MAX.to_f32())).to_f32()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::library::builtin;
    use crate::metric::{LogError, Metric};
    use crate::nbrdf::PUBLISHED_HIDDEN;

    const ALL: [Precision; 3] = [Precision::Single, Precision::Half, Precision::Byte];

    #[test]
    fn fewer_bits_lose_more_and_half_precision_nearly_nothing() {
        assert_eq!(ALL.map(|precision| precision.bytes(PUBLISHED_HIDDEN)), [2700, 1350, 810]);
        let chrome = &builtin::shared().get("chrome").unwrap().network;
        let [single, half, byte] = ALL.map(|precision| LogError.distance(chrome, &precision.round(chrome)));
        println!("chrome: log_error {half:.5} in half precision, {byte:.5} in bytes");
        assert!(single == 0.0 && half > 0.0 && half < 1e-3 && byte > half && byte < 0.02, "{half} {byte}");
    }

    #[test]
    fn rounding_twice_is_rounding_once() {
        for precision in ALL {
            for name in ["chrome", "blue-fabric", "rgl/paper_white"] {
                let once = precision.round(&builtin::shared().get(name).unwrap().network);
                assert_eq!(precision.round(&once), once, "{name} {precision:?}");
            }
        }
    }

    #[test]
    fn weights_too_large_or_too_small_for_few_bits_stay_finite() {
        let count = weight_count(PUBLISHED_HIDDEN);
        for extreme in [f32::MAX, f32::MIN_POSITIVE, -1e30, 0.0] {
            let network = Nbrdf::published(vec![extreme; count]).unwrap();
            for precision in ALL {
                assert!(precision.round(&network).weights().iter().all(|w| w.is_finite()), "{extreme} {precision:?}");
            }
        }
    }
}
