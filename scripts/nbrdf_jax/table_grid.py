"""The grid of the tables that PCA-32 is learned on: 60 (θ_half, spaced as t²) × 40 (θ_diff) × 80 (φ_diff, whole circle).

Values stand in the middle of cells. A cell below the horizon repeats the last one above it towards smaller θ_half, so that
nothing made up takes part in an interpolation near the horizon.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from jaxtyping import Float, Int

from .arrays import Vectors
from .coordinates import angles_from_vectors, vectors_from_angles

CELLS = (60, 40, 80)


@cache
def cell_directions() -> tuple[np.ndarray, np.ndarray]:
    """light, view [192 000, 3] of all cells, θ_half slowest."""
    middles = [(np.arange(count) + 0.5) / count for count in CELLS]
    half, difference, turn = (grid.reshape(-1) for grid in np.meshgrid(middles[0] ** 2 * np.pi / 2, middles[1] * np.pi / 2, middles[2] * 2 * np.pi, indexing="ij"))
    light, view = vectors_from_angles(half, np.zeros_like(half), difference, turn)
    # Rows of θ_half; each below the horizon takes what the row before it has.
    light, view = (vectors.reshape(CELLS[0], -1, 3) for vectors in (light, view))
    above = (light[..., 2] > 0) & (view[..., 2] > 0)
    for row in range(1, CELLS[0]):
        below = ~above[row]
        light[row, below], view[row, below] = light[row - 1, below], view[row - 1, below]
    return light.reshape(-1, 3), view.reshape(-1, 3)


@dataclass(frozen=True, eq=False)
class Stencil:
    """The eight cells around each pair of directions, and their weights, whose sum is 1."""

    cells: Int[np.ndarray, "n 8"]
    weights: Float[np.ndarray, "n 8"]

    @classmethod
    def around(cls, light: Vectors, view: Vectors) -> "Stencil":
        """Of pairs above the horizon."""
        theta_half, _, theta_diff, phi_diff = angles_from_vectors(light, view)
        axes = [
            _held(np.sqrt(np.maximum(theta_half, 0) / (np.pi / 2)), CELLS[0]),
            _held(theta_diff / (np.pi / 2), CELLS[1]),
            _cyclic(phi_diff / (2 * np.pi), CELLS[2]),
        ]
        cells, weights = [], []
        for corner in np.ndindex(2, 2, 2):
            index, weight = np.zeros(len(light), int), np.ones(len(light))
            for side, (low, high, share), count in zip(corner, axes, CELLS):
                index = index * count + (high if side else low)
                weight = weight * (share if side else 1 - share)
            cells.append(index)
            weights.append(weight)
        return cls(np.stack(cells, axis=1), np.stack(weights, axis=1))

    def read(self, table: Float[np.ndarray, "cells 3"]) -> Float[np.ndarray, "n 3"]:
        """The interpolated numbers."""
        return sum(self.weights[:, corner, None] * table[self.cells[:, corner]] for corner in range(8))


def _held(t: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """t in 0..1 → the two cells around it and the share of the second; the edges repeat."""
    place = np.clip(t * count - 0.5, 0, count - 1)
    low = np.minimum(place.astype(int), count - 2)
    return low, low + 1, place - low


def _cyclic(t: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    place = t % 1 * count - 0.5
    low = np.floor(place).astype(int)
    return low % count, (low + 1) % count, place - low
