"""What can be fitted: networks of a library, measured tables, and made-up materials for measuring."""

import colorsys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import library, merl, rgl
from .analytic import Microfacet, f0_from_ior
from .arrays import Vectors
from .evaluation import of_network
from .invalid import InvalidFile
from .places import Places, Reflectance

SYNTHETIC = "ggx-"


@dataclass(frozen=True, eq=False)
class Source:
    """A material to be fitted: its name, what the file it is from is called, and f_r at places; read when it is asked for."""

    name: str
    file: str
    load: Callable[[], Reflectance]


def file_of(path: Path) -> Path:
    """The file itself; of a library's folder that of its networks."""
    path = path / "library.safetensors" if path.is_dir() else path
    if not path.is_file():
        raise InvalidFile(path, "a library, a MERL .binary or an RGL .bsdf", "no such file")
    return path


def of_file(path: Path, called: str) -> list[Source]:
    """A library (.zip, .safetensors), a MERL .binary or an RGL .bsdf; `called` is told as the file of its materials."""
    match path.suffix:
        case ".binary":
            return [Source(path.stem, called, lambda: _of_pairs(merl.read(path)))]
        case ".bsdf":
            return [Source(library.name_of(path.stem), called, lambda: _of_pairs(rgl.read(path)))]
        case ".zip" | ".safetensors":
            return [Source(name, called, lambda weights=weights: of_network(weights)) for name, weights in library.read(path).items()]
        case _:
            raise InvalidFile(path, "a library, a MERL .binary or an RGL .bsdf", f"a name that ends in {path.suffix or 'nothing'!r}")


def synthetic(count: int, seed: int) -> list[Source]:
    """Lambert with a GGX lobe, each with parameters of its own."""
    return [Source(f"{SYNTHETIC}{index:06}", "", lambda index=index: _of_pairs(made_up(index, seed))) for index in range(count)]


def made_up(index: int, seed: int) -> Microfacet:
    """Half of them metals without a base, half of them dielectrics; widths even in their logarithm."""
    random = np.random.default_rng((seed, 3, index))
    colour = tuple(float(v) for v in colorsys.hsv_to_rgb(random.uniform(), random.uniform(0, 0.8), random.uniform(0.05, 0.9)))
    alpha = float(np.exp(random.uniform(np.log(0.05), np.log(0.7))))
    if random.uniform() < 0.5:
        return Microfacet((0.0, 0.0, 0.0), colour, alpha)
    return Microfacet(colour, (f0_from_ior(float(random.uniform(1.3, 2.0))),) * 3, alpha)


def checked(sources: Iterable[Source]) -> list[Source]:
    """Sorted by name; two of one name are refused."""
    kept = sorted(sources, key=lambda source: source.name)
    for first, second in zip(kept, kept[1:]):
        if first.name == second.name:
            raise InvalidFile(second.file, "every name once", f"{first.name} also in {first.file}", "rename one of the files")
    return kept


def _of_pairs(f: Callable[[Vectors, Vectors], Vectors]) -> Reflectance:
    def at(places: Places) -> Vectors:
        return np.asarray(f(places.light, places.view))

    return at
