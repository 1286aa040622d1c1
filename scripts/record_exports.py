"""How far exports are from their sources: reports of `nbrdf export --measure --json` of a folder in, docs/exports.json out.

    python3 scripts/record_exports.py target/exports
"""

import json
import statistics
import sys
from pathlib import Path

from records import Invalid, of_folder
from results_table import ROOT

# Whether more is better.
KEYS = {"log_error": False, "studio_psnr": True, "image_mean_error": False, "image_pixel_error": False}
WORST = 5


def record(folder: Path) -> dict:
    """What docs/exports.json holds: for every form means, medians, the 90th percentile, the five worst, and bytes."""
    files = [file for file in sorted(folder.glob("*.json")) if file.stem != "forms"]
    if not files:
        raise Invalid(f"{folder}: expected reports of `nbrdf export --measure --json`, found none")
    about = "forms, read again, against the published networks of MERL; image_mean_error: of the mean of linear pictures, image_pixel_error: share of their light in another place, worst of channels and lights"
    return {"schema": 1, "command": "scripts/export_errors.sh", "about": about, "rows": [row(file) for file in files]}


def row(file: Path) -> dict:
    """The figures of one form."""
    try:
        report = json.loads(file.read_text())
        exports = report["exports"]
        sizes = [sum(part["bytes"] for part in export["files"]) for export in exports]
        figures = {key: spread([(float(export["error"][key]), export["material"]) for export in exports], more) for key, more in KEYS.items()}
        return {"form": report["form"], "materials": len(exports), "mean_bytes": round(statistics.mean(sizes)), "largest_bytes": max(sizes), **figures}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise Invalid(f"{file}: expected a report of `nbrdf export --measure --json`: {type(error).__name__} {error}") from error


def spread(values: list[tuple[float, str]], more_is_better: bool) -> dict:
    """Mean, median, 90th percentile towards the worst, and the five worst by name."""
    ordered = sorted(values, reverse=more_is_better)
    at = lambda share: ordered[min(int(share * len(ordered)), len(ordered) - 1)][0]  # noqa: E731
    rounded = lambda value: float(f"{value:.4g}")  # noqa: E731
    mean = statistics.mean(value for value, _ in values)
    worst = [f"{name} {rounded(value)}" for value, name in ordered[::-1][:WORST]]
    return {"mean": rounded(mean), "median": rounded(statistics.median(value for value, _ in values)), "p90": rounded(at(0.9)), "max": rounded(ordered[-1][0]), "worst": worst}


def main(arguments: list[str], out: Path = ROOT / "docs/exports.json") -> int:
    return of_folder(arguments, __doc__, record, out)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
