"""Where every material is looked at, once for all figures: `rus32k`, the same with light and view exchanged, the lit pixels of
both spheres, and the lights of the directional albedo."""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache, cached_property

import numpy as np
from jaxtyping import Float

from .albedo import AlbedoLights
from .arrays import Inputs, Vectors
from .coordinates import network_inputs
from .directions import rus32k
from .sphere import LitSphere
from .table_grid import Stencil

SIZE = 128  # pixels across, of pictures that are measured
LIGHTS = ("point", "studio")


@dataclass(eq=False)
class Places:
    """Pairs of directions in one list, both above the horizon, and which part of it is for what."""

    light: Vectors
    view: Vectors
    parts: dict[str, slice]
    spheres: dict[str, LitSphere] = field(repr=False)

    @cached_property
    def inputs(self) -> Inputs:
        """What networks read."""
        return network_inputs(self.light, self.view)

    @cached_property
    def stencil(self) -> Stencil:
        """What tables are read with."""
        return Stencil.around(self.light, self.view)

    def part(self, values: Float[np.ndarray, "n 3"], name: str) -> np.ndarray:
        """The values [part, 3] of one part."""
        return values[self.parts[name]]

    def pixels(self, values: Float[np.ndarray, "n 3"], name: str) -> np.ndarray:
        """Linear radiance of the covered pixels [pixels, 3] under `point` or `studio`."""
        scene = self.spheres[name]
        f = np.zeros((*scene.cosine.shape, 3))
        f[scene.cosine > 0] = self.part(values, name)
        return scene.radiance(f)


# A reflectance, before any clamp: f_r [n, 3] at places.
Reflectance = Callable[[Places], np.ndarray]


@cache
def judged() -> Places:
    """Everything that a material is judged by."""
    light, view = rus32k()
    pairs = {"rus32k": (light, view), "exchanged": (view, light)}
    spheres = {name: LitSphere.under(name, SIZE) for name in LIGHTS}
    for name, scene in spheres.items():
        lit = scene.cosine > 0
        pairs[name] = scene.light[lit], np.broadcast_to(scene.view, scene.light.shape)[lit]
    pairs["albedo"] = AlbedoLights.around_mirror().pairs
    return _joined(pairs, spheres)


@cache
def walked(is_between: bool) -> Places:
    """What is looked at on a walk: between the ends (with the picture under `studio`), or beyond them."""
    whole = judged()
    names = ("rus32k", "albedo", "studio") if is_between else ("rus32k", "albedo")
    pairs = {name: (whole.light[whole.parts[name]], whole.view[whole.parts[name]]) for name in names}
    return _joined(pairs, whole.spheres)


@cache
def lights_of_albedo() -> Places:
    """The lights of the directional albedo alone."""
    return Places(*AlbedoLights.around_mirror().pairs, {}, {})


def _joined(pairs: dict[str, tuple[np.ndarray, np.ndarray]], spheres: dict[str, LitSphere]) -> Places:
    parts, start = {}, 0
    for name, (light, _) in pairs.items():
        parts[name] = slice(start, start + len(light))
        start += len(light)
    light, view = (np.concatenate([pair[side] for pair in pairs.values()]) for side in (0, 1))
    return Places(light, view, parts, spheres)
