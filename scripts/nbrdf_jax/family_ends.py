"""Networks of the ends of families, fitted here: as any material would come, each from a random start of its own, and once
more from the shared start. Whatever is measured with them differs from the program's figures by what two fits differ."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from . import batch_fit
from .batch_fit import Options
from .evaluation import of_network
from .families import Family, all_families, of_formula
from .interpolation import Codes, walk_between, written_out
from .learned import Learned
from .library import Library
from .places import Reflectance, walked
from .sample_sets import SampleSets, worth
from .walks import End
from .workers import all_of

STEPS, SHARED_STEPS = 10_000, 4_000


@dataclass(frozen=True, eq=False)
class FamilyEnds:
    """Both libraries by name."""

    networks: Library
    shared: Library

    @classmethod
    def fitted(cls, shared_start: np.ndarray, run: Callable = all_of) -> "FamilyEnds":
        """The ends of one lobe at a time; `run` works on the lobes."""
        lobes = list(dict.fromkeys(family.lobe for family in all_families()))
        starts = {name: batch_fit.random_start(0, index) for index, name in enumerate(_formulas(lobes))}

        def fit(lobe: str) -> list[dict[str, list[float]]]:
            formulas = _formulas((lobe,))
            networks = _fitted(formulas, np.stack([starts[name] for name in formulas]), Options(STEPS, proximity=0.0))
            again = {name: of_network(weights) for name, weights in networks.items()}
            shared = _fitted(again, np.stack([shared_start] * len(again)), Options(SHARED_STEPS))
            return [{name: weights.tolist() for name, weights in library.items()} for library in (networks, shared)]

        fitted = run("ends of families", fit, lobes, of=(shared_start.tolist(), STEPS, SHARED_STEPS))
        return cls(*({name: np.array(weights) for lobe in fitted for name, weights in lobe[kind].items()} for kind in (0, 1)))

    def errors(self, learned: Learned, methods: list[str], codes: Codes, run: Callable = all_of) -> dict[str, dict[Family, float]]:
        """method → family → log_error of the middle against the true one; `run` works on the families."""
        joined = learned.joined(self.networks, self.shared)
        places = walked(False)
        families = all_families()

        def middles(place: int) -> list[float]:
            family = families[place]
            pair = _name(family, 0), _name(family, 1)
            ends = tuple(End(of_network(self.networks[name])) for name in pair)
            return [family.middle_error(walk_between(method, pair, ends, joined, codes).at(0.5), places) for method in methods]

        depends = methods, written_out(codes), written_out({"networks": self.networks, "shared": self.shared})
        found = run("middles of families", middles, range(len(families)), partial(joined.prepare, methods), depends)
        return {method: {family: own[place] for family, own in zip(families, found)} for place, method in enumerate(methods)}


def _formulas(lobes: Sequence[str]) -> dict[str, Reflectance]:
    """The ends of all families with these lobes, by name."""
    return {_name(family, end): of_formula(family.at(float(end))) for family in all_families() if family.lobe in lobes for end in (0, 1)}


def _name(family: Family, end: int) -> str:
    return f"family/{family.lobe}-{family.name}-{end}"


def _fitted(materials: dict[str, Reflectance], starts: np.ndarray, options: Options) -> Library:
    sets = SampleSets.drawn(options.seed, worth(options.steps))
    targets = [sets.wanted(np.maximum(f(sets.places), 0)) for f in materials.values()]
    mesh = batch_fit.devices_mesh()
    spare = -len(materials) % mesh.size
    wanted = tuple(np.stack([target[kind] for target in targets + targets[:1] * spare]) for kind in range(3))
    weights = batch_fit.fit(np.concatenate((starts, starts[:1].repeat(spare, axis=0))), wanted, sets, options, mesh, lambda _: None)
    return {name: own.astype(np.float64) for name, own in zip(materials, weights)}
