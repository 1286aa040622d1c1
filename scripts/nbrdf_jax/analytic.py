"""Reflectances known by formula: Lambert, and f = k_d/π + D G F / (4 cos θ_i cos θ_o).

D: GGX (Walter et al. 2007), Beckmann, GTR1 (Burley 2012), Blinn–Phong. G: height-correlated Smith of GGX (Heitz 2014) with the same
α whatever D is. F: Schlick 1994. α is the width itself, not its square root.
"""

from dataclasses import dataclass

import numpy as np

from .arrays import Array, Numbers, Vectors


def ggx(cos_h: Numbers, alpha: float) -> Numbers:
    """cos θ_half [n] → D [n] in 1/sr."""
    return alpha**2 / (np.pi * (cos_h**2 * (alpha**2 - 1) + 1) ** 2)


def beckmann(cos_h: Numbers, alpha: float) -> Numbers:
    """cos θ_half [n] → D [n] in 1/sr."""
    xp = cos_h.__array_namespace__()
    return xp.exp((1 - 1 / cos_h**2) / alpha**2) / (np.pi * alpha**2 * cos_h**4)


def gtr1(cos_h: Numbers, alpha: float) -> Numbers:
    """cos θ_half [n] → D [n] in 1/sr; γ = 1."""
    return (alpha**2 - 1) / (np.pi * np.log(alpha**2) * (1 + (alpha**2 - 1) * cos_h**2))


def blinn_phong(cos_h: Numbers, alpha: float) -> Numbers:
    """cos θ_half [n] → D [n] in 1/sr: a power of the cosine, exponent 2/α² − 2 (Walter et al. 2007, section 5.2)."""
    return cos_h ** (2 / alpha**2 - 2) / (np.pi * alpha**2)


LOBES = {"ggx": ggx, "beckmann": beckmann, "gtr1": gtr1, "blinn_phong": blinn_phong}


def f0_from_ior(n: float) -> float:
    """Reflectance at normal incidence of a dielectric of refractive index n."""
    return ((n - 1) / (n + 1)) ** 2


@dataclass(frozen=True)
class Microfacet:
    """Diffuse albedo, reflectance at normal incidence (both RGB), width, name of D. f0 = None: Lambert alone."""

    diffuse: tuple[float, float, float]
    f0: tuple[float, float, float] | None = None
    alpha: float = 1.0
    lobe: str = "ggx"

    def __call__(self, light: Vectors, view: Vectors) -> Vectors:
        """light [n, 3], view [n, 3] → f_r [n, 3]; zero below either horizon."""
        xp = light.__array_namespace__()
        cos_i, cos_o = light[:, 2], view[:, 2]
        above = (cos_i > 0) & (cos_o > 0)
        f = xp.zeros_like(light) + xp.asarray(self.diffuse)[None, :] / np.pi
        if self.f0 is not None:
            f = f + self._specular(light, view, xp.where(above, cos_i, 1.0), xp.where(above, cos_o, 1.0))
        return xp.where(above[:, None], f, 0.0)

    def _specular(self, light: Vectors, view: Vectors, cos_i: Numbers, cos_o: Numbers) -> Array:
        xp = light.__array_namespace__()
        total = light + view
        length = xp.sqrt(xp.sum(total * total, axis=-1))
        cos_h, cos_d = xp.abs(total[:, 2]) / length, xp.sum(light * total, axis=-1) / length
        f0 = xp.asarray(self.f0)[None, :]
        fresnel = f0 + (1 - f0) * ((1 - cos_d) ** 5)[:, None]
        # G / (4 cos θ_i cos θ_o) in one: the cosines cancel.
        root_i = xp.sqrt(self.alpha**2 + (1 - self.alpha**2) * cos_i**2)
        root_o = xp.sqrt(self.alpha**2 + (1 - self.alpha**2) * cos_o**2)
        visibility = 0.5 / (cos_o * root_i + cos_i * root_o)
        return (LOBES[self.lobe](cos_h, self.alpha) * visibility)[:, None] * fresnel
