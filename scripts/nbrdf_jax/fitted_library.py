"""Writes a library as `nbrdf` reads it: library.safetensors and manifest.json, which has the other's checksum and comes last."""

import hashlib
import json
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from safetensors.numpy import save

from . import split
from .library import SHARED_START, database
from .network import WIDTHS

MOST = 10_000  # networks of a library that `nbrdf` reads


@dataclass(frozen=True)
class Entry:
    """One fitted material; `error` is its distance from what it was fitted to, by key of the measuring protocol."""

    name: str
    source_file: str
    weights: np.ndarray
    error: dict[str, float]


@dataclass(frozen=True)
class Provenance:
    """What the library is, and how it was made; `derived_from` holds file, sha256, source, terms of every file read."""

    title: str
    command: str
    seed: int
    derived_from: list[dict[str, str]]


def write(folder: Path, start: np.ndarray, entries: list[Entry], provenance: Provenance, standard_names: list[str]) -> None:
    """Both files, each under another name first. `standard_names` are those of the databases, which say who is held out."""
    held_out = {name for kind in split.RULES for name in split.held_out(standard_names, kind)}
    networks = {entry.name: entry.weights.astype(np.float32) for entry in entries} | {SHARED_START: start.astype(np.float32)}
    tensors = save(networks, metadata=networks_metadata())
    rows = [
        {"name": entry.name, "database": _database(entry.name, standard_names), "held_out": entry.name in held_out, "source_file": entry.source_file, "error": entry.error}
        for entry in entries
    ]
    content = {"schema": 1, **asdict(provenance), "shared_start": True, "tensors_sha256": hashlib.sha256(tensors).hexdigest(), "materials": rows}
    folder.mkdir(parents=True, exist_ok=True)
    manifest = (json.dumps(content, indent=2, ensure_ascii=False) + "\n").encode()
    for name, data in (("library.safetensors", tensors), ("manifest.json", manifest)):
        whole(folder / name, data)


def networks_metadata() -> dict[str, str]:
    """What a .safetensors of networks says of their shape."""
    return {"hidden": ",".join(map(str, WIDTHS[1:-1]))}


def whole(path: Path, data: bytes) -> None:
    """Writes a file whole or not at all."""
    part = path.with_name(f".{path.name}.part")
    part.write_bytes(data)
    part.replace(path)


def _database(name: str, standard_names: list[str]) -> str:
    if name.startswith("rgl/"):
        return "rgl"
    return "merl" if name in standard_names and database(name) == "merl" else "other"
