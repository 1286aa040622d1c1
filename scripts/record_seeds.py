"""Mean and standard deviation of every figure over seeds: reports `seed-N.json` of a folder in, docs/seeds.json out.

    python3 scripts/record_seeds.py target/seeds STEPS      (steps that every checkpoint was trained for)
"""

import json
import re
import statistics
import sys
from pathlib import Path

from make_results import EVALUATE, ROOT

KEYS = [key for key, _, _ in EVALUATE]


class Invalid(Exception):
    """A report that cannot be used: which, and why."""


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


def record(folder: Path, steps: int) -> dict:
    """What docs/seeds.json holds."""
    files = sorted((int(match[1]), file) for file in folder.glob("seed-*.json") if (match := re.fullmatch(r"seed-(\d+)", file.stem)))
    if len(files) < 2:
        raise Invalid(f"{folder}: expected two reports seed-N.json or more, found {len(files)}")
    reports = [read(file, "held_out") for _, file in files]
    for (_, file), report in zip(files, reports):
        if report.keys() != reports[0].keys():
            raise Invalid(f"{file}: expected the rows of {files[0][1].name}, found {sorted(report)}")
    rows = []
    for place, first in reports[0].items():
        row = dict(zip(("name", "variant", "database"), place), count=first["count"])
        for key in KEYS:
            means = [report[place][key] for report in reports]
            row[key] = {"mean": statistics.mean(means), "sd": statistics.stdev(means)}
        rows.append(row)
    return {"schema": 1, "command": f"scripts/seeds.sh {steps}", "steps": steps, "seeds": [seed for seed, _ in files], "rows": rows}


def main(arguments: list[str], out: Path = ROOT / "docs/seeds.json") -> int:
    if len(arguments) != 2 or not arguments[1].isdecimal():
        print(__doc__, file=sys.stderr)
        return 2
    try:
        recorded = record(Path(arguments[0]), int(arguments[1]))
    except Invalid as error:
        print(error, file=sys.stderr)
        return 3
    out.write_text(json.dumps(recorded, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
