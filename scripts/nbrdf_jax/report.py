"""Reads what `nbrdf evaluate --per-material --json` writes, and says exactly what is missing when something is."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .invalid import InvalidFile

KEYS = ("log_error", "studio_psnr")
VARIANTS = ("feed_forward", "unrolled", "refined")
REMEDY = "nbrdf evaluate --per-material --json > evaluate.json"


@dataclass(frozen=True)
class Material:
    """One held-out material of a row: its code and the figures the report claims."""

    name: str
    code: tuple[float, ...]
    figures: dict[str, float]


@dataclass(frozen=True)
class Row:
    """One representation on one database: the claimed means and the materials behind them."""

    variant: str
    database: str
    means: dict[str, float]
    materials: tuple[Material, ...]


@dataclass(frozen=True)
class Report:
    """The rows of the autoencoder; rows of other representations cannot be checked here and are left out."""

    reference: str
    rows: tuple[Row, ...]


def read(path: Path | str, model: str = "znbrdf") -> Report:
    """An evaluation report; rows named `model`."""
    path = Path(path)
    if not path.is_file():
        raise InvalidFile(path, "a report of `nbrdf evaluate`", "no such file", REMEDY)
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise InvalidFile(path, "JSON", str(error), REMEDY) from error
    where = f"{path}"
    if _get(content, "schema", int, where) != 1:
        raise InvalidFile(path, '"schema": 1', str(content["schema"]))
    reference = _get(content, "reference", str, where)
    rows = _get(content, "rows", list, where)
    mine = [_row(row, f"{where}: rows[{i}]") for i, row in enumerate(rows) if _get(row, "name", str, where) == model]
    if not mine:
        raise InvalidFile(path, f'a row named "{model}"', "none", REMEDY)
    return Report(reference, tuple(mine))


def _row(row: dict[str, Any], where: str) -> Row:
    variant = _get(row, "variant", str, where)
    if variant not in VARIANTS:
        raise InvalidFile(where, f"a variant of {VARIANTS}", repr(variant))
    means = {key: _number(_get(row, key, dict, where), "mean", f"{where}.{key}") for key in KEYS}
    materials = _get(row, "materials", list, where)
    if not materials:
        raise InvalidFile(where, "at least one material", "none", REMEDY)
    parsed = tuple(_material(item, f"{where}.materials[{i}]") for i, item in enumerate(materials))
    return Row(variant, row.get("database", "merl"), means, parsed)


def _material(item: Any, where: str) -> Material:
    code = tuple(_get(item, "code", list, where))
    if not all(isinstance(number, int | float) for number in code):
        raise InvalidFile(where, "a code of numbers", str(code))
    return Material(_get(item, "name", str, where), code, {key: _number(item, key, where) for key in KEYS})


def _number(item: Any, key: str, where: str) -> float:
    return float(_get(item, key, int | float, where))


def _get(item: Any, key: str, kind: Any, where: str) -> Any:
    if not isinstance(item, dict) or key not in item:
        found = f"only {', '.join(item)}" if isinstance(item, dict) and item else "nothing of that name"
        raise InvalidFile(where, f'"{key}"', found, REMEDY)
    if not isinstance(item[key], kind) or isinstance(item[key], bool):
        raise InvalidFile(where, f'"{key}" of type {getattr(kind, "__name__", "number")}', repr(item[key])[:60], REMEDY)
    return item[key]
