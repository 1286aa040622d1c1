"""What fitting minimizes: mean |Δ ln(1 + f c)| + .2 · mean |Δ ln(f c + 10⁻³)| + .3 · RMS Δ display.

Three kinds of samples in a row: `log` directions, `relative` directions, and `pixels` of `lamps` directions each. `factor`
is cos θ_i, for a pixel's lamps times irradiance; pixels are displayed as clip(L, 0, 1)^(1/2.2), straight below 10⁻⁴.
"""

from typing import NamedTuple

from .arrays import Array, Inputs, Numbers, Scalar, Vectors, Weights
from .network import WIDTHS, unclamped

DARKEST, TOE, DISPLAY = 1e-3, 1e-4, 1 / 2.2
WEIGHTS = (1.0, 0.2, 0.3)


class Counts(NamedTuple):
    log: int
    relative: int
    pixels: int
    lamps: int

    @property
    def directions(self) -> int:
        return self.log + self.relative + self.pixels * self.lamps


STEP = Counts(128, 256, 32, 4)


def features(values: Vectors, factor: Numbers, counts: Counts) -> tuple[Array, Array, Array]:
    """values [directions, 3], factor [directions] → ln(1 + f c), ln(f c + 10⁻³), displayed pixels; each [n, 3]."""
    xp = values.__array_namespace__()
    weighted = values * factor[:, None]
    log = xp.log(xp.maximum(1.0 + weighted[: counts.log], 0.1))
    end = counts.log + counts.relative
    relative = xp.log(xp.maximum(weighted[counts.log : end], 0.0) + DARKEST)
    lit = xp.maximum(weighted[end:], 0.0).reshape(counts.pixels, counts.lamps, 3)
    radiance = xp.sum(lit, axis=1)
    curve = xp.minimum(xp.maximum(radiance, TOE), 1.0) ** DISPLAY
    return log, relative, xp.where(radiance < TOE, radiance * TOE ** (DISPLAY - 1), curve)


def loss(weights: Weights, inputs: Inputs, factor: Numbers, wanted: tuple[Array, Array, Array], counts: Counts, terms: tuple[float, float, float] = WEIGHTS, widths: tuple[int, ...] = WIDTHS) -> Scalar:
    """weights [675], inputs [directions, 6] → the loss of that network against wanted features; `terms` weigh its three parts."""
    xp = weights.__array_namespace__()
    own = features(unclamped(weights, inputs, widths), factor, counts)
    log, relative = (xp.mean(xp.abs(a - b)) for a, b in zip(own[:2], wanted[:2]))
    display = xp.sqrt(xp.mean((own[2] - wanted[2]) ** 2) + 1e-12)
    return terms[0] * log + terms[1] * relative + terms[2] * display
