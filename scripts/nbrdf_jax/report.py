"""Reads what `nbrdf evaluate --per-material --json` and `nbrdf compare --json` write, and says exactly what is missing."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import judge, walk_quality
from .invalid import InvalidFile

REQUIRED = ("log_error", "studio_psnr")
VARIANTS = {
    "znbrdf": ("feed_forward", "unrolled", "refined"),
    "pca_tables": ("projection", "refined"),
    "pca_weights": ("projection",),
}
REMEDY = "nbrdf evaluate --per-material --json > evaluate.json"
COMPARE_REMEDY = "nbrdf compare --json > compare.json"


@dataclass(frozen=True)
class Material:
    """One held-out material of a row: its code and the figures the report claims."""

    name: str
    code: tuple[float, ...]
    figures: dict[str, float]


@dataclass(frozen=True)
class Row:
    """One representation on one database: the claimed means and the materials behind them."""

    name: str
    variant: str
    database: str
    means: dict[str, float]
    materials: tuple[Material, ...]

    @property
    def label(self) -> str:
        """For tables of text."""
        return f"{self.database} {self.name} {self.variant}"


@dataclass(frozen=True)
class Report:
    """The rows that can be recomputed here, and the names of those that cannot."""

    reference: str
    rows: tuple[Row, ...]
    others: tuple[str, ...]


@dataclass(frozen=True)
class Method:
    """One interpolation: spreads over pairs by key, counts by key, errors of families by (lobe, family)."""

    name: str
    spreads: dict[str, dict[str, Any]]
    counts: dict[str, int]
    families: dict[tuple[str, str], tuple[float, float]]


@dataclass(frozen=True)
class Comparison:
    """A report of interpolations over the first `pairs` standard pairs."""

    reference: str
    pairs: int
    methods: tuple[Method, ...]


def read(path: Path | str) -> Report:
    """An evaluation report with at least one row of a representation in `VARIANTS`."""
    path = Path(path)
    content = _content(path, "a report of `nbrdf evaluate`", REMEDY)
    if content.get("split", "held_out") != "held_out":
        raise InvalidFile(path, '"split": "held_out"', repr(content["split"]), REMEDY)
    rows = _get(content, "rows", list, f"{path}")
    names = [_get(row, "name", str, f"{path}") for row in rows]
    mine = [_row(row, f"{path}: rows[{i}]") for i, row in enumerate(rows) if names[i] in VARIANTS]
    if not mine:
        raise InvalidFile(path, f"a row named {' or '.join(VARIANTS)}", "none", REMEDY)
    others = sorted({name for name in names if name not in VARIANTS})
    return Report(_get(content, "reference", str, f"{path}"), tuple(mine), tuple(others))


def read_comparison(path: Path | str) -> Comparison:
    """A report of `nbrdf compare`."""
    path = Path(path)
    content = _content(path, "a report of `nbrdf compare`", COMPARE_REMEDY)
    methods = [_method(row, f"{path}: methods[{i}]") for i, row in enumerate(_get(content, "methods", list, f"{path}", COMPARE_REMEDY))]
    return Comparison(_get(content, "reference", str, f"{path}"), _get(content, "pairs", int, f"{path}"), tuple(methods))


def _content(path: Path, expected: str, remedy: str) -> dict[str, Any]:
    if not path.is_file():
        raise InvalidFile(path, expected, "no such file", remedy)
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise InvalidFile(path, "JSON", str(error), remedy) from error
    if _get(content, "schema", int, f"{path}", remedy) != 1:
        raise InvalidFile(path, '"schema": 1', str(content["schema"]))
    return content


def _row(row: dict[str, Any], where: str) -> Row:
    name, variant = row["name"], _get(row, "variant", str, where)
    if variant not in VARIANTS[name]:
        raise InvalidFile(where, f"a variant of {VARIANTS[name]}", repr(variant))
    keys = [key for key in judge.KEYS if key in row or key in REQUIRED]
    means = {key: _number(_get(row, key, dict, where), "mean", f"{where}.{key}") for key in keys}
    materials = _get(row, "materials", list, where)
    if not materials:
        raise InvalidFile(where, "at least one material", "none", REMEDY)
    parsed = tuple(_material(item, keys, f"{where}.materials[{i}]") for i, item in enumerate(materials))
    return Row(name, variant, row.get("database", "merl"), means, parsed)


def _material(item: Any, keys: list[str], where: str) -> Material:
    code = tuple(_get(item, "code", list, where))
    if not all(isinstance(number, int | float) for number in code):
        raise InvalidFile(where, "a code of numbers", str(code))
    return Material(_get(item, "name", str, where), code, {key: _number(item, key, where) for key in keys})


def _method(row: Any, where: str) -> Method:
    spreads = {key: _get(row, key, dict, where, COMPARE_REMEDY) for key in walk_quality.KEYS}
    for key, spread in spreads.items():
        for part in ("mean", "median", "p90", "max"):
            _number(spread, part, f"{where}.{key}")
    counts = {key: _get(row, key, int, where, COMPARE_REMEDY) for key in ("energy_violations", "energy_violations_beyond")}
    families = {
        (_get(item, "lobe", str, where), _get(item, "family", str, where)): (_number(item, "middle", where), _number(item, "best", where))
        for item in row.get("families") or []
    }
    return Method(_get(row, "name", str, where), spreads, counts, families)


def _number(item: Any, key: str, where: str) -> float:
    return float(_get(item, key, int | float, where))


def _get(item: Any, key: str, kind: Any, where: str, remedy: str = REMEDY) -> Any:
    if not isinstance(item, dict) or key not in item:
        found = f"only {', '.join(item)}" if isinstance(item, dict) and item else "nothing of that name"
        raise InvalidFile(where, f'"{key}"', found, remedy)
    if not isinstance(item[key], kind) or isinstance(item[key], bool):
        raise InvalidFile(where, f'"{key}" of type {getattr(kind, "__name__", "number")}', repr(item[key])[:60], remedy)
    return item[key]
