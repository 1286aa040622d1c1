"""Directional albedo: ∫ f_r cos θ_i dω_i for viewers at θ_o = 0, 5, ..., 85°, over half vectors around the normal.

ω_i is ω_o mirrored at h, and dω_i = 4 (ω_o · h) dω_h (Walter et al. 2007, equation 14), so that cells of even steps in
∛θ_half are small where highlights are. The whole circle is walked: networks need not be symmetric.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
from jaxtyping import Float

STEPS = 18  # of 5°
POLAR, AROUND = 104, 64  # cells of half vectors; about 4 500 of 6 656 mirror the viewer to above the horizon
BLUR = 8  # parts of a cell that meets the horizon, each way


@dataclass(frozen=True)
class AlbedoLights:
    """Lights of all viewers in one list."""

    pairs: tuple[np.ndarray, np.ndarray]  # light, view [n, 3]
    weights: np.ndarray  # [n]: cos θ_i dω_i
    viewer: np.ndarray  # [n] int: which of the viewers

    @classmethod
    @cache
    def around_mirror(cls) -> "AlbedoLights":
        """The quadrature of this module."""
        lights, views, weights, viewers = [], [], [], []
        for step in range(STEPS):
            theta = np.radians(5.0 * step)
            view = np.array([np.sin(theta), 0.0, np.cos(theta)])
            light, weight = _lights(view)
            lights.append(light)
            weights.append(weight)
            views.append(np.broadcast_to(view, light.shape))
            viewers.append(np.full(len(light), step))
        return cls((np.concatenate(lights), np.concatenate(views)), np.concatenate(weights), np.concatenate(viewers))

    def largest(self, f: Float[np.ndarray, "n 3"]) -> float:
        """The largest albedo of any channel and viewer; infinite where any value is no number."""
        albedo = np.stack([np.bincount(self.viewer, self.weights * f[:, channel], STEPS) for channel in range(3)])
        return float("inf") if np.isnan(albedo).any() else float(albedo.max())


def _lights(view: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """view [3] → light [n, 3], cos θ_i dω_i [n].

    Every cell stands for the part of it that is above the horizon, at that part's weighted middle: cells are looked at in BLUR² pieces.
    """
    fine = ((np.arange(count * BLUR) + 0.5) / (count * BLUR) for count in (POLAR, AROUND))
    s, turn = (grid.reshape(-1) for grid in np.meshgrid(*fine, indexing="ij"))
    theta, phi = s**3 * np.pi / 2, turn * 2 * np.pi
    half = np.stack((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)), axis=1)
    cos_d = half @ view
    light = 2 * cos_d[:, None] * half - view
    area = np.sin(theta) * (1.5 * np.pi * s**2) * (2 * np.pi) / (POLAR * AROUND * BLUR**2)  # sin θ dθ dφ, dθ = 3π/2 s² ds
    weight = np.where((cos_d > 0) & (light[:, 2] > 0), 4 * cos_d * light[:, 2] * area, 0.0)

    def cells(values: np.ndarray) -> np.ndarray:
        return values.reshape(POLAR, BLUR, AROUND, BLUR).sum(axis=(1, 3)).reshape(-1)

    total = cells(weight)
    kept = total > 0
    middle = np.stack([cells(weight * light[:, axis])[kept] for axis in range(3)], axis=1)
    return middle / np.linalg.norm(middle, axis=1, keepdims=True), total[kept]
