"""The direction set `rus32k`: 32 768 quasi-random points in the angles, kept where both cosines are positive.

u = frac(0.5 + (k + 1) · (1/g, 1/g², 1/g³)): the R3 sequence (Roberts 2018), g the root of x⁴ = x + 1.
"""

import numpy as np

from .coordinates import vectors_from_angles

POINTS = 32768
G = 1.2207440846057596


def rus32k() -> tuple[np.ndarray, np.ndarray]:
    """light [n, 3], view [n, 3] float64, n valid pairs in the order of k; φ_half = 0."""
    k = np.arange(1, POINTS + 1, dtype=np.float64)
    u1, u2, u3 = (np.modf(0.5 + k * step)[0] for step in (1 / G, 1 / G**2, 1 / G**3))
    light, view = vectors_from_angles(u1 * np.pi / 2, np.zeros(POINTS), u2 * np.pi / 2, 2 * np.pi * u3)
    valid = (light[:, 2] > 0) & (view[:, 2] > 0)
    return light[valid], view[valid]


def golden_directions() -> tuple[np.ndarray, np.ndarray]:
    """The first 1000 pairs of `rus32k` as light [1000, 3], view [1000, 3] float32: the same input bits for everyone."""
    light, view = rus32k()
    return light[:1000].astype(np.float32), view[:1000].astype(np.float32)
