"""Reports of `nbrdf evaluate --json` in, a small record for docs/ out. No JAX: any Python 3.11 runs it."""

import json
import re
import sys
from collections.abc import Callable
from pathlib import Path

from results_table import EVALUATE

KEYS = [key for key, _, _ in EVALUATE]


class Invalid(Exception):
    """A report that cannot be used: which, and why."""


def numbered(folder: Path, stem: str) -> list[tuple[int, Path]]:
    """The reports STEM-N.json of a folder by rising N."""
    return sorted((int(match[1]), file) for file in folder.glob(f"{stem}-*.json") if (match := re.fullmatch(rf"{stem}-(\d+)", file.stem)))


def read(file: Path, split: str) -> dict[tuple, dict]:
    """Rows of one report on that split by name, variant and database."""
    try:
        report = json.loads(file.read_text())
        if (found := (report["split"], report["reference"])) != (split, "published"):
            raise Invalid(f"{file}: expected {split} materials and the published networks as reference, found {found[0]}, {found[1]}")
        rows = report["rows"]
        return {(row["name"], row["variant"], row["database"]): {"count": row["count"], **{key: float(row[key]["mean"]) for key in KEYS}} for row in rows}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise Invalid(f"{file}: expected a report of `nbrdf evaluate --json`: {type(error).__name__} {error}") from error


def command(arguments: list[str], about: str | None, record: Callable[[Path, int], dict], out: Path) -> int:
    """A command of a folder and the steps that were trained for; the exit code: 2 where it is called otherwise."""
    if len(arguments) != 2 or not arguments[1].isdecimal():
        print(about, file=sys.stderr)
        return 2
    return write(lambda: record(Path(arguments[0]), int(arguments[1])), out)


def of_folder(arguments: list[str], about: str | None, record: Callable[[Path], dict], out: Path) -> int:
    """A command of a folder alone; the exit code: 2 where it is called otherwise."""
    if len(arguments) != 1:
        print(about, file=sys.stderr)
        return 2
    return write(lambda: record(Path(arguments[0])), out)


def write(make: Callable[[], dict], out: Path) -> int:
    """Writes what `make` gives; the exit code: 0, or 3 where it is given no usable report."""
    try:
        recorded = make()
    except Invalid as error:
        print(error, file=sys.stderr)
        return 3
    out.write_text(json.dumps(recorded, indent=1) + "\n")
    return 0
