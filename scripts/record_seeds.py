"""Mean and standard deviation of every figure over seeds: reports `seed-N.json` of a folder in, docs/seeds.json out.

    python3 scripts/record_seeds.py target/seeds
"""

import json
import statistics
import sys
from pathlib import Path

from make_results import EVALUATE, ROOT

KEYS = [key for key, _, _ in EVALUATE]


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    files = sorted(Path(sys.argv[1]).glob("seed-*.json"))
    reports = [json.loads(file.read_text()) for file in files]
    if len(reports) < 2:
        print(f"{sys.argv[1]}: expected two reports seed-N.json or more, found {len(reports)}", file=sys.stderr)
        return 3
    rows = []
    for index, first in enumerate(reports[0]["rows"]):
        row = {key: first[key] for key in ("name", "variant", "database", "count")}
        for key in KEYS:
            means = [report["rows"][index][key]["mean"] for report in reports]
            row[key] = {"mean": statistics.mean(means), "sd": statistics.stdev(means)}
        rows.append(row)
    recorded = {"schema": 1, "command": "scripts/seeds.sh", "seeds": [int(file.stem.split("-")[1]) for file in files], "rows": rows}
    (ROOT / "docs/seeds.json").write_text(json.dumps(recorded, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
