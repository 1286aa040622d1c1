"""Writes the figures of docs/scenes.md from the reports of scripts/make_scenes.sh, so that none is typed by hand."""

import json
import sys
from pathlib import Path

from results_table import ROOT, number, table, thousands, wrapped

SCENES = {"shelf": "twelve materials at mixed distances", "interior": "a matte room", "metal": "a metal close-up"}
MARK = "<!-- Below this line: scripts/make_scenes.sh -->\n"


def plans(reports: dict) -> str:
    """One line for every scene and aim."""
    rows = []
    for (scene, by), report in reports.items():
        check, errors = report["check"], [own["error"] for own in report["objects"]]
        rows.append([
            f"{scene} ({SCENES[scene]}), by {by}", str(len(errors)), f"{1e-6 * report['planned']['ns']:.1f}", f"{report['times_faster']:.2f} ×",
            thousands(report["planned"]["bytes"]), f"{report['times_smaller']:.2f} ×", number(max(errors), 4), f"{report['seconds']:.1f}",
            f"{100 * check['share_of_time']:.0f} %", f"{100 * check['agreement']:.0f} %",
        ])
    head = ["scene", "objects", "ms", "less time", "bytes", "fewer bytes", "worst FLIP", "seconds to plan", "of trying all", "same choice"]
    return table(head, rows)


def objects(time: dict, least: dict) -> str:
    """The shelf, object by object, by time and by bytes."""
    rows = []
    for own, small in zip(time["objects"], least["objects"], strict=True):
        cells = [[f"`{o['model']}`", number(o["error"], 4), number(o["ns"], 1), thousands(o["bytes"])] for o in (own, small)]
        rows.append([f"{own['name']}: {own['material']}", str(own["pixels"]), *cells[0], *cells[1]])
    head = ["object", "pixels", "by time", "FLIP", "ns", "bytes", "by bytes", "FLIP", "ns", "bytes"]
    return table(head, rows)


def curves(reports: dict) -> str:
    """Less time and fewer bytes over the tolerance, scene by scene."""
    first = next(iter(reports.values()))
    rows = []
    for place, row in enumerate(first["rows"]):
        cells = []
        for report in reports.values():
            own = report["rows"][place]
            full = own["nbrdf_everywhere"]
            cells += [f"{full['ns'] / own['ns']:.2f}", f"{full['bytes'] / own['bytes']:.2f}", number(own["worst_error"], 4)]
        rows.append([str(row["tolerance"]), *cells])
    head = ["tolerance", *(f"{scene}: {what}" for scene in reports for what in ("× less time", "× fewer bytes", "worst FLIP"))]
    return table(head, rows)


def main() -> None:
    """Replaces what is below the mark."""
    folder = Path(sys.argv[1])
    read = lambda stem: json.loads((folder / f"{stem}.json").read_text())
    reports = {(scene, by): read(f"{scene}-{by}") for scene in SCENES for by in ("time", "bytes")}
    far = read("distance")
    models = [row["model"] for row in far["rows"] if row["way"] == "out"]
    order = list(dict.fromkeys(models))
    differing = [f"{scene}, by {by}, {own['object']}: `{own['plan']}` instead of `{own['exhaustive']}`" for (scene, by), report in reports.items() for own in report["check"]["differences"]]
    differing = "The plan and trying everything differ nowhere." if not differing else "They differ in: " + "; ".join(differing) + "."
    figures = f"""
## Figures

The published networks are the reference (`scripts/make_scenes.sh`, seed 0). "Less" and "fewer" are against a pruned NBRDF
for every material; all models are vectorized alike. FLIP is the mean over an object's pixels, of the objects the worst;
0.04 is allowed. "Trying all" makes every model of every material and renders every object with each (`--check`).

{plans(reports)}

{differing}

![The shelf with full and with planned models, and the difference](images/shelf.png)

The shelf, object by object:

{objects(reports["shelf", "time"], reports["shelf", "bytes"])}

Over the tolerance, tables left out (`nbrdf plan SCENE.toml --sweep tolerance --most-bytes 1000000`): a table of 17 MB is a little faster
than a network in some runs, and not in others.

{curves({scene: read(f"{scene}-tolerance") for scene in SCENES})}

![Time and bytes of the shelf over the tolerance](images/tolerance.svg)

Over the distance (`nbrdf plan scenes/shelf.toml --sweep distance --object "near middle" --most-bytes 1000000`): as the camera moves to
{far["rows"][len(models) - 1]["distance"]:.0f} times as far, the material takes {", ".join(f"`{name}`" for name in order)}; out and back
there are {far["switches"]} switches, none of which changes the object's pixels by more than FLIP {far["largest_change"]:.3f}
({far["tolerance"]} is allowed).

![Where the nearest sphere of the shelf switches its model](images/distance.svg)
"""
    page = ROOT / "docs" / "scenes.md"
    kept = page.read_text().split(MARK)[0]
    page.write_text(wrapped(kept) + MARK + wrapped(figures))


if __name__ == "__main__":
    main()
