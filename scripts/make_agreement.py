"""Writes docs/agreement.md of docs/agreement.json, docs/mitsuba.json and docs/browser.json: what other programs find.

    python scripts/make_agreement.py

The records are made by `scripts/evaluate.py --record docs/agreement.json`, scripts/mitsuba_check.py and scripts/browser_check.py;
which programs made golden numbers stands in scripts/make_golden.py and in the files.
"""

import json
import sys
from pathlib import Path

import exports_mitsuba
import make_golden
from nbrdf_jax import side_by_side
from nbrdf_jax.side_by_side import agreed, share, told
from nbrdf_jax.tally import Reason, Tally
from results_table import ROOT, table, wrapped

DOCS = ROOT / "docs"
# Programs that golden files name, and the packages that are asked for their versions.
OURS = ("numpy", "jax", "lapack")


def read(name: str) -> dict:
    return json.loads((DOCS / f"{name}.json").read_text(encoding="utf-8"))


def counted(rows: list[dict], heading: str, tolerance: float) -> str:
    """Counts of figures by kind or by row."""
    return markdown(side_by_side.counts([Tally(**row) for row in rows], heading, tolerance))


def reasons(rows: list[dict]) -> str:
    """Why figures are further apart."""
    return markdown(side_by_side.reasons([Reason(**row) for row in rows], "reason"))


def markdown(rows: side_by_side.Rows) -> str:
    """Rows, the heading first."""
    return table(list(rows[0]), [list(row) for row in rows[1:]])


def by_row(record: dict) -> str:
    """The row that is furthest without a reason, as a heading."""
    worst = record["without_reason"]
    codes = max(record["codes"], key=lambda row: row["difference"])
    return f"where no wider tolerance is stated, at most {share(worst['largest'])} ({worst['where']}); codes differ by {share(codes['difference'])} of their largest number at most"


def numbers(content: object) -> int:
    """How many numbers a golden file holds."""
    if isinstance(content, dict):
        return sum(map(numbers, content.values()))
    return sum(map(numbers, content)) if isinstance(content, list) else int(isinstance(content, int | float) and not isinstance(content, bool))


def by_others() -> list[list[str]]:
    """Golden files that programs of others made: file, programs and versions, what, how many numbers."""
    rows = []
    for which, file in make_golden.FILES.items():
        if file.by.lower().startswith(OURS):
            continue
        content = json.loads((make_golden.FOLDER / file.name).read_text(encoding="utf-8"))
        versions = ", ".join(f"{name} {version}" for name, version in content.get("with", {}).items() if name not in OURS)
        rows.append([f"[{file.name}](../tests/golden/{file.name})", versions or content["about"].partition(" by ")[2], file.about.partition(";")[0], str(numbers(content)), f"`make_golden.py {which}`"])
    return rows


def page() -> str:
    record, mitsuba, browser = read("agreement"), read("mitsuba"), read("browser")
    drawn, golden = browser["rows"], by_others()
    exact = sum(row["largest_step"] == 0 for row in drawn)
    tolerance = record["tolerance"]
    commands = [record["command"], mitsuba["command"], browser["command"], "python scripts/make_golden.py", "python scripts/make_agreement.py"]
    return wrapped(f"""# Agreement: what other programs find

A second implementation in JAX and NumPy (`scripts/nbrdf_jax`, written from the papers and the protocol, not from the Rust) is asked for the same
figures; Mitsuba 3 and a browser draw what `nbrdf` exports; and programs of others made golden numbers that the tests compare with.

## JAX: {agreed(Tally(**record["all"]), tolerance)}

Of the reports of `nbrdf evaluate` (all held-out materials of MERL and RGL) and `nbrdf compare` ({record["pairs"]} pairs of MERL materials, 16 families),
recomputed from networks, checkpoint and codes. *Within*: relative difference, of what the program says. A figure that is further apart agrees
only where a reason is stated, and only as far as that goes. The allowances of quadratures and rounding are bounds; those of fits and optimizers of
their own are what a first run found, rounded up: they notice a change, and prove nothing more. Means that a report takes over its own
figures are a row of the table, and not in the count above.

{counted(record["kinds"], "kind of figure", tolerance)}

The reasons, and the furthest apart that each admits:

{reasons(record["reasons"])}

## JAX, row by row: {by_row(record)}

Held-out materials by representation, walks and families by interpolation.

{counted(record["rows"], "row", tolerance)}

## {told(record["claims"])}

A printed figure holds where what was found rounds to it. What holds only within an allowance:

{reasons(record["claims_allowed"])}

What was not recomputed:

{table(["why", "figures"], [[row["reason"], str(row["figures"])] for row in record["claims_not_recomputed"]])}

## Mitsuba {mitsuba["mitsuba"]}: {exports_mitsuba.heading(mitsuba)}

Spheres of {len(mitsuba["materials"])} materials in {" and ".join(f"`{name}`" for name in mitsuba["variants"])}; [exports.md](exports.md) says what is compared with what, and when a picture agrees.

{exports_mitsuba.renderers(mitsuba)}

## In a browser: {exact} of {len(drawn)} pictures are the same to the bit, all at least {min(row["psnr"] for row in drawn):.1f} dB

{browser["browser"].split(" built")[0]} draws the exported pages of {len({row["material"] for row in drawn})} materials under both lights; required are {browser["least_psnr"]:.0f} dB.

## Golden numbers: {len(golden)} of {len(make_golden.FILES)} files are by programs of others

{table(["file", "by", "what", "numbers", "command"], golden)}

All other files are by NumPy, LAPACK or JAX, from the papers; [tests/golden/README.md](../tests/golden/README.md) lists them. The tests of Rust compare with those above.

## Commands

{chr(10).join(f"    {command}" for command in dict.fromkeys(commands))}
""")


def main(out: Path = DOCS / "agreement.md") -> int:
    out.write_text(page(), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
