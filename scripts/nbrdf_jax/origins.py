"""Where the files that networks are fitted to come from, and on which terms: what the manifest of a library says of them.

Published files are known by their SHA-256. A library of this project has its own sources in its manifest, which are told
as well. Of anything else only the name and the checksum are known, and what a tensor file says of itself.
"""

import hashlib
import json
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from . import tensor_file
from .invalid import InvalidFile

Derived = dict[str, str]  # file, sha256, source, terms: a row of `derived_from`

NETWORKS_OF_LIBRARY, MANIFEST = "library.safetensors", "manifest.json"
UNKNOWN, ASK = "not known to this program", "ask who made it"
NETWORKS = (
    "Sztrajman, Rainer, Ritschel, Weyrich 2021, Neural BRDF Representation and Importance Sampling, doi 10.1111/cgf.14335: published network weights",
    "MIT; the measurements behind them: MERL BRDF database (Matusik et al. 2003), RGL material database (Dupuy and Jakob 2018)",
)
MEASURED = (
    "RGL material database (Dupuy and Jakob 2018, An Adaptive Parameterization for Efficient Material Acquisition and Rendering): measured table",
    "its own terms: read them where you get the files",
)
PUBLISHED = {
    "de79644946de1870f2dea6805ae8b4bdaa36bc55c33ef5a135223bdfcdb3ab80": NETWORKS,  # merl_nbrdf.zip
    "40995a4de63af018c3d93f1589d102170e7cd16a4f6c91e6a798656bce013a2c": NETWORKS,  # rgl_nbrdf_subset.zip
    "ce356ec33ac086aa19eb534dbfc21e08c793790c299e2cab660705d40c665f0a": MEASURED,  # cc_ibiza_sunset_rgb.bsdf
    "ce817d04568c39284908ce89b12989e68d6407ee48fb44f6cc644e7bfdf7c840": MEASURED,  # cg_sunflower_rgb.bsdf
    "8a8d491956c36ab75c1676ee2acc34c550215a3e771ef5b7e3046654359000c1": MEASURED,  # colodur_napoli_4f_rgb.bsdf
    "9d641fbb56358275509b2b1053d1002313e2dabc7b3ec202eb5c5a6943f7b70e": MEASURED,  # paper_white_rgb.bsdf
}


def sha256(path: Path) -> str:
    """Of a file, as digits."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def told_apart(paths: Iterable[Path]) -> dict[Path, str]:
    """A name for every file: its own, with as many folders before it as tell it from the others."""
    paths = list(dict.fromkeys(path.absolute() for path in paths))
    ends = {path: 1 for path in paths}

    def name(path: Path) -> str:
        return Path(*path.parts[-ends[path] :]).as_posix()

    while True:
        names = [name(path) for path in paths]
        seen = Counter(names)
        alike = [path for path, own in zip(paths, names) if seen[own] > 1 and ends[path] < len(path.parts)]
        if not alike:
            return dict(zip(paths, names))
        for path in alike:
            ends[path] += 1


def derived(path: Path, name: str) -> list[Derived]:
    """What is known of one file, and, of a library of this project, of what that was made from."""
    digits = sha256(path)
    if digits in PUBLISHED:
        source, terms = PUBLISHED[digits]
        return [_row(name, digits, source, terms)]
    manifest = path.with_name(MANIFEST)
    if path.name == NETWORKS_OF_LIBRARY and manifest.is_file():
        return _of_library(manifest, name, digits)
    described = _description(path) if path.suffix == ".bsdf" else ""
    return [_row(name, digits, f"{UNKNOWN}; the file says of itself: {described}" if described else UNKNOWN, ASK)]


def _of_library(manifest: Path, name: str, digits: str) -> list[Derived]:
    try:
        content = json.loads(manifest.read_text())
        if content.get("tensors_sha256", digits) != digits:
            raise InvalidFile(manifest, "the manifest of the networks beside it", "that of others", "put the two files together that belong together")
        before = [_row(*(str(row[key]) for key in ("file", "sha256", "source", "terms"))) for row in content["derived_from"]]
        title = str(content["title"])
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InvalidFile(manifest, "the manifest of a library", f"{type(error).__name__} {error}") from error
    return [_row(name, digits, f"nbrdf library: {title}", "those of the files it was made from" if before else ASK), *before]


def _description(path: Path) -> str:
    field = tensor_file.read(path).get("description", np.zeros(0, np.uint8))
    return field.tobytes().decode("utf-8", "replace").strip() if field.dtype == np.uint8 else ""


def _row(file: str, sha256: str, source: str, terms: str) -> Derived:
    return {"file": file, "sha256": sha256, "source": source, "terms": terms}
