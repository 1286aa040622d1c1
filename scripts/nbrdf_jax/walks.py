"""Walks between two materials, by the methods of the measuring protocol: `at(t)` is a reflectance, also for t beyond 0..1."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float

from . import pca_tables, physics
from .evaluation import of_network
from .network import WIDTHS
from .pca_tables import PcaTables
from .places import Places, Reflectance, lights_of_albedo


class Walk(ABC):
    """From the material at t = 0 to that at t = 1."""

    @abstractmethod
    def at(self, t: float) -> Reflectance:
        """The material at t."""


@dataclass(eq=False)
class End:
    """A material that walks begin or end at; what has been evaluated is kept."""

    reflectance: Reflectance
    _seen: dict[int, tuple[Places, np.ndarray]] = field(default_factory=dict, repr=False)

    def __call__(self, places: Places) -> np.ndarray:
        """Unclamped f_r [n, 3]."""
        held = self._seen.get(id(places))
        if held is None:
            held = self._seen[id(places)] = places, self.reflectance(places)
        return held[1]


@dataclass(frozen=True, eq=False)
class Mix(Walk):
    """Σ w f, or exp Σ w ln(f + floor) − floor, of reflectances clamped at 0."""

    ends: tuple[End, End]
    floor: float | None = None

    def at(self, t: float) -> Reflectance:
        def mixed(places: Places) -> np.ndarray:
            f, g = (np.maximum(end(places), 0) for end in self.ends)
            if self.floor is None:
                return (1 - t) * f + t * g
            return np.exp(np.minimum((1 - t) * np.log(f + self.floor) + t * np.log(g + self.floor), 80.0)) - self.floor

        return mixed


@dataclass(frozen=True, eq=False)
class NearestEnd(Walk):
    """Doing nothing; the first end at t = ½."""

    ends: tuple[End, End]

    def at(self, t: float) -> Reflectance:
        return self.ends[int(t > 0.5)]


@dataclass(frozen=True, eq=False)
class Straight(Walk):
    """A straight line between two codes, whatever a code is; weights are one too."""

    codes: tuple[np.ndarray, np.ndarray]
    decode: Callable[[np.ndarray], Reflectance]

    def at(self, t: float) -> Reflectance:
        return self.decode((1 - t) * self.codes[0] + t * self.codes[1])


def between_weights(first: Float[np.ndarray, "w"], second: Float[np.ndarray, "w"]) -> Walk:  # noqa: F821
    """Weights taken for plain vectors."""
    return Straight((first, second), of_network)


def between_codes(codes: tuple[np.ndarray, np.ndarray], decode: Callable[[np.ndarray], np.ndarray], widths: tuple[int, ...] = WIDTHS) -> Walk:
    """Codes [k] that decode to weights; beyond the ends no further than energy allows."""
    return Bounded(Straight(codes, lambda code: of_network(decode(code), widths)))


def between_tables(basis: PcaTables, codes: tuple[np.ndarray, np.ndarray]) -> Walk:
    """Codes of PCA over tables. Interpolated logarithms are linear in the code, so those of the ends are mixed."""
    ends = tuple(End(lambda places, code=code: basis.numbers(code, places)) for code in codes)

    def at(weights: np.ndarray) -> Reflectance:
        return lambda places: pca_tables.reflectance(weights[0] * ends[0](places) + weights[1] * ends[1](places), places.light[:, 2])

    return Straight((np.array([1.0, 0.0]), np.array([0.0, 1.0])), at)


LIMIT, LOOKS, HALVINGS = 0.99, 16, 4


@dataclass(eq=False)
class Bounded(Walk):
    """Beyond an end, x becomes r (1 − e^(−x/r)); the reach r, 1 at most, is where an albedo of LIMIT is met (docs/conventions.md)."""

    inner: Walk
    _reach: dict[bool, float] = field(default_factory=dict, repr=False)

    def at(self, t: float) -> Reflectance:
        beyond = max(-t, t - 1)
        if beyond <= 0:
            return self.inner.at(t)
        is_second = t > 1
        if is_second not in self._reach:
            self._reach[is_second] = self._find(is_second)
        reach = self._reach[is_second]
        return self.inner.at(_outwards(is_second, -reach * np.expm1(-beyond / reach) if reach > 0 else 0.0))

    def _find(self, is_second: bool) -> float:
        def is_safe(x: float) -> bool:
            places = lights_of_albedo()
            return physics.albedo_max(np.maximum(self.inner.at(_outwards(is_second, x))(places), 0)) <= LIMIT

        safe = -1
        while safe < LOOKS and is_safe((safe + 1) / LOOKS):
            safe += 1
        if safe in (-1, LOOKS):
            return max(safe, 0) / LOOKS
        low, high = safe / LOOKS, (safe + 1) / LOOKS
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if is_safe(middle) else (low, middle)
        return low


def _outwards(is_second: bool, x: float) -> float:
    return 1 + x if is_second else -x
