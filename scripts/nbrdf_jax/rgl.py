"""Measured materials of the RGL database (`.bsdf`): J. Dupuy and W. Jakob, *An Adaptive Parameterization for Efficient
Material Acquisition and Rendering* (2018), section 4. Isotropic ones, in RGB.

f cos θ_i is stored over the unit square into which the density of visible normals has been warped flat: a half vector
is taken there by the density's cumulative sums, at the viewer's angle. Names here: `view` is the paper's ω_i.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float

from . import tensor_file
from .arrays import Vectors
from .invalid import InvalidFile

SHAPES = {"theta_i": 1, "phi_i": 1, "ndf": 2, "sigma": 2, "vndf": 4, "rgb": 5, "jacobian": 1}
PIECE = 1 << 16  # pairs at a time


@dataclass(frozen=True, eq=False)
class Rgl:
    """The fields of a file, and the warp's sums at every viewer's angle."""

    theta: Float[np.ndarray, "angles"]  # noqa: F821
    density: Float[np.ndarray, "angles height width"]  # of visible normals, sum of the cells' integrals 1
    rows: Float[np.ndarray, "angles height width"]  # integral of a row up to a column
    columns: Float[np.ndarray, "angles height"]  # integral up to a row
    rgb: Float[np.ndarray, "angles 3 rows columns"]
    scale: tuple[np.ndarray, np.ndarray] | None  # ndf, sigma, where values are to be multiplied by the Jacobian

    def __call__(self, light: Vectors, view: Vectors) -> Vectors:
        """light, view above the horizon → f_r, negative noise cut off."""
        pieces = [self._piece(light[start : start + PIECE], view[start : start + PIECE]) for start in range(0, len(light), PIECE)]
        return np.concatenate(pieces)

    def _piece(self, light: np.ndarray, view: np.ndarray) -> np.ndarray:
        half = light + view
        half = half / np.linalg.norm(half, axis=1, keepdims=True)
        theta_view, theta_half = (2 * np.arcsin(np.clip(0.5 * np.hypot(np.hypot(v[:, 0], v[:, 1]), v[:, 2] - 1), 0, 1)) for v in (view, half))
        turn = (np.arctan2(half[:, 1], half[:, 0]) - np.arctan2(view[:, 1], view[:, 0]) + np.pi) / (2 * np.pi)
        place = np.stack((np.sqrt(2 / np.pi * theta_half), turn - np.floor(turn)), axis=1)
        low, share = _between(self.theta, theta_view)
        flat = self._flattened(place, low, share)
        x, y, column, row = _cells(flat, self.rgb.shape[2:])
        f = self._read(low, share, x, y, column, row)
        if self.scale is not None:
            ndf, sigma = self.scale
            own = np.stack((np.sqrt(2 / np.pi * theta_view), (np.arctan2(view[:, 1], view[:, 0]) + np.pi) / (2 * np.pi)), axis=1)
            f = f * (_bilinear(ndf, place) / (4 * _bilinear(sigma, own)))[:, None]
        return np.maximum(f / light[:, 2:], 0)

    def _flattened(self, place: np.ndarray, low: np.ndarray, share: np.ndarray) -> np.ndarray:
        """Where in the unit square a half vector lies: the share of the density before it, [n, 2] as (x, y)."""
        x, y, column, row = _cells(place, self.density.shape[1:])

        def at(table: np.ndarray, *index: np.ndarray) -> np.ndarray:
            return (1 - share) * table[(low, *index)] + share * table[(low + 1, *index)]

        left, right = ((1 - y) * at(self.density, row, c) + y * at(self.density, row + 1, c) for c in (column, column + 1))
        width = self.density.shape[2] - 1
        before = (1 - y) * at(self.rows, row, column) + y * at(self.rows, row + 1, column)
        along = before + x * (left + 0.5 * x * (right - left)) / width
        whole = [at(self.rows, r, np.full_like(row, width)) for r in (row, row + 1)]
        across = at(self.columns, row) + y * (whole[0] + 0.5 * y * (whole[1] - whole[0])) / (self.density.shape[1] - 1)
        return np.clip(np.stack((along / ((1 - y) * whole[0] + y * whole[1]), across), axis=1), 0, 1)

    def _read(self, low: np.ndarray, share: np.ndarray, x: np.ndarray, y: np.ndarray, column: np.ndarray, row: np.ndarray) -> np.ndarray:
        """f cos θ_i [n, 3], linear between the eight values around."""
        total = np.zeros((len(low), 3))
        for angle, by_angle in ((low, 1 - share), (low + 1, share)):
            for r, by_row in ((row, 1 - y), (row + 1, y)):
                for c, by_column in ((column, 1 - x), (column + 1, x)):
                    total += (by_angle * by_row * by_column)[:, None] * self.rgb[angle, :, r, c]
        return total


def read(path: Path | str) -> Rgl:
    """A file of an isotropic material with an `rgb` field."""
    fields = tensor_file.read(path)
    for name, dimensions in SHAPES.items():
        if name not in fields or fields[name].ndim != dimensions:
            found = f"shape {list(fields[name].shape)}" if name in fields else f"only {', '.join(fields)}"
            raise InvalidFile(path, f"a field {name} of {dimensions} dimensions", found, "the RGB version of the file")
    if len(fields["phi_i"]) > 2:
        raise InvalidFile(path, "an isotropic material", f"{len(fields['phi_i'])} azimuths of the viewer", "nbrdf fit --anisotropic")
    theta, rgb, density = (fields[name].astype(np.float64) for name in ("theta_i", "rgb", "vndf"))
    density = density[0]
    height, width = density.shape[1:]
    steps = 0.5 * (density[:, :, :-1] + density[:, :, 1:]) / (width - 1)
    rows = np.concatenate((np.zeros((len(theta), height, 1)), np.cumsum(steps, axis=2)), axis=2)
    across = np.cumsum(0.5 * (rows[:, :-1, -1] + rows[:, 1:, -1]) / (height - 1), axis=1)
    columns = np.concatenate((np.zeros((len(theta), 1)), across), axis=1)
    total = columns[:, -1:]
    scale = (fields["ndf"].astype(np.float64), fields["sigma"].astype(np.float64)) if fields["jacobian"][0] else None
    return Rgl(theta, density / total[:, :, None], rows / total[:, :, None], columns / total, rgb[0], scale)


def _between(angles: np.ndarray, at: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The angle below, and how far it is to the next; the last repeats."""
    low = np.clip(np.searchsorted(angles, at, side="right") - 1, 0, len(angles) - 2)
    return low, np.clip((at - angles[low]) / (angles[low + 1] - angles[low]), 0, 1)


def _cells(place: np.ndarray, shape: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Places [n, 2] as (x, y) in the unit square → shares x, y and the cells column, row of a table [height, width]."""
    scaled = place * (shape[1] - 1, shape[0] - 1)
    column, row = (np.clip(scaled[:, axis].astype(int), 0, shape[1 - axis] - 2) for axis in (0, 1))
    return scaled[:, 0] - column, scaled[:, 1] - row, column, row


def _bilinear(table: np.ndarray, place: np.ndarray) -> np.ndarray:
    x, y, column, row = _cells(place, table.shape)
    upper = (1 - x) * table[row, column] + x * table[row, column + 1]
    return (1 - y) * upper + y * ((1 - x) * table[row + 1, column] + x * table[row + 1, column + 1])
