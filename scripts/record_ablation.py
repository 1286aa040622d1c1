"""What longer training brings: reports `steps-N.json` of a folder in, docs/ablation.json out.

    python3 scripts/record_ablation.py target/ablation
"""

import sys
from pathlib import Path

from records import Invalid, numbered, of_folder, read
from results_table import ROOT

KEYS = ("log_error", "relative_log", "studio_psnr", "studio_flip", "studio_delta_e_itp")


def record(folder: Path) -> dict:
    """What docs/ablation.json holds: PCA's rows once, ZNBRDF's for every length of training."""
    files = numbered(folder, "steps")
    if not files:
        raise Invalid(f"{folder}: expected reports steps-N.json, found none")
    rows = []
    for steps, file in files:
        for (name, variant, database), figures in read(file, "validation").items():
            learned = name == "znbrdf"
            if database == "merl" and (learned or file == files[0][1]):
                row = {"name": name, "variant": variant, "count": figures["count"], **{key: figures[key] for key in KEYS}}
                rows.append({**row, "steps": steps} if learned else row)
    return {"schema": 1, "command": "scripts/ablation.sh", "rows": rows}


def main(arguments: list[str], out: Path = ROOT / "docs/ablation.json") -> int:
    return of_folder(arguments, __doc__, record, out)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
