"""Figures of two programs laid side by side: how far apart they may be, and why where that is more than rounding."""

from collections.abc import Iterable
from dataclasses import dataclass

from .families import LOBES, Family
from .held_out import Recomputed
from .interpolation import Walked
from .judge import KEYS
from .report import Method

TOLERANCE = 1e-4
QUADRATURES = "two quadratures of at least 4096 directions each"
SIGNS = "values at 0 have the sign of their rounding, which is another in float32"
ROUNDING = "0 but for rounding"
COLOURS = "a distance between colours that are rounded to float32"
FITS = "both fit networks of their own to the ends"
OPTIMIZERS = "another optimizer on other samples"


@dataclass(frozen=True)
class Allowance:
    """A larger tolerance for one key, and its reason."""

    relative: float
    absolute: float
    reason: str


ALLOWANCES = {
    "albedo_max": Allowance(1e-2, 0.0, QUADRATURES),
    "albedo_max_beyond": Allowance(2e-2, 0.0, QUADRATURES),
    "energy_violations": Allowance(0.0, 1.0, QUADRATURES),
    "energy_violations_beyond": Allowance(0.0, 2.0, QUADRATURES),
    "negative_share": Allowance(TOLERANCE, 2e-4, SIGNS),
    "negative_share_beyond": Allowance(TOLERANCE, 2e-3, SIGNS),
    "end_error": Allowance(TOLERANCE, 1e-7, ROUNDING),
    "hue_excursion": Allowance(5e-4, 1e-6, COLOURS),
}
# exp ln(10⁻³) − 10⁻³ where both ends are 0: above or below it by the last digit.
METHOD_ALLOWANCES = {("log_mix", "negative_share"): Allowance(0.0, 1.0, SIGNS)}
# Codes that are refined anew: of metrics, which an optimizer makes small, and not of what a material is.
REFINED_ANEW = {"merl": Allowance(0.1, 0.0, OPTIMIZERS), "rgl": Allowance(0.15, 0.0, f"{OPTIMIZERS}; far from the training materials there are several minima")}
FAMILIES = Allowance(0.2, 7e-4, FITS)
# Where two fits end in weights is far apart even where their values are not.
FAMILIES_OF_WEIGHTS = Allowance(0.4, 0.0, f"{FITS}, and walk through other weights")
METRICS = tuple(key for key in KEYS if key not in ("negative_share", "albedo_max", "reciprocity"))


@dataclass(frozen=True)
class Check:
    """One figure: found here, claimed there, and the material or pair whose own figures differ most."""

    label: str
    key: str
    ours: float
    claimed: float
    worst: str = "-"
    allowance: Allowance | None = None

    @property
    def difference(self) -> float:
        """Relative to the claim. NaN where either is no number, which no tolerance admits."""
        return abs(self.ours - self.claimed) / max(abs(self.claimed), 1e-12) if self.ours != self.claimed else 0.0

    def agrees(self, tolerance: float) -> bool:
        """Within the tolerance, or within the larger one that this key has a reason for."""
        relative = max(tolerance, self.allowance.relative if self.allowance else 0.0)
        absolute = self.allowance.absolute if self.allowance else 0.0
        return self.difference <= relative or abs(self.ours - self.claimed) <= absolute

    def verdict(self, tolerance: float) -> str:
        """ok; ok with the reason for more than the tolerance; or DISAGREES."""
        if not self.agrees(tolerance):
            return "DISAGREES"
        return "ok" if self.difference <= tolerance or not self.allowance else f"ok: {self.allowance.reason}"


def of_row(found: Recomputed) -> Iterable[Check]:
    """Every mean of a held-out row; and the claim against its own materials, since a mean over something else would show here."""
    for key, mean in found.row.means.items():
        claimed = [material.figures[key] for material in found.row.materials]
        apart = [abs(a - b) / max(abs(b), 1e-12) for a, b in zip(found.figures[key], claimed)]
        place = max(range(len(apart)), key=lambda i: (apart[i] != apart[i], apart[i]))
        yield Check(found.row.label, key, found.spread(key).mean, mean, f"{found.names[place]} {apart[place]:.1e}", ALLOWANCES.get(key))
        yield Check(f"{found.row.label} (its own materials)", key, sum(claimed) / len(claimed), mean)


def of_refined_anew(found: Recomputed) -> Iterable[Check]:
    """The means of a refined row beside those of codes that were refined here."""
    for key in METRICS:
        if key in found.row.means:
            yield Check(f"{found.row.label} anew", key, found.spread(key).mean, found.row.means[key], "-", REFINED_ANEW[found.row.database])


def of_families(found: dict[str, dict[Family, float]], methods: dict[str, Method]) -> Iterable[Check]:
    """Mean over the four families of every lobe, method by method, where the report has families."""
    for method, errors in found.items():
        claimed = methods[method].families
        for lobe in LOBES if claimed else ():
            theirs = mean_of_lobe({family: claimed[family.lobe, family.name][0] for family in errors}, lobe)
            yield of_family(method, lobe, mean_of_lobe(errors, lobe), theirs)


def of_family(method: str, lobe: str, ours: float, claimed: float) -> Check:
    """The mean error of a method's middles with one lobe."""
    allowance = FAMILIES_OF_WEIGHTS if method in ("raw_weights", "shared_start", "pca_weights") else FAMILIES
    return Check(f"{method} families", f"middle {lobe}", ours, claimed, "-", allowance)


def mean_of_lobe(errors: dict[Family, float], lobe: str) -> float:
    """Over the four families."""
    mine = [error for family, error in errors.items() if family.lobe == lobe]
    return sum(mine) / len(mine)


def of_method(found: Walked, claimed: Method) -> Iterable[Check]:
    """Mean, median, p90 and worst of every key of an interpolation, and its counts."""
    for key, spread in claimed.spreads.items():
        allowance = METHOD_ALLOWANCES.get((found.name, key.removesuffix("_beyond"))) or ALLOWANCES.get(key)
        ours = found.spread(key)
        for part in ("mean", "median", "p90", "max"):
            # What grows without bound beyond the ends is told by its middle alone: the mean is that of one pair.
            if key == "albedo_max_beyond" and part != "median":
                continue
            yield Check(found.name, f"{key} {part}", getattr(ours, part), float(spread[part]), "-", allowance)
    for key, count in claimed.counts.items():
        ours = found.violations(key.replace("energy_violations", "albedo_max"))
        yield Check(found.name, key, float(ours), float(count), "-", ALLOWANCES[key])
