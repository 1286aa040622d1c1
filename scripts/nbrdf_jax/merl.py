"""Tables of the MERL database (Matusik et al. 2003, section 3), `.binary`: little-endian i32 90, 90, 180, then a plane of f64 for
red, green and blue, index φ_diff + 180 (θ_diff + 90 θ_half). Negative numbers were not measured."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from .arrays import Vectors
from .coordinates import angles_from_vectors
from .invalid import InvalidFile

CELLS = (90, 90, 180)  # θ_half, spaced as t²; θ_diff; φ_diff over half the circle, since reciprocity gives the other
SCALES = np.array([1.0, 1.15, 1.66]) / 1500  # f_r of a stored 1


@dataclass(frozen=True, eq=False)
class Merl:
    """f_r [90, 90, 180, 3] in the middle of cells, gaps filled."""

    f: Float[np.ndarray, "90 90 180 3"]

    def __call__(self, light: Vectors, view: Vectors) -> Vectors:
        """light, view above the horizon → f_r, linear between the eight cells around."""
        theta_half, _, theta_diff, phi_diff = angles_from_vectors(light, view)
        places = (
            np.clip(np.sqrt(np.maximum(theta_half, 0) / (np.pi / 2)) * 90 - 0.5, 0, 89),
            np.clip(theta_diff / (np.pi / 2) * 90 - 0.5, 0, 89),
            phi_diff % np.pi / np.pi * 180 - 0.5,
        )
        lows = [np.floor(place).astype(int) for place in places]
        shares = [place - low for place, low in zip(places, lows)]
        total = np.zeros((len(theta_half), 3))
        for corner in np.ndindex(2, 2, 2):
            h, d, p = (low + side for low, side in zip(lows, corner))
            weight = np.prod([share if side else 1 - share for share, side in zip(shares, corner)], axis=0)
            total += weight[:, None] * self.f[np.minimum(h, 89), np.minimum(d, 89), p % 180]
        return total


def read(path: Path | str) -> Merl:
    """A whole table."""
    path = Path(path)
    try:
        content = path.read_bytes()
    except FileNotFoundError as error:
        raise InvalidFile(path, "a MERL table", "no such file") from error
    size = 12 + 3 * 8 * int(np.prod(CELLS))
    if len(content) != size:
        raise InvalidFile(path, f"{size} bytes of a MERL table", str(len(content)), "is it the right file, and whole?")
    cells = tuple(np.frombuffer(content, "<i4", 3))
    if cells != CELLS:
        raise InvalidFile(path, "90 x 90 x 180 cells", " x ".join(map(str, cells)))
    stored = np.frombuffer(content, "<f8", offset=12).reshape(3, *CELLS)
    if not np.isfinite(stored).all():
        raise InvalidFile(path, "finite numbers", "others", "fetch it again")
    measured = (stored >= 0).all(axis=0)
    if not measured.any():
        raise InvalidFile(path, "measured cells", "negative numbers only")
    return Merl(_filled(np.moveaxis(stored, 0, -1) * SCALES, measured))


def _filled(f: np.ndarray, measured: np.ndarray) -> np.ndarray:
    """A gap repeats the nearest measured cell along θ_half, then along θ_diff, then along φ_diff: towards 0 first."""
    f, known = f.copy(), measured.copy()
    for axis in range(3):
        rows, seen = np.moveaxis(f, axis, 0), np.moveaxis(known, axis, 0)
        for order in (range(1, len(rows)), range(len(rows) - 2, -1, -1)):
            step = 1 if order.step == 1 else -1
            for row in order:
                gap = ~seen[row] & seen[row - step]
                rows[row, gap] = rows[row - step, gap]
                seen[row] |= gap
    return f
