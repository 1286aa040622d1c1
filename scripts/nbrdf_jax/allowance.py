"""How far apart two programs may be where that is more than rounding, and why: every larger tolerance stands here.

Those of quadratures and of rounding are bounds. Those of fits and of other optimizers are what a first run found, rounded up: they
notice when something changes, and are no proof that two programs do the same.
"""

from dataclasses import dataclass

from .physics import NEAR_0

TOLERANCE = 1e-4  # relative; of everything that is given no reason
QUADRATURES = "two quadratures of at least 4096 directions each"
NEAR_1 = 5e-3  # an albedo this close to 1 is above it or not by its quadrature
SIGNS = f"values within {NEAR_0:g} of 0 have the sign of their rounding"
EDGE = f"albedos within {NEAR_1:g} of 1 are above it or not: {QUADRATURES}"
ROUNDING = "0 but for rounding"
COLOURS = "the last digits of colours in float32"
FITS = "both programs fit networks of their own to the ends"
OPTIMIZERS = "another optimizer on other samples"


@dataclass(frozen=True)
class Allowance:
    """Why two figures may be further apart, and how far: by a share of what is claimed, by an amount, or as far as a range goes
    that both must lie in."""

    reason: str
    relative: float = 0.0
    absolute: float = 0.0
    between: tuple[float, float] | None = None

    def admits(self, ours: float, claimed: float) -> bool:
        """NaN is never admitted."""
        apart = abs(ours - claimed)
        is_within = self.between is not None and all(self.between[0] <= figure <= self.between[1] for figure in (ours, claimed))
        return apart <= self.relative * abs(claimed) or apart <= self.absolute or is_within


ALLOWANCES = {
    "albedo_max": Allowance(QUADRATURES, relative=5e-3),
    "albedo_max_beyond": Allowance(QUADRATURES, relative=5e-3),
    "end_error": Allowance(ROUNDING, absolute=5e-8),
    "hue_excursion": Allowance(COLOURS, absolute=5e-7),
}


def of_signs(low: float, high: float) -> Allowance:
    """Of a share of values below 0: between the shares below −`NEAR_0` and below `NEAR_0`. Means and ranks of shares keep that order."""
    return Allowance(SIGNS, between=(low, high))


def of_edge(low: int, high: int) -> Allowance:
    """Of a count of albedos above 1: between the counts above 1 + `NEAR_1` and above 1 − `NEAR_1`."""
    return Allowance(EDGE, between=(float(low), float(high)))


def of_refined_anew(key: str, database: str) -> Allowance:
    """Of codes that two optimizers found: metrics, which an optimizer makes small, and not what a material is."""
    is_far = database != "merl"
    reason = f"{OPTIMIZERS}; far from the training materials there are several minima" if is_far else OPTIMIZERS
    if key.endswith("psnr"):
        return Allowance(reason, relative=0.03 if is_far else 0.01)
    if key.endswith("ssim"):
        return Allowance(reason, absolute=0.02 if is_far else 2e-3)
    return Allowance(reason, relative=0.12 if is_far else 0.1)


def of_family(method: str) -> Allowance:
    """Of middles between ends that both programs fitted: as far as such fits differ, which what is mixed decides."""
    match method:
        case "raw_weights" | "shared_start":
            # Where two fits end in weights is far apart even where their values are not.
            return Allowance(f"{FITS}, and walk through other weights", relative=0.4)
        case "pca_weights":
            return Allowance(FITS, relative=0.05)
        case "latent" | "latent_refined":
            return Allowance(f"{FITS}, and codes differ with them", relative=0.15, absolute=5e-4)
        case _:
            return Allowance(FITS, relative=0.04)
