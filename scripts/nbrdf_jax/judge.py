"""log_error over `rus32k` and PSNR under `studio` for many pairs of networks at once."""

from dataclasses import dataclass
from functools import cache, partial

import jax
import jax.numpy as jnp
import numpy as np

from . import metrics
from .coordinates import network_inputs
from .directions import rus32k
from .network import WIDTHS, reflectance
from .sphere import LitSphere

SIZE = 128


@dataclass(frozen=True)
class Figures:
    """One number per material of each metric, [m]."""

    log_error: np.ndarray
    studio_psnr: np.ndarray


def judge(reference: jax.Array, other: jax.Array, widths: tuple[int, ...] = WIDTHS) -> Figures:
    """reference [m, 675], other [m, weights of `widths`] → figures [m] each."""
    errors, decibels = _judge(reference, other, *_inputs(), widths=widths)
    return Figures(np.asarray(errors), np.asarray(decibels))


@cache
def _inputs() -> tuple[jax.Array, ...]:
    """Network inputs and cosines of the direction set; of the sphere's lit pixels, lamp by lamp; weights of lamps."""
    light, view = rus32k()
    scene = LitSphere.under("studio", SIZE)
    spheres = np.stack([network_inputs(lit, scene.view) for lit in scene.light])
    weight = np.pi * scene.cosine[:, :, None] * scene.irradiance[:, None, :]
    return tuple(jnp.asarray(array) for array in (network_inputs(light, view), light[:, 2], spheres, weight))


@partial(jax.jit, static_argnames="widths")
def _judge(
    reference: jax.Array,  # [m, 675]
    other: jax.Array,  # [m, weights]
    inputs: jax.Array,  # [n, 6]
    cosine: jax.Array,  # [n]
    spheres: jax.Array,  # [lamps, pixels, 6]
    weight: jax.Array,  # [lamps, pixels, 3]
    widths: tuple[int, ...],
) -> tuple[jax.Array, jax.Array]:
    def render(weights: jax.Array, sizes: tuple[int, ...]) -> jax.Array:
        f = jax.vmap(lambda x: reflectance(weights, x, sizes))(spheres)
        # where, not only ×: a code far out may give infinity below the horizon, and 0 · ∞ is not black.
        return jnp.sum(jnp.where(weight > 0, f * weight, 0.0), axis=0)

    def one(pair: tuple[jax.Array, jax.Array]) -> tuple[jax.Array, jax.Array]:
        f, g = reflectance(pair[0], inputs), reflectance(pair[1], inputs, widths)
        return metrics.log_error(f, g, cosine), metrics.psnr(render(pair[0], WIDTHS), render(pair[1], widths))

    # One material after the other: the memory of all spheres at once buys no speed.
    return jax.lax.map(one, (reference, other))
