"""Families of analytic materials whose true in-between is known (PROTOCOL, "Interpolation quality")."""

from dataclasses import dataclass

import numpy as np

from . import metrics
from .analytic import Microfacet, f0_from_ior
from .places import Places, Reflectance

LOBES = ("ggx", "blinn_phong", "beckmann", "gtr1")
NAMES = ("roughness", "colour", "ior", "metal")
GLASS = (0.04, 0.04, 0.04)


@dataclass(frozen=True)
class Family:
    """What moves, with which lobe."""

    name: str
    lobe: str

    def at(self, t: float) -> Microfacet:
        """The true material at t."""
        match self.name:
            case "roughness":
                return Microfacet((0.2, 0.15, 0.1), GLASS, 0.1 + t * 0.5, self.lobe)
            case "colour":
                return Microfacet(_between((0.6, 0.1, 0.1), (0.1, 0.2, 0.6), t), GLASS, 0.3, self.lobe)
            case "ior":
                return Microfacet((0.3, 0.3, 0.3), (f0_from_ior(1.3 + t * 0.7),) * 3, 0.2, self.lobe)
            case "metal":
                return Microfacet(_between((0.4, 0.05, 0.05), (0.0, 0.0, 0.0), t), _between(GLASS, (1.0, 0.77, 0.34), t), 0.3, self.lobe)
            case _:
                raise ValueError(f"a family of {', '.join(NAMES)}, found {self.name!r}")

    def middle_error(self, middle: Reflectance, places: Places) -> float:
        """log_error over `rus32k` of a walk's middle against the true one."""
        pairs = places.light[places.parts["rus32k"]], places.view[places.parts["rus32k"]]
        g = np.maximum(places.part(middle(places), "rus32k"), 0)
        return float(metrics.log_error(self.at(0.5)(*pairs), g, pairs[0][:, 2]))


def all_families() -> list[Family]:
    """Four things that move, with four lobes each."""
    return [Family(name, lobe) for lobe in LOBES for name in NAMES]


def of_formula(material: Microfacet) -> Reflectance:
    """A formula as a reflectance of places."""
    return lambda places: material(places.light, places.view)


def _between(first: tuple[float, ...], second: tuple[float, ...], t: float) -> tuple[float, float, float]:
    return tuple(a + t * (b - a) for a, b in zip(first, second))
