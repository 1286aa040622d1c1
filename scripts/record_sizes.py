"""How close codes of several lengths come: reports `size-DIM.json` of a folder in, docs/sizes.json out.

    python3 scripts/record_sizes.py target/sizes-STEPS STEPS      (steps that every checkpoint was trained for)
"""

import sys
from pathlib import Path

from records import KEYS, Invalid, command, numbered, read
from results_table import ROOT


def record(folder: Path, steps: int) -> dict:
    """What docs/sizes.json holds: for every length the means of every variant over the held-out MERL materials,
    and those of plain and ordered codes over the validation materials."""
    files = numbered(folder, "size")
    if not files:
        raise Invalid(f"{folder}: expected reports size-DIM.json, found none")
    rows = []
    order = {}
    for name in ("plain", "ordered"):
        order[name] = of_merl(folder / f"{name}.json", "validation")
    for dim, file in files:
        rows.append({"dim": dim} | of_merl(file, "held_out"))
    return {"schema": 1, "command": f"scripts/sizes.sh {steps}", "steps": steps, "rows": rows, "order": order}


def of_merl(file: Path, split: str) -> dict:
    """The means of every variant over the MERL materials of a report."""
    variants = {variant: figures for (_, variant, database), figures in read(file, split).items() if database == "merl"}
    if not variants:
        raise Invalid(f"{file}: expected rows of MERL materials, found none")
    return {variant: {key: figures[key] for key in KEYS} for variant, figures in variants.items()}


def main(arguments: list[str], out: Path = ROOT / "docs/sizes.json") -> int:
    return command(arguments, __doc__, record, out)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
