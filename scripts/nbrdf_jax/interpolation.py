"""The table of interpolations: every method over the standard pairs."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from .evaluation import of_network
from .learned import Learned
from .library import database
from .spread import Spread, is_higher_better
from .walk_quality import BOUNDS, KEYS, walk_quality
from .walks import (
    End,
    Mix,
    NearestEnd,
    Walk,
    between_codes,
    between_tables,
    between_weights,
)
from .workers import all_of

OFFSET = 37
# The latent walks need codes that are refined, which is not repeated here: they are given.
CODED = {"latent": "unrolled", "latent_refined": "refined"}
METHODS = ("latent", "latent_refined", "raw_weights", "shared_start", "pca_weights", "pca_tables", "linear_mix", "log_mix", "log1p_mix", "nearest_end")
LEFT_OUT = {
    "latent_even": "a re-timed walk; its definition is the program's own",
    "latent_geodesic": "an optimized walk; its optimizer is the program's own",
    "latent_refined_geodesic": "an optimized walk; its optimizer is the program's own",
    "aligned_weights": "another matching of units would give another walk",
    "charting": "charts are learned by a method with choices of the program's own",
}
Codes = dict[str, dict[str, np.ndarray]]  # variant → name → code


@dataclass(frozen=True)
class Walked:
    """One method's figures: a number per key and pair."""

    name: str
    pairs: tuple[str, ...]
    figures: dict[str, np.ndarray]

    def spread(self, key: str) -> Spread:
        """Mean, median, tail and names."""
        return Spread.of(self.pairs, self.figures[key], is_higher_better(key))

    def violations(self, key: str = "albedo_max", limit: float = 1.0) -> int:
        """How many pairs have an albedo above the limit."""
        return int((self.figures[key] > limit).sum())


def standard_pairs(names: list[str], count: int) -> list[tuple[str, str]]:
    """The first `count` of (i, i + 37) over the sorted MERL names."""
    merl = sorted(name for name in names if database(name) == "merl")
    return [(name, merl[(i + OFFSET) % len(merl)]) for i, name in enumerate(merl[:count])]


def recompute(learned: Learned, methods: list[str], codes: Codes, count: int, run: Callable = all_of) -> list[Walked]:
    """Every method on the first `count` pairs; `run` works on the pairs."""
    pairs = standard_pairs(list(learned.networks), count)

    def walk(pair: tuple[str, str]) -> list[dict[str, float]]:
        ends = tuple(End(of_network(learned.networks[name])) for name in pair)
        return [walk_quality(walk_between(method, pair, ends, learned, codes), ends) for method in methods]

    found = run("walks", walk, pairs, partial(learned.prepare, methods), (methods, written_out(codes)))
    labels = tuple(f"{first} > {second}" for first, second in pairs)
    return [Walked(method, labels, {key: np.array([pair[place][key] for pair in found]) for key in (*KEYS, *BOUNDS)}) for place, method in enumerate(methods)]


def written_out(codes: Codes) -> dict[str, list[tuple[str, list[float]]]]:
    """Every number, as results depend on it."""
    return {variant: sorted((name, code.tolist()) for name, code in own.items()) for variant, own in codes.items()}


def walk_between(method: str, pair: tuple[str, str], ends: tuple[End, End], learned: Learned, codes: Codes) -> Walk:
    """A method's walk from one network of `learned` to another; `ends` are their reflectances."""
    match method:
        case "latent" | "latent_refined":
            return between_codes(tuple(codes[CODED[method]][name] for name in pair), learned.decode, learned.model.widths)
        case "raw_weights":
            return between_weights(*(learned.networks[name] for name in pair))
        case "shared_start":
            return between_weights(*(learned.of_shared_start(name) for name in pair))
        case "pca_weights":
            basis = learned.weights
            return between_weights(*(basis.reconstruct(basis.project(learned.of_shared_start(name))) for name in pair))
        case "pca_tables":
            return between_tables(learned.tables, tuple(learned.tables.encode(learned.networks[name]) for name in pair))
        case _:
            return _mixed(method, ends)


def _mixed(method: str, ends: tuple[End, End]) -> Walk:
    return NearestEnd(ends) if method == "nearest_end" else Mix(ends, {"linear_mix": None, "log_mix": 1e-3, "log1p_mix": 1.0}[method])
