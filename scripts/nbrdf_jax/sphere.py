"""The sphere everything is judged on: orthographic, viewed along +z, no interreflection, no shadow.

L = Σ f · cos θ_i · π E over lamps (E in units of π): a white Lambertian facing the `point` light shows 1.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from .arrays import Array, Picture, Pixels, Vectors
from .lights import lamps

RADIUS = 0.99  # of half the image


@dataclass(frozen=True)
class LitSphere:
    """All directions of a size × size picture, in the surface frame of each covered pixel (row-major order)."""

    covered: np.ndarray  # [size, size] bool, row 0 at the top
    light: np.ndarray  # [lamps, pixels, 3]
    view: np.ndarray  # [pixels, 3]
    cosine: np.ndarray  # [lamps, pixels], 0 where either direction is below the horizon
    irradiance: np.ndarray  # [lamps, 3] in units of π

    @classmethod
    def under(cls, light: str, size: int) -> "LitSphere":
        """The sphere under `point` or `studio`, size × size pixels."""
        covered, normals = _normals(size)
        directions, irradiance = lamps(light)
        view = _to_surface(normals, np.array([0.0, 0.0, 1.0]))
        lit = np.stack([_to_surface(normals, direction) for direction in directions])
        cosine = np.where((lit[..., 2] > 0) & (view[None, :, 2] > 0), lit[..., 2], 0.0)
        return cls(covered, lit, view, cosine, irradiance)

    def radiance(self, f: Float[Array, "lamps p 3"]) -> Pixels:
        """f [lamps, pixels, 3] → linear radiance of the covered pixels [pixels, 3]."""
        xp = f.__array_namespace__()
        weight = np.pi * self.cosine[:, :, None] * self.irradiance[:, None, :]
        return xp.sum(xp.where(weight > 0, f, 0.0) * weight, axis=0)

    def render(self, brdf: Callable[[Array, Array], Array]) -> Picture:
        """A reflectance of (light [n, 3], view [n, 3]) → linear picture [size, size, 3], black outside the sphere."""
        f = np.stack([np.asarray(brdf(light, self.view)) for light in self.light])
        return self.picture(self.radiance(f))

    def picture(self, pixels: Pixels) -> Picture:
        """Covered pixels [pixels, 3] → [size, size, 3], black outside the sphere."""
        picture = np.zeros((*self.covered.shape, 3))
        picture[self.covered] = pixels
        return picture


def _normals(size: int) -> tuple[np.ndarray, np.ndarray]:
    """covered [size, size], normals of the covered pixels [pixels, 3]."""
    across = ((np.arange(size) + 0.5) * 2 / size - 1) / RADIUS
    x, y = np.broadcast_to(across[None, :], (size, size)), np.broadcast_to(-across[:, None], (size, size))
    rest = 1 - x**2 - y**2
    covered = rest > 0
    return covered, np.stack((x[covered], y[covered], np.sqrt(rest[covered])), axis=1)


def _to_surface(normals: Vectors, direction: Float[np.ndarray, "3"]) -> Vectors:
    """normals [pixels, 3] with z > 0, direction [3] → the direction in each surface frame [pixels, 3].

    The frame is the smallest rotation that takes the normal to +z. It is right-handed, which matters: φ_diff is not
    folded, so a mirrored frame would show another side of a network.
    """
    x, y, z = normals.T
    share = 1 / (1 + z)
    tangent = np.stack((1 - x * x * share, -x * y * share, -x), axis=1)
    bitangent = np.stack((-x * y * share, 1 - y * y * share, -y), axis=1)
    return np.stack([axis @ direction for axis in (tangent, bitangent, normals)], axis=1)
