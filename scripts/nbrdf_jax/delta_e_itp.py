"""ΔE_ITP (ITU-R BT.2124): BT.709 → BT.2020 (BT.2087), white at 100 cd/m², PQ and ICtCp (BT.2100)."""

import numpy as np

from .arrays import Pixels, Scalar

WHITE = 100.0  # cd/m²

BT2020_FROM_BT709 = np.array([[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0114], [0.0164, 0.0880, 0.8956]])
LMS_FROM_BT2020 = np.array([[1688, 2146, 262], [683, 2951, 462], [99, 309, 3688]]) / 4096
ICTCP_FROM_LMS = np.array([[2048, 2048, 0], [6610, -13613, 7003], [17933, -17390, -543]]) / 4096
ITP_FROM_ICTCP = np.diag([1.0, 0.5, 1.0])


def delta_e_itp(reference: Pixels, other: Pixels) -> Scalar | float:
    """Linear radiance of covered pixels → mean over pixels; 1 is about just noticeable."""
    return distance(itp(reference), itp(other))


def distance(reference: Pixels, other: Pixels) -> Scalar | float:
    """ITP of covered pixels → mean over pixels."""
    xp = reference.__array_namespace__()
    difference = reference - other
    return xp.mean(720 * xp.sqrt(xp.sum(difference**2, axis=-1)))


def itp(radiance: Pixels) -> Pixels:
    """Linear BT.709 radiance → I, T, P."""
    xp = radiance.__array_namespace__()
    lms = xp.clip(radiance, 0.0, 1.0) @ (LMS_FROM_BT2020 @ BT2020_FROM_BT709).T
    return _pq(lms * WHITE) @ (ITP_FROM_ICTCP @ ICTCP_FROM_LMS).T


def _pq(luminance: Pixels) -> Pixels:
    """SMPTE ST 2084, cd/m² → [0, 1]."""
    power = (luminance / 10000) ** (2610 / 16384)
    return ((3424 / 4096 + 2413 / 128 * power) / (1 + 2392 / 128 * power)) ** (2523 / 32)
