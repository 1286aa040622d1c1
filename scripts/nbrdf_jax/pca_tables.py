"""PCA-32 on tables of ln(f c + 10⁻³), c = cos θ_i floored at .05: the row to beat."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np
from jaxtyping import Float

from .coordinates import network_inputs
from .evaluation import evaluated
from .pca import Pca
from .places import Places, Reflectance
from .table_grid import cell_directions
from .workers import each, silent

DARKEST, COSINE_FLOOR, COMPONENTS = 1e-3, 0.05, 32


def stored(f: Float[np.ndarray, "n 3"], cos_i: Float[np.ndarray, "n"]) -> Float[np.ndarray, "n 3"]:  # noqa: F821
    """f clamped at 0 → ln(f c + 10⁻³)."""
    return np.log(np.maximum(f, 0) * np.maximum(cos_i, COSINE_FLOOR)[:, None] + DARKEST)


def reflectance(numbers: Float[np.ndarray, "n 3"], cos_i: Float[np.ndarray, "n"]) -> Float[np.ndarray, "n 3"]:  # noqa: F821
    """What `stored` numbers stand for, not clamped."""
    return (np.exp(np.minimum(numbers, 80.0)) - DARKEST) / np.maximum(cos_i, COSINE_FLOOR)[:, None]


@dataclass(frozen=True, eq=False)
class PcaTables:
    """A basis over tables."""

    pca: Pca

    @classmethod
    def learn(cls, networks: Float[np.ndarray, "m w"], progress: Callable = silent) -> "PcaTables":
        """From the training materials' networks."""
        tables = progress(each(tabulate, list(networks)), "tables of the training materials", len(networks))
        return cls(Pca.learn(np.stack(list(tables)), COMPONENTS))

    def encode(self, weights: Float[np.ndarray, "w"]) -> Float[np.ndarray, "k"]:  # noqa: F821
        """Projection of a network's table."""
        return self.pca.project(tabulate(weights))

    def numbers(self, code: Float[np.ndarray, "k"], places: Places) -> Float[np.ndarray, "n 3"]:  # noqa: F821
        """The interpolated logarithms that a code stands for: linear in the code."""
        return places.stencil.read(self.pca.reconstruct(code).reshape(-1, 3))

    def decode(self, code: Float[np.ndarray, "k"]) -> Reflectance:  # noqa: F821
        """The reflectance of a code."""
        return lambda places: reflectance(self.numbers(code, places), places.light[:, 2])


def tabulate(weights: Float[np.ndarray, "w"]) -> Float[np.ndarray, "length"]:  # noqa: F821
    """The table of a network, cell by cell, [576 000]."""
    return tabulated(evaluated(weights, _cell_inputs()))


def tabulated(f: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, "length"]:  # noqa: F821
    """f at all cells → their table."""
    return stored(f, cell_directions()[0][:, 2]).reshape(-1)


@cache
def _cell_inputs() -> np.ndarray:
    return network_inputs(*cell_directions())
