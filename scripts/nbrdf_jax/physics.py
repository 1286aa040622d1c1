"""Whether a material could exist: below zero before the clamp, more light out than in, another value when exchanged."""

import numpy as np

from .albedo import AlbedoLights
from .arrays import Vectors


def negative_share(signed: Vectors) -> float:
    """Unclamped f over `rus32k` [n, 3] → the share of pairs below 0 in any channel; no number counts as below."""
    return float(np.mean(~np.all(np.asarray(signed) >= 0, axis=1)))


def reciprocity(f: Vectors, exchanged: Vectors) -> float:
    """f over `rus32k` and over its exchanged pairs [n, 3] → mean |f(i, o) − f(o, i)| / mean f; 0 for black."""
    total = np.sum(f)
    return float(np.sum(np.abs(f - exchanged)) / total) if total > 0 else 0.0


def albedo_max(f: Vectors) -> float:
    """f over the lights of `AlbedoLights` [n, 3] → the largest directional albedo."""
    return AlbedoLights.around_mirror().largest(np.asarray(f))
