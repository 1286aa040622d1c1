"""Mean and standard deviation of every figure over seeds: reports `seed-N.json` of a folder in, docs/seeds.json out.

    python3 scripts/record_seeds.py target/seeds STEPS      (steps that every checkpoint was trained for)
"""

import statistics
import sys
from pathlib import Path

from records import KEYS, Invalid, command, numbered, read
from results_table import ROOT


def record(folder: Path, steps: int) -> dict:
    """What docs/seeds.json holds."""
    files = numbered(folder, "seed")
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
    return command(arguments, __doc__, record, out)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
