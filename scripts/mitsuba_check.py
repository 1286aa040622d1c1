"""Whether Mitsuba 3 shows what `nbrdf render` shows: the exported `.bsdf` in its stock plugin `measured`, the Python plugin
`mitsuba_nbrdf.py` on networks and codes, and the scene that comes with an export.

    python scripts/mitsuba_check.py [--quick] [--all] [--nbrdf PROGRAM] [-o docs/mitsuba.json] [--strip docs/images/mitsuba.png]

Spheres under the lights of measurement (`point`, `studio`), without noise (see `mitsuba_render.py`), and under an environment map,
where lights are drawn by the material, or by material and map together: if a plugin's density were not that of what it draws,
they would differ. Some scenes are rendered just as they come, too, with the noise of their own sampler. Networks are the published
ones of MERL where they are found (`NBRDF_DATA`), the built-in refits elsewhere. Tables are compared with the network that they
were made of, where as much may differ as an export allows, and with the same table as nbrdf reads it, where next to nothing may:
so a difference of the first kind is the table's own, the resolution that it was stored in. Verdicts are those of
`mitsuba_judge.py`.
Renders with `scalar_rgb`, and with `llvm_ad_rgb` where a working LLVM is found; each library is tried in a process of its own,
since some versions abort.
Exits with 1 where pictures are apart, with 2 where Mitsuba or `nbrdf` is not there, with 4 where more than a twentieth is too noisy
to tell.
"""

import argparse
import json
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import mitsuba_judge as judge
from nbrdf_jax import program
from nbrdf_jax.fitted_library import whole

MOST_NOISY = 0.05


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help="three materials and fewer samples: about a minute on two cores")
    parser.add_argument("--all", action="store_true", help="also the tables of all materials of MERL, under lamps")
    parser.add_argument("--nbrdf", type=Path, default=program.BUILT, help="the program (default: %(default)s)")
    parser.add_argument("-o", "--output", type=Path, help="the figures as JSON")
    parser.add_argument("--strip", type=Path, help="a picture: nbrdf, its table and its network in Mitsuba, and how far they differ")
    options = parser.parse_args()
    if not options.nbrdf.is_file():
        print(f"{options.nbrdf}: no such program: build it, or name it with --nbrdf", file=sys.stderr)
        return 2
    try:
        import mitsuba as mi
    except ImportError:
        print("Mitsuba 3 is not installed: pip install -e 'scripts[mitsuba]'", file=sys.stderr)
        return 2
    mi.set_variant("scalar_rgb")
    from mitsuba_comparison import Comparison
    from mitsuba_strip import draw

    began = time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        comparison = Comparison(options.nbrdf, Path(scratch), options.quick)
        rows = comparison.rows()
        report = {
            "schema": 3, "about": "spheres by Mitsuba against `nbrdf render`",
            "command": " ".join(["python scripts/mitsuba_check.py", *(["--quick"] * options.quick), *(["--all"] * options.all)]),
            "mitsuba": mi.__version__, "networks": comparison.networks, "llvm": Path(comparison.library).name if comparison.library else None,
            "variants": comparison.variants, "materials": comparison.names, "tolerance": comparison.TOLERANCE,
            "sigmas": judge.SIGMAS, "most_noise": judge.MOST_NOISE, "rows": rows,
        }  # fmt: skip
        if options.all:
            every = comparison.of_all_tables()
            report["all"] = summary(every)
            rows = rows + every
        report["seconds"] = round(time.monotonic() - began)
        # What was found is kept, whether or not it can be drawn.
        if options.output:
            whole(options.output, (json.dumps(report, indent=1, allow_nan=False) + "\n").encode())
        if options.strip:
            draw(options.strip, comparison)
    return told(rows, report["seconds"])


def summary(rows: list[dict]) -> dict:
    """Of the tables of all materials, in one variant: the worst, and what is apart."""
    worst = {against: max((row for row in rows if row["against"] == against), key=lambda row: row["elsewhere"]) for against in ("network", "table")}
    return {
        "materials": len({row["material"] for row in rows}), "variant": rows[0]["variant"],
        "worst": worst, "apart": [row for row in rows if row["verdict"] == judge.APART], "comparisons": len(rows),
    }  # fmt: skip


def told(rows: list[dict], seconds: int) -> int:
    """Says what is not alike, and returns the exit code."""
    for row in rows:
        if row["verdict"] != judge.AGREES:
            print(f"{row['variant']} {row['material']} {row['model']} {row['light']} against the {row['against']}: {row['verdict']}: {row}")
    count = Counter(row["verdict"] for row in rows)
    noise = max(row["noise"] for row in rows)
    print(f"{count[judge.AGREES]} of {len(rows)} comparisons agree, {count[judge.APART]} are apart, {count[judge.NOISY]} too noisy to tell")
    print(f"noise is {noise:.2%} of a mean at most; {seconds} s")
    if count[judge.APART]:
        return 1
    return 4 if count[judge.NOISY] > MOST_NOISY * len(rows) else 0


if __name__ == "__main__":
    sys.exit(main())
