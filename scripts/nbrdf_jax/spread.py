"""How a figure is spread over many materials: never a mean alone. The tail points to the bad side."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .arrays import Numbers

WORST = 5


@dataclass(frozen=True)
class Spread:
    """`p90`: nine in ten are better; `max`: the worst value, which for PSNR and SSIM is the lowest; `worst`: names."""

    mean: float
    median: float
    p90: float
    max: float
    worst: tuple[str, ...]

    @classmethod
    def of(cls, names: Sequence[str], values: Numbers, is_higher_better: bool) -> "Spread":
        """Of named values, at least one; ties by name."""
        badness = -values if is_higher_better else values
        order = sorted(range(len(names)), key=lambda i: (-badness[i], names[i]))
        median, p90 = np.quantile(badness, [0.5, 0.9]) * (-1 if is_higher_better else 1)
        return cls(float(np.mean(values)), float(median), float(p90), float(values[order[0]]), tuple(names[i] for i in order[:WORST]))


def is_higher_better(key: str) -> bool:
    """Of a key of the measuring protocol."""
    return key.endswith(("psnr", "ssim"))
