"""Whether a picture, without noise or several times with, shows what another one does.

Without noise, what is judged is the share of the light that is in another place, pixel by pixel. With noise, the means of
the picture and of its blocks, within a tolerance and `SIGMAS` standard errors; a picture whose standard error is above
`MOST_NOISE` would agree with too much, and is no test: its verdict is neither.
"""

import numpy as np

AGREES, APART, NOISY = "agrees", "apart", "too noisy to tell"
# Some 450 channels of noisy pictures are judged in a run. By Student's t a mean of 16 passes is beyond four standard errors once
# in 860, one against references of 8 seeds once in 190, of 4 once in 36: some in a run would be apart by chance if every true
# difference used up its tolerance, none while they are a fraction of it.
SIGMAS = 4.0
LEAST_PASSES = 16
# Of the mean: what is allowed is never more than four times this and the tolerance.
MOST_NOISE = 0.0025
BLOCKS = 8
# Of 192 blocks and channels, up to one would be apart by chance, and more than three hardly ever.
MOST_BLOCKS_APART = 3 / 192
# As in the errors of exports: a channel with less light than this share of the brightest is judged as if it had that.
DARK = 0.01


def exact(picture: np.ndarray, wanted: np.ndarray, tolerance: float) -> dict:
    """A picture [size, size, 3] without noise against another: Σ |difference| / Σ of the worst channel is at most this."""
    target = wanted.mean(axis=(0, 1))
    floor = lit(target)
    elsewhere = float(np.max(np.abs(picture - wanted).mean(axis=(0, 1)) / floor))
    means = float(np.max(np.abs(picture.mean(axis=(0, 1)) - target) / floor))
    verdict = AGREES if elsewhere <= tolerance else APART
    return {"difference": rounded(means), "elsewhere": rounded(elsewhere), "noise": 0.0, "allowed": tolerance, "verdict": verdict}


def noisy(passes: np.ndarray, wanted: np.ndarray, tolerance: float) -> dict:
    """Pictures [passes, size, size, 3] of the same with independent noise against others, of any size, with noise too."""
    mean, target = passes.mean(axis=(0, 1, 2)), wanted.mean(axis=(0, 1, 2))
    floor = lit(target)
    noise = np.hypot(error(passes.mean(axis=(1, 2))), error(wanted.mean(axis=(1, 2))))
    off = np.abs(mean - target)
    found, blocks = averaged(passes, BLOCKS), averaged(wanted, BLOCKS)
    spread = np.hypot(error(found), error(blocks))
    # A few passes say little of one block's noise: what is typical is the least.
    spread = np.maximum(spread, np.median(spread, axis=(0, 1)))
    allowed = 2 * tolerance * np.maximum(blocks.mean(axis=0), floor) + SIGMAS * spread
    apart = float(np.mean(np.abs(found.mean(axis=0) - blocks.mean(axis=0)) > allowed))
    is_off = np.any(off > tolerance * floor + SIGMAS * noise) or apart > MOST_BLOCKS_APART
    verdict = NOISY if np.any(noise > MOST_NOISE * floor) else APART if is_off else AGREES
    worst = float(np.max(noise / floor))
    return {
        "difference": rounded(float(np.max(off / floor))), "blocks_apart": rounded(apart), "noise": rounded(worst),
        "allowed": rounded(tolerance + SIGMAS * worst), "passes": len(passes), "verdict": verdict,
    }  # fmt: skip


def relative_noise(passes: list[np.ndarray]) -> float:
    """Standard error of the mean picture over its mean, of the worst channel; infinite for fewer than two passes."""
    if len(passes) < 2:
        return float("inf")
    means = np.stack([picture.mean(axis=(0, 1)) for picture in passes])
    return float(np.max(error(means) / lit(means.mean(axis=0))))


def error(samples: np.ndarray) -> np.ndarray:
    """Standard error of the mean over the first axis."""
    return samples.std(axis=0, ddof=1) / np.sqrt(len(samples))


def lit(mean: np.ndarray) -> np.ndarray:
    """Channels to divide by."""
    return np.maximum(mean, max(DARK * float(mean.max()), np.finfo(float).tiny))


def averaged(pictures: np.ndarray, size: int) -> np.ndarray:
    """Means over squares; the side of the pictures [n, side, side, 3] is a multiple of the size."""
    count, side = pictures.shape[0], pictures.shape[1] // size
    return pictures.reshape(count, size, side, size, side, 3).mean(axis=(2, 4))


def rounded(value: float) -> float:
    return float(f"{value:.4g}")
