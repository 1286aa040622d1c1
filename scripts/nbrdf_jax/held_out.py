"""The table of held-out materials: every row encoded (or its code taken as given), decoded, and judged here."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from . import split
from .evaluation import of_network
from .invalid import InvalidFile
from .judge import BOUNDS, KEYS, Seen, figures
from .learned import Learned
from .refine import Refiner
from .report import Report, Row
from .spread import Spread, is_higher_better
from .workers import all_of


@dataclass(frozen=True)
class Recomputed:
    """A row's figures as found here: a number per key and material. `code_difference`: largest, where codes were made here."""

    row: Row
    names: tuple[str, ...]
    figures: dict[str, np.ndarray]
    code_difference: float | None

    def spread(self, key: str) -> Spread:
        """Mean, median, tail and names."""
        return Spread.of(self.names, self.figures[key], is_higher_better(key))


def recompute(report: Report, learned: Learned, where: object, run: Callable = all_of) -> list[Recomputed]:
    """All rows of a report; `run` works on the materials."""
    rows = [(row, _names(row, learned, where)) for row in report.rows]
    materials = sorted({name for _, names in rows for name in names})

    def judge(name: str) -> list[tuple[int, dict[str, float], float | None]]:
        reference = Seen.of(of_network(learned.networks[name]))
        return [(index, *_judged(reference, row, names.index(name), name, learned)) for index, (row, names) in enumerate(rows) if name in names]

    judged = run("held-out materials", judge, materials, partial(learned.prepare, {row.name for row, _ in rows}), report.rows)
    found = {(index, name): (figures, difference) for name, own in zip(materials, judged) for index, figures, difference in own}
    return [_gathered(row, names, [found[index, name] for name in names]) for index, (row, names) in enumerate(rows)]


def refined_anew(report: Report, learned: Learned, where: object, run: Callable = all_of) -> list[Recomputed]:
    """The refined rows of the autoencoder with codes that are refined here, from those of the encoder."""
    refiner = Refiner(learned.model)

    def judge(job: tuple[str, str]) -> dict[str, float]:
        network = of_network(learned.networks[job[1]])
        code = refiner(learned.encode(learned.networks[job[1]]), network)
        return figures(Seen.of(network), Seen.of(learned.decoded("znbrdf", code)))

    rows = [(row, _names(row, learned, where)) for row in report.rows if (row.name, row.variant) == ("znbrdf", "refined")]
    jobs = [(row.label, name) for row, names in rows for name in names]
    found = dict(zip(jobs, run("codes refined anew", judge, jobs)))
    return [_gathered(row, names, [(found[row.label, name], None) for name in names]) for row, names in rows]


def _judged(reference: Seen, row: Row, place: int, name: str, learned: Learned) -> tuple[dict[str, float], float | None]:
    given = np.array(row.materials[place].code, float)
    own = learned.own_code(row.name, row.variant, name)
    code = given if own is None else own
    difference = None if own is None else float(np.abs(own - given).max() / max(np.abs(given).max(), 1e-12))
    return figures(reference, Seen.of(learned.decoded(row.name, code))), difference


def _gathered(row: Row, names: list[str], found: list[tuple[dict[str, float], float | None]]) -> Recomputed:
    by_key = {key: np.array([one[key] for one, _ in found]) for key in (*KEYS, *BOUNDS)}
    apart = [difference for _, difference in found if difference is not None]
    return Recomputed(row, tuple(names), by_key, max(apart) if apart else None)


def _names(row: Row, learned: Learned, where: object) -> list[str]:
    names = [material.name if row.database == "merl" or "/" in material.name else f"{row.database}/{material.name}" for material in row.materials]
    expected = split.held_out(learned.networks, row.database)
    if sorted(names) != expected:
        odd = sorted(set(names) ^ set(expected))
        raise InvalidFile(where, f"the {len(expected)} held-out {row.database} materials", f"{len(names)}; differing: {', '.join(odd)}")
    for material in row.materials:
        if len(material.code) != learned.code_size(row.name):
            raise InvalidFile(where, f"{learned.code_size(row.name)} numbers in the code of {material.name}", str(len(material.code)))
    return names
