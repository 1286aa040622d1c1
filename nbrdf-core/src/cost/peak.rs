//! The processor's own speed limit: independent fused multiply-adds on registers, and nothing else.

use std::hint::black_box;
use std::time::Instant;

use pulp::{Simd, WithSimd};

use crate::simd::InstructionSet;

/// Independent sums: more than latency times throughput on every processor in use, fewer than it has registers.
const SUMS: usize = 12;
const ROUNDS: usize = 200_000;
/// Short runs, of which the fastest counts: a limit is never exceeded, only missed.
const RUNS: usize = 8;

struct MultiplyAdds;

impl WithSimd for MultiplyAdds {
    /// Operations, and seconds.
    type Output = (f64, f64);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let [factor, term] = [0.999f32, 0.001].map(|v| simd.splat_f32s(black_box(v)));
        let mut sums = [simd.splat_f32s(1.0); SUMS];
        let start = Instant::now();
        for _ in 0..ROUNDS {
            for sum in &mut sums {
                *sum = simd.mul_add_e_f32s(*sum, factor, term);
            }
        }
        let seconds = start.elapsed().as_secs_f64();
        let total = sums.iter().map(|sum| simd.reduce_sum_f32s(*sum)).sum::<f32>();
        black_box(total);
        ((2 * SUMS * ROUNDS * S::F32_LANES) as f64, seconds)
    }
}

/// Floating point operations per nanosecond of one thread with this instruction set, measured now.
pub fn peak_fma(set: InstructionSet) -> f64 {
    let run = |_| {
        let (operations, seconds) = set.run(MultiplyAdds);
        operations / seconds * 1e-9
    };
    (0..RUNS).map(run).fold(0.0, f64::max)
}
