"""Figures of two programs laid side by side, of what kind each is, and which of them agree."""

from collections.abc import Iterable
from dataclasses import dataclass

from . import allowance as allowed
from .allowance import ALLOWANCES, Allowance
from .families import LOBES, Family
from .held_out import Recomputed
from .interpolation import Walked
from .judge import KEYS
from .report import Method

PHYSICS = ("negative_share", "albedo_max", "reciprocity", "energy_violations")
SMOOTHNESS = ("length_ratio", "step_ratio", "hue_excursion")
# Kinds of figures, in the order of tables.
OF_MATERIALS, OF_MATTER, OF_MEANS, ANEW = "held-out materials: errors and pictures", "held-out materials: physics", "means of the report over its own materials", "held-out materials: codes refined anew"
OF_WALKS, OF_STEPS, OF_WAYS = "walks: ends and middle", "walks: smoothness", "walks: physics"
OF_FAMILIES = "families with a known middle"
METRICS = tuple(key for key in KEYS if key not in PHYSICS)


@dataclass(frozen=True)
class Check:
    """One figure: found here, claimed there, and the material whose own figures differ most."""

    kind: str
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

    def is_close(self, tolerance: float) -> bool:
        """Within the tolerance, reasons apart."""
        return self.difference <= tolerance

    def agrees(self, tolerance: float) -> bool:
        """Within the tolerance, or as far apart as this figure has a reason for."""
        return self.is_close(tolerance) or (self.allowance is not None and self.allowance.admits(self.ours, self.claimed))

    def verdict(self, tolerance: float) -> str:
        """ok; ok with the reason for more than the tolerance; or DISAGREES."""
        if not self.agrees(tolerance):
            return "DISAGREES"
        return "ok" if self.is_close(tolerance) else f"ok: {self.allowance.reason}"


def of_row(found: Recomputed) -> Iterable[Check]:
    """Every mean of a held-out row; and the claim against its own materials, since a mean over something else would show here."""
    for key, mean in found.row.means.items():
        claimed = [material.figures[key] for material in found.row.materials]
        apart = [abs(a - b) / max(abs(b), 1e-12) for a, b in zip(found.figures[key], claimed)]
        place = max(range(len(apart)), key=lambda i: (apart[i] != apart[i], apart[i]))
        kind = OF_MATTER if key in PHYSICS else OF_MATERIALS
        yield Check(kind, found.row.label, key, found.spread(key).mean, mean, f"{found.names[place]} {apart[place]:.1e}", of_part(found, key, "mean"))
        yield Check(OF_MEANS, f"{found.row.label} (its own materials)", key, sum(claimed) / len(claimed), mean)


def of_refined_anew(found: Recomputed) -> Iterable[Check]:
    """The means of a refined row beside those of codes that were refined here."""
    for key in METRICS:
        if key in found.row.means:
            allowance = allowed.of_refined_anew(key, found.row.database)
            yield Check(ANEW, f"{found.row.label} anew", key, found.spread(key).mean, found.row.means[key], allowance=allowance)


def of_families(found: dict[str, dict[Family, float]], methods: dict[str, Method]) -> Iterable[Check]:
    """Mean over the four families of every lobe, method by method, where the report has families."""
    for method, errors in found.items():
        claimed = methods[method].families
        for lobe in LOBES if claimed else ():
            theirs = mean_of_lobe({family: claimed[family.lobe, family.name][0] for family in errors}, lobe)
            yield Check(OF_FAMILIES, f"{method} families", f"middle {lobe}", mean_of_lobe(errors, lobe), theirs, allowance=allowed.of_family(method))


def mean_of_lobe(errors: dict[Family, float], lobe: str) -> float:
    """Over the four families."""
    mine = [error for family, error in errors.items() if family.lobe == lobe]
    return sum(mine) / len(mine)


def of_method(found: Walked, claimed: Method) -> Iterable[Check]:
    """Mean, median, p90 and worst of every key of an interpolation, and its counts."""
    for key, spread in claimed.spreads.items():
        for part in ("mean", "median", "p90", "max"):
            # What grows without bound beyond the ends is told by its middle alone: the mean is that of one pair.
            if key == "albedo_max_beyond" and part != "median":
                continue
            yield Check(kind_of(key), found.name, f"{key} {part}", getattr(found.spread(key), part), float(spread[part]), allowance=of_part(found, key, part))
    for key, count in claimed.counts.items():
        yield Check(OF_WAYS, found.name, key, float(found.violations(_of_count(key))), float(count), allowance=of_count(found, key))


def kind_of(key: str) -> str:
    """Of a figure of walks."""
    if key in SMOOTHNESS:
        return OF_STEPS
    return OF_WAYS if key.removesuffix("_beyond") in PHYSICS else OF_WALKS


def of_part(found: Recomputed | Walked, key: str, part: str) -> Allowance | None:
    """How far the mean, median, p90 or worst of a key may be from what is claimed."""
    if not key.startswith("negative_share"):
        return ALLOWANCES.get(key)
    return allowed.of_signs(*(getattr(found.spread(f"{key}_{side}"), part) for side in ("low", "high")))


def of_count(found: Walked, key: str) -> Allowance:
    """How far a count of albedos above 1 may be from what is claimed."""
    return allowed.of_edge(*(found.violations(_of_count(key), 1 + side * allowed.NEAR_1) for side in (1, -1)))


def _of_count(key: str) -> str:
    return key.replace("energy_violations", "albedo_max")
