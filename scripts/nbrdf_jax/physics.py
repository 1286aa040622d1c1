"""Whether a material could exist: below zero before the clamp, more light out than in, another value when exchanged."""

import numpy as np

from .albedo import AlbedoLights
from .arrays import Vectors

NEAR_0 = 1e-6  # values this close to 0 are below it or not by their rounding


def negative_share(signed: Vectors, threshold: float = 0.0) -> float:
    """Unclamped f over `rus32k` [n, 3] → the share of pairs below the threshold in any channel; no number counts as below."""
    return float(np.mean(~np.all(np.asarray(signed) >= threshold, axis=1)))


def negative_shares(signed: Vectors) -> tuple[float, float, float]:
    """The share below 0, and those between which it is for whoever rounds otherwise: below −`NEAR_0` and below `NEAR_0`."""
    share, low, high = (negative_share(signed, threshold) for threshold in (0.0, -NEAR_0, NEAR_0))
    return share, low, high


def reciprocity(f: Vectors, exchanged: Vectors) -> float:
    """f over `rus32k` and over its exchanged pairs [n, 3] → mean |f(i, o) − f(o, i)| / mean f; 0 for black."""
    total = np.sum(f)
    return float(np.sum(np.abs(f - exchanged)) / total) if total > 0 else 0.0


def albedo_max(f: Vectors) -> float:
    """f over the lights of `AlbedoLights` [n, 3] → the largest directional albedo."""
    return AlbedoLights.around_mirror().largest(np.asarray(f))
