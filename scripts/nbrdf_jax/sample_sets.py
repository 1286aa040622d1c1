"""The directions that fits compare on: sets drawn once and shared by all materials; every step looks at one of them.

A set has the counts of `objective.STEP`: directions uniform in the Rusinkiewicz angles (the adaptive angular sampling of
Sztrajman et al. 2021, section 3.2), and pixels of a sphere's disc under a few lamps each.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from jaxtyping import Float

from .coordinates import vectors_from_angles
from .objective import STEP, Counts, features
from .places import Places

RIM = 0.98  # squared radius of the disc: nearer the rim pixels are all but unseen
LARGEST = 0.7  # irradiance of a lamp in units of π: four are about as bright as `studio`
MOST, STEPS_PER_SET = 1024, 16


def worth(steps: int) -> int:
    """How many sets so many steps are worth."""
    return min(MOST, -(-steps // STEPS_PER_SET))


@dataclass(eq=False)
class SampleSets:
    """light, view [s, d, 3]; factor [s, d] is cos θ_i, for a pixel's lamps times irradiance. float64."""

    light: Float[np.ndarray, "s d 3"]
    view: Float[np.ndarray, "s d 3"]
    factor: Float[np.ndarray, "s d"]
    counts: Counts = STEP

    @classmethod
    def drawn(cls, seed: int, count: int, counts: Counts = STEP) -> "SampleSets":
        """So many sets."""
        random = np.random.default_rng((seed, 1))
        angular, pixels = counts.log + counts.relative, counts.pixels
        light, view = _above_horizon(random, count * angular)
        light, view = (vectors.reshape(count, angular, 3) for vectors in (light, view))
        eye = _pixels(random, count * pixels).repeat(counts.lamps, axis=0)
        lamp = _upward(random, len(eye))
        bright = lamp[:, 2] * np.pi * random.uniform(0, LARGEST, len(lamp))
        joined = (np.concatenate((a, b.reshape(count, -1, 3)), axis=1) for a, b in ((light, lamp), (view, eye)))
        return cls(*joined, np.concatenate((light[..., 2], bright.reshape(count, -1)), axis=1), counts)

    @cached_property
    def places(self) -> Places:
        """All directions, set after set."""
        return Places(self.light.reshape(-1, 3), self.view.reshape(-1, 3), {}, {})

    @property
    def inputs(self) -> Float[np.ndarray, "s d 6"]:
        """What networks read."""
        return self.places.inputs.reshape(*self.factor.shape, 6)

    def wanted(self, f: Float[np.ndarray, "n 3"]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Reflectances at all directions, set after set → the features of every set, float32."""
        values = f.reshape(*self.factor.shape, 3)
        by_set = [features(one, factor, self.counts) for one, factor in zip(values, self.factor)]
        return tuple(np.stack([found[kind] for found in by_set]).astype(np.float32) for kind in range(3))


def _above_horizon(random: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
    lights, views, found = [], [], 0
    while found < count:
        angles = random.uniform(0, 1, (count, 3)) * (np.pi / 2, np.pi / 2, 2 * np.pi)
        light, view = vectors_from_angles(angles[:, 0], np.zeros(count), angles[:, 1], angles[:, 2])
        above = (light[:, 2] > 0) & (view[:, 2] > 0)
        lights.append(light[above])
        views.append(view[above])
        found += int(above.sum())
    return np.concatenate(lights)[:count], np.concatenate(views)[:count]


def _pixels(random: np.random.Generator, count: int) -> np.ndarray:
    """The viewer in the surface frames of random pixels [count, 3]."""
    squared = random.uniform(0, RIM, count)
    return np.stack((np.sqrt(squared), np.zeros(count), np.sqrt(1 - squared)), axis=1)


def _upward(random: np.random.Generator, count: int) -> np.ndarray:
    z, phi = random.uniform(1e-3, 1, count), random.uniform(0, 2 * np.pi, count)
    return np.stack((np.sqrt(1 - z**2) * np.cos(phi), np.sqrt(1 - z**2) * np.sin(phi), z), axis=1)
