//! Which vectors the processor has, and which of them are the fastest here.

use std::sync::OnceLock;
use std::time::{Duration, Instant};

use pulp::{Simd, WithSimd};

use crate::nbrdf::fit::random_network;
use crate::{Directions, Rgb};

/// Environment variable that names the set to use in place of the fastest one, so that results of other processors can be
/// looked at here.
pub const VARIABLE: &str = "NBRDF_INSTRUCTIONS";

/// A set of vector instructions.
#[derive(Clone, Copy, Debug)]
pub enum InstructionSet {
    /// One number at a time, for any processor.
    Portable(pulp::Scalar),
    /// 256 bits with fused multiply-add.
    #[cfg(target_arch = "x86_64")]
    Avx2(pulp::x86::V3),
    /// 512 bits.
    #[cfg(target_arch = "x86_64")]
    Avx512(pulp::x86::V4),
    /// 128 bits with fused multiply-add.
    #[cfg(target_arch = "aarch64")]
    Neon(pulp::aarch64::Neon),
}

impl InstructionSet {
    /// Those that this processor has, the portable one first.
    pub fn available() -> Vec<Self> {
        let mut found = vec![Self::Portable(pulp::Scalar)];
        #[cfg(target_arch = "x86_64")]
        found.extend(pulp::x86::V3::try_new().map(Self::Avx2));
        #[cfg(target_arch = "x86_64")]
        found.extend(pulp::x86::V4::try_new().map(Self::Avx512));
        #[cfg(target_arch = "aarch64")]
        found.extend(pulp::aarch64::Neon::try_new().map(Self::Neon));
        found
    }

    /// The one that [`VARIABLE`] asks for; none where it is not set.
    ///
    /// # Errors
    /// What it says, where that is no set that this processor has.
    pub fn asked() -> Result<Option<Self>, String> {
        let Some(name) = std::env::var_os(VARIABLE) else { return Ok(None) };
        let found = Self::available().into_iter().find(|set| name == set.name());
        found.map(Some).ok_or_else(|| name.to_string_lossy().into_owned())
    }

    /// The one that is [`asked`](Self::asked) for, else the one that evaluates a network fastest, found once by trying: on some processors 512 bits are as fast as two
    /// times 256, on others slower. All vector sets give the same bits, so that it does not matter which one wins.
    pub fn fastest() -> Self {
        static FASTEST: OnceLock<InstructionSet> = OnceLock::new();
        *FASTEST.get_or_init(|| {
            if let Ok(Some(asked)) = Self::asked() {
                return asked;
            }
            // The portable path is many times slower than any other: no contestant.
            let mut vectors = Self::available();
            if vectors.len() > 1 {
                vectors.remove(0);
            }
            if vectors.len() == 1 { vectors[0] } else { fastest_of(&vectors) }
        })
    }

    /// Whether it has vectors.
    pub const fn is_vector(self) -> bool {
        !matches!(self, Self::Portable(_))
    }

    /// `portable`, `avx2`, `avx512`, `neon`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Portable(_) => "portable",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(_) => "avx512",
            #[cfg(target_arch = "aarch64")]
            Self::Neon(_) => "neon",
        }
    }

    /// Runs loops compiled for this set.
    #[inline(always)]
    pub(crate) fn run<Op: WithSimd>(self, op: Op) -> Op::Output {
        match self {
            Self::Portable(simd) => Simd::vectorize(simd, op),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(simd) => Simd::vectorize(simd, op),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(simd) => Simd::vectorize(simd, op),
            #[cfg(target_arch = "aarch64")]
            Self::Neon(simd) => Simd::vectorize(simd, op),
        }
    }
}

/// The shortest of some runs each, in turns, so that a disturbance hits all alike; well below a millisecond in all.
fn fastest_of(sets: &[InstructionSet]) -> InstructionSet {
    const RUNS: usize = 12;
    let network = random_network(0, 0);
    let at: Vec<Directions> = (0..512_u16)
        .map(|i| f32::from(i) / 512.0)
        .map(|t| Directions::from_angles(1.4 * t, 0.0, 1.4 * (1.0 - t), 6.0 * t))
        .collect();
    let mut out = vec![Rgb::BLACK; at.len()];
    let mut shortest = vec![Duration::MAX; sets.len()];
    for _ in 0..RUNS {
        for (set, shortest) in sets.iter().zip(&mut shortest) {
            let start = Instant::now();
            network.eval_with(*set, &at, &mut out);
            *shortest = start.elapsed().min(*shortest);
        }
    }
    let winner = (0..sets.len()).min_by_key(|&i| shortest[i]).unwrap_or(0);
    sets[winner]
}
