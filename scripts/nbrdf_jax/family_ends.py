"""Networks of the ends of families, fitted here: as any material would come, each from a random start of its own, and once
more from the shared start. Whatever is measured with them differs from the program's figures by what two fits differ."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from . import batch_fit
from .batch_fit import Options
from .evaluation import of_network
from .families import Family, all_families, of_formula
from .interpolation import Codes, walk_between
from .learned import Learned
from .library import Library
from .places import Reflectance, walked
from .sample_sets import SampleSets, worth
from .walks import End

STEPS, SHARED_STEPS = 10_000, 4_000


@dataclass(frozen=True, eq=False)
class FamilyEnds:
    """Both libraries by name."""

    networks: Library
    shared: Library

    @classmethod
    def fitted(cls, shared_start: np.ndarray, progress: Callable[[int], object]) -> "FamilyEnds":
        """`progress` is told the steps of all networks together, STEPS + SHARED_STEPS in all."""
        formulas = {_name(family, end): of_formula(family.at(float(end))) for family in all_families() for end in (0, 1)}
        starts = np.stack([batch_fit.random_start(0, index) for index in range(len(formulas))])
        networks = _fitted(formulas, starts, Options(STEPS, proximity=0.0), progress)
        again = {name: of_network(weights) for name, weights in networks.items()}
        shared = _fitted(again, np.broadcast_to(shared_start, starts.shape), Options(SHARED_STEPS), progress)
        return cls(networks, shared)

    def errors(self, learned: Learned, methods: list[str], codes: Codes) -> dict[str, dict[Family, float]]:
        """method → family → log_error of the middle against the true one."""
        joined = learned.joined(self.networks, self.shared)
        places = walked(False)
        found: dict[str, dict[Family, float]] = {method: {} for method in methods}
        for family in all_families():
            pair = _name(family, 0), _name(family, 1)
            ends = tuple(End(of_network(self.networks[name])) for name in pair)
            for method in methods:
                walk = walk_between(method, pair, ends, joined, codes)
                found[method][family] = family.middle_error(walk.at(0.5), places)
        return found


def _name(family: Family, end: int) -> str:
    return f"family/{family.lobe}-{family.name}-{end}"


def _fitted(materials: dict[str, Reflectance], starts: np.ndarray, options: Options, progress: Callable[[int], object]) -> Library:
    sets = SampleSets.drawn(options.seed, worth(options.steps))
    targets = [sets.wanted(np.maximum(f(sets.places), 0)) for f in materials.values()]
    mesh = batch_fit.devices_mesh()
    spare = -len(materials) % mesh.size
    wanted = tuple(np.stack([target[kind] for target in targets + targets[:1] * spare]) for kind in range(3))
    weights = batch_fit.fit(np.concatenate((starts, starts[:1].repeat(spare, axis=0))), wanted, sets, options, mesh, progress)
    return {name: own.astype(np.float64) for name, own in zip(materials, weights)}
