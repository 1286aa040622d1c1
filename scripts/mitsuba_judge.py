"""Whether several noisy pictures are of what one picture shows."""

import numpy as np

SIGMAS = 6.0
BLOCKS = 8
MOST_BLOCKS_APART = 0.04
MOST_NOISE = 0.15


def compared(seeds: np.ndarray, wanted: np.ndarray, tolerance: float, is_around: bool) -> dict:
    """Means of the picture and of its blocks, within the tolerance and the noise between seeds."""
    count = len(seeds)
    means = seeds.mean(axis=(1, 2))
    noise = means.std(axis=0, ddof=1) / np.sqrt(count)
    mean, target = means.mean(axis=0), wanted.mean(axis=(0, 1))
    # A map's pixels are joined differently, and the reference under it has noise of its own.
    tolerance = tolerance + (0.005 if is_around else 0)
    floor = np.maximum(target, 0.05 * target.max())
    blocks = averaged(wanted, BLOCKS)
    found = np.stack([averaged(picture, BLOCKS) for picture in seeds])
    spread = found.std(axis=0, ddof=1) / np.sqrt(count)
    # A few seeds say little of one block's noise: what is typical is the least.
    spread = np.maximum(spread, np.median(spread))
    apart = np.abs(found.mean(axis=0) - blocks) > 2 * tolerance * np.maximum(blocks, floor) + SIGMAS * spread
    is_off = np.any(np.abs(mean - target) > tolerance * floor + SIGMAS * noise)
    verdict = "agrees"
    if np.any(noise > MOST_NOISE * floor):
        verdict = "too noisy to tell"
    elif is_off or apart.mean() > MOST_BLOCKS_APART:
        verdict = "disagrees"
    return {
        "mean": rounded(mean), "reference": rounded(target), "noise": rounded(noise),
        "relative_difference": float(f"{np.max(np.abs(mean - target) / floor):.4g}"),
        "blocks_apart": float(f"{apart.mean():.4g}"), "verdict": verdict,
    }  # fmt: skip


def rounded(values: np.ndarray) -> list[float]:
    return [float(f"{value:.5g}") for value in values]


def averaged(pixels: np.ndarray, size: int) -> np.ndarray:
    """Means over squares; the picture's side is a multiple of the size."""
    side = pixels.shape[0] // size
    return pixels[: side * size, : side * size].reshape(size, side, size, side, 3).mean(axis=(1, 3))
