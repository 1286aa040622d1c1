"""Refining a code against its material: Adam on the code's numbers alone. The program does it by Levenberg and Marquardt's
method on samples of its own, so that codes differ and their quality must not."""

from collections.abc import Callable
from functools import cached_property

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float

from .autoencoder import Autoencoder
from .objective import Counts, loss
from .places import Reflectance
from .sample_sets import SampleSets

COUNTS = Counts(2048, 2048, 768, 4)
TERMS = (1.0, 0.2, 1.0)
STEPS, RATE = 400, 3e-2
FIRST, SECOND, TINY = 0.9, 0.999, 1e-8  # of Adam (Kingma and Ba 2015)


class Refiner:
    """Refines codes of one autoencoder, all on the same directions."""

    def __init__(self, model: Autoencoder, seed: int = 0) -> None:
        self._model, self._sets = model, SampleSets.drawn(seed, 1, COUNTS)

    def __call__(self, code: Float[np.ndarray, "k"], reflectance: Reflectance) -> Float[np.ndarray, "k"]:  # noqa: F821
        """A code near the material → one that is as near as it gets from there."""
        f = np.maximum(reflectance(self._sets.places), 0)
        wanted = tuple(jnp.asarray(kind[0], jnp.float64) for kind in self._sets.wanted(f))
        return np.asarray(self._run(jnp.asarray(code), wanted))

    @cached_property
    def _run(self) -> Callable[[jax.Array, tuple[jax.Array, ...]], jax.Array]:
        inputs, factor = jnp.asarray(self._sets.inputs[0]), jnp.asarray(self._sets.factor[0])
        model = self._model

        def run(code: jax.Array, wanted: tuple[jax.Array, ...]) -> jax.Array:
            slope_at = jax.grad(lambda own: loss(model.decode(own), inputs, factor, wanted, COUNTS, TERMS, model.widths))

            def step(state: tuple[jax.Array, ...], index: jax.Array) -> tuple[tuple[jax.Array, ...], None]:
                own, mean, square = state
                slope = slope_at(own)
                mean, square = mean + (1 - FIRST) * (slope - mean), square + (1 - SECOND) * (slope * slope - square)
                rate = 0.5 * RATE * (1 + jnp.cos(jnp.pi * index / STEPS))
                size = jnp.sqrt(square / (1 - SECOND ** (index + 1))) + TINY
                return (own - rate * mean / (1 - FIRST ** (index + 1)) / size, mean, square), None

            zero = jnp.zeros_like(code)
            return jax.lax.scan(step, (code, zero, zero), jnp.arange(STEPS, dtype=jnp.float64))[0][0]

        return jax.jit(run)
