"""Whether a picture, without noise or several times with, shows what another one does.

Without noise, what is judged is the share of the light that is in another place, pixel by pixel. With noise, the means of
the picture and of its blocks, within a tolerance and `SIGMAS` standard errors; a picture whose standard error is above
`MOST_NOISE` would agree with too much, and is no test: its verdict is neither. A value that is not finite counts as no light,
and with one a picture is apart, whatever the rest of it shows.
"""

import numpy as np
from scipy import stats

AGREES, APART, NOISY = "agrees", "apart", "too noisy to tell"
# By Student's t a mean of 16 passes is beyond four standard errors once in 860. Some 500 channels of noisy pictures are judged in
# a run: one would be apart by chance if every true difference used up its tolerance, none while they are a fraction of it. They
# are not independent: one reference serves both ways of drawing, both variants and all channels, so what is odd about its noise
# shows in several comparisons at once.
SIGMAS = 4.0
LEAST_PASSES = 16
# Of the mean: what is allowed is never more than four times this and the tolerance.
MOST_NOISE = 0.0025
BLOCKS = 8
# A block is beyond `SIGMAS` where any of its channels is: these share the directions that are drawn, and go together. So many
# blocks may be as Student's t explains but for this chance (of 64, two with 16 passes), none by more than `MOST_SIGMAS`, which
# happens to a block once in 2e7.
CHANCE = 1e-4
MOST_SIGMAS = 10.0
# As in the errors of exports: a channel with less light than this share of the brightest is judged as if it had that.
DARK = 0.01


def exact(picture: np.ndarray, wanted: np.ndarray, tolerance: float) -> dict:
    """A picture [size, size, 3] without noise against another: Σ |difference| / Σ of the worst channel is at most this."""
    lost = not_finite(picture, wanted)
    picture, wanted = finite(picture), finite(wanted)
    target = wanted.mean(axis=(0, 1))
    floor = lit(target)
    elsewhere = float(np.max(np.abs(picture - wanted).mean(axis=(0, 1)) / floor))
    means = float(np.max(np.abs(picture.mean(axis=(0, 1)) - target) / floor))
    verdict = AGREES if lost == 0 and elsewhere <= tolerance else APART
    return {
        "difference": rounded(means), "elsewhere": rounded(elsewhere), "noise": 0.0, "allowed": tolerance, "not_finite": lost, "verdict": verdict,
    }  # fmt: skip


def noisy(passes: np.ndarray, wanted: np.ndarray, tolerance: float) -> dict:
    """Pictures [passes, size, size, 3] of the same with independent noise against others of any size: several with noise too, or
    a single one without."""
    lost = not_finite(passes, wanted)
    passes, wanted = finite(passes), finite(wanted)
    mean, target = passes.mean(axis=(0, 1, 2)), wanted.mean(axis=(0, 1, 2))
    floor = lit(target)
    noise = np.hypot(error(passes.mean(axis=(1, 2))), error(wanted.mean(axis=(1, 2))))
    off = np.abs(mean - target)
    found, blocks = averaged(passes, BLOCKS), averaged(wanted, BLOCKS)
    spread = np.hypot(error(found), error(blocks))
    # A few passes say little of one block's noise: what is typical is the least.
    spread = np.maximum(spread, np.median(spread, axis=(0, 1)))
    excess = np.abs(found.mean(axis=0) - blocks.mean(axis=0)) - 2 * tolerance * np.maximum(blocks.mean(axis=0), floor)
    apart = int(np.sum(~np.all(excess <= SIGMAS * spread, axis=-1)))
    likely = by_chance(min(len(pictures) for pictures in (passes, wanted) if len(pictures) > 1))
    # Only what is shown to be within its bound agrees: a comparison with what is not a number shows nothing.
    is_near = bool(np.all(off <= tolerance * floor + SIGMAS * noise)) and apart <= likely and bool(np.all(excess <= MOST_SIGMAS * spread))
    is_quiet = bool(np.all(noise <= MOST_NOISE * floor))
    verdict = APART if lost else NOISY if not is_quiet else AGREES if is_near else APART
    worst = float(np.max(noise / floor))
    return {
        "difference": rounded(float(np.max(off / floor))), "blocks_apart": apart, "blocks_allowed": likely, "noise": rounded(worst),
        "allowed": rounded(tolerance + SIGMAS * worst), "passes": len(passes), "not_finite": lost, "verdict": verdict,
    }  # fmt: skip


def by_chance(passes: int) -> int:
    """How many of all blocks may be beyond `SIGMAS`, where so many pictures say what a standard error is: binomial, of the two
    tails of Student's t. Of unlike numbers on both sides the smaller is the safe one (Hsu, in H. Scheffé, *Practical Solutions
    of the Behrens-Fisher Problem*, 1970)."""
    tails = 2 * stats.t.sf(SIGMAS, passes - 1)
    return int(stats.binom.isf(CHANCE, BLOCKS * BLOCKS, tails))


def relative_noise(passes: list[np.ndarray]) -> float:
    """Standard error of the mean picture over its mean, of the worst channel; infinite for fewer than two passes, not a number
    where one has values that are not finite."""
    if len(passes) < 2:
        return float("inf")
    means = np.stack([picture.mean(axis=(0, 1)) for picture in passes])
    return float(np.max(error(means) / lit(means.mean(axis=0))))


def error(samples: np.ndarray) -> np.ndarray:
    """Standard error of the mean over the first axis; a single sample is one without noise."""
    if len(samples) == 1:
        return np.zeros_like(samples[0])
    return samples.std(axis=0, ddof=1) / np.sqrt(len(samples))


def lit(mean: np.ndarray) -> np.ndarray:
    """Channels to divide by."""
    return np.maximum(mean, max(DARK * float(mean.max()), np.finfo(float).tiny))


def averaged(pictures: np.ndarray, size: int) -> np.ndarray:
    """Means over squares; the side of the pictures [n, side, side, 3] is a multiple of the size."""
    count, side = pictures.shape[0], pictures.shape[1] // size
    return pictures.reshape(count, size, side, size, side, 3).mean(axis=(2, 4))


def finite(pictures: np.ndarray) -> np.ndarray:
    return np.where(np.isfinite(pictures), pictures, 0)


def not_finite(*pictures: np.ndarray) -> int:
    """How many values are not finite."""
    return sum(int(np.sum(~np.isfinite(picture))) for picture in pictures)


def rounded(value: float) -> float:
    return float(f"{value:.4g}")
