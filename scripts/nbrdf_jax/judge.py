"""How far one reflectance is from another: every figure of the measuring protocol that one material has."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from . import metrics, physics
from .delta_e_itp import delta_e_itp
from .flip import flip
from .places import LIGHTS, Places, Reflectance, judged
from .ssim import ssim

DIRECTIONS = ("log_error", "relative_log", "negative_share", "albedo_max", "reciprocity")
PICTURES = ("mae", "rmse", "psnr", "ssim", "flip", "delta_e_itp")
KEYS = (*DIRECTIONS, *(f"{light}_{metric}" for light in LIGHTS for metric in PICTURES))
BOUNDS = ("negative_share_low", "negative_share_high")


@dataclass(eq=False)
class Seen:
    """A reflectance at all places: what is compared."""

    signed: Float[np.ndarray, "n 3"]
    places: Places

    @classmethod
    def of(cls, reflectance: Reflectance) -> "Seen":
        """At the places of `judged`."""
        places = judged()
        return cls(reflectance(places), places)

    @cached_property
    def f(self) -> Float[np.ndarray, "n 3"]:
        """Clamped at 0."""
        return np.maximum(self.signed, 0)

    @cached_property
    def pixels(self) -> dict[str, Float[np.ndarray, "p 3"]]:
        """Linear radiance of the covered pixels under each light."""
        return {light: self.places.pixels(self.f, light) for light in LIGHTS}

    @cached_property
    def pictures(self) -> dict[str, Float[np.ndarray, "height width 3"]]:
        """Linear pictures under each light."""
        return {light: self.places.spheres[light].picture(pixels) for light, pixels in self.pixels.items()}


def figures(reference: Seen, other: Seen) -> dict[str, float]:
    """All `KEYS` and `BOUNDS`. `negative_share`, `albedo_max` and `reciprocity` are of `other` alone."""
    places = reference.places
    cosine = places.light[places.parts["rus32k"], 2]
    f, g = (places.part(seen.f, "rus32k") for seen in (reference, other))
    found = {
        "log_error": metrics.log_error(f, g, cosine),
        "relative_log": metrics.relative_log(f, g, cosine),
        **dict(zip(("negative_share", *BOUNDS), physics.negative_shares(places.part(other.signed, "rus32k")))),
        "albedo_max": physics.albedo_max(places.part(other.f, "albedo")),
        "reciprocity": physics.reciprocity(g, places.part(other.f, "exchanged")),
    }
    for light in LIGHTS:
        covered = reference.pixels[light], other.pixels[light]
        found |= {f"{light}_{key}": getattr(metrics, key)(*covered) for key in ("mae", "rmse", "psnr")}
        pictures = reference.pictures[light], other.pictures[light]
        found |= {f"{light}_ssim": ssim(*pictures), f"{light}_flip": flip(*pictures), f"{light}_delta_e_itp": delta_e_itp(*covered)}
    return {key: float(value) for key, value in found.items()}
