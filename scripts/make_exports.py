"""Writes docs/exports.md of docs/exports.json, docs/mitsuba.json and docs/browser.json: how far exports are from their sources.

    python3 scripts/make_exports.py

The records are made by scripts/export_errors.sh, scripts/mitsuba_check.py and scripts/browser_check.py.
"""

import json
import sys
from collections import defaultdict
from pathlib import Path

from results_table import ROOT, number, table, wrapped

DOCS = ROOT / "docs"
LIGHTS = {
    "point": "one lamp",
    "studio": "eleven lamps",
    "drawn_by_material": "a map, directions drawn by the material",
    "drawn_by_map": "a map, directions drawn by the map",
}
MODELS = {"bsdf": "`.bsdf` in `measured`", "scene": "the exported scene", "plugin": "networks, `mitsuba_nbrdf.py`"}


def read(name: str) -> dict:
    return json.loads((DOCS / f"{name}.json").read_text())


def size(count: float) -> str:
    """Bytes for people."""
    return f"{count / 1e6:.1f} MB" if count >= 1e6 else f"{count / 1e3:.1f} kB"


def percent(share: float) -> str:
    return f"{100 * share:.2f} %"


def forms(record: dict) -> str:
    """The table of forms that are read back."""
    rows = []
    for row in record["rows"]:
        error, psnr, mean = row["log_error"], row["studio_psnr"], row["image_mean_error"]
        worst = mean["worst"][0].rsplit(" ", 1)[0] if mean["max"] else "–"
        rows.append([
            f"`{row['form']}`", size(row["mean_bytes"]), size(row["largest_bytes"]), number(error["mean"], 5), number(error["max"], 4),
            number(psnr["mean"], 1), number(psnr["max"], 1), percent(mean["mean"]), percent(mean["max"]), worst,
        ])  # fmt: skip
    head = ["form", "bytes, mean", "largest", "log_error, mean", "worst", "studio PSNR, mean", "worst", "image mean, mean", "worst", "of"]
    return table(head, rows)


def renderers(record: dict) -> str:
    """The largest relative difference of picture means for every model and light."""
    found = defaultdict(list)
    for row in record["rows"]:
        found[row["model"], row["light"]].append(row)
    rows = []
    for (model, light), group in sorted(found.items(), key=lambda item: (list(MODELS).index(item[0][0]), list(LIGHTS).index(item[0][1]))):
        worst = max(group, key=lambda row: row["relative_difference"])
        noise = max(part / max(mean, 1e-9) for row in group for part, mean in zip(row["noise"], row["mean"]))
        agree = sum(row["verdict"] == "agrees" for row in group)
        rows.append([MODELS[model], LIGHTS[light], f"{agree} of {len(group)}", percent(worst["relative_difference"]), worst["material"], percent(noise)])
    return table(["in Mitsuba", "light", "agree", "largest difference of means", "of", "largest noise"], rows)


def page() -> str:
    exports, mitsuba, browser = read("exports"), read("mitsuba"), read("browser")
    drawn = browser["rows"]
    exact = sum(row["largest_step"] == 0 for row in drawn)
    least = min(drawn, key=lambda row: row["psnr"])
    materials = len({row["material"] for row in drawn})
    return wrapped(f"""# Exports: how far each is from its source

`nbrdf export --list` names all forms; every export has a manifest with its own error. Below are all materials at once.

## Read back: weights come back to the bit, tables within a percent but for MERL's sharpest

{exports["rows"][0]["materials"]} published networks of MERL, written and read again (`{exports["command"]}`; [exports.json](exports.json)). *Image mean*: relative
difference of the mean of linear sphere pictures, the worst of channels and lights. The resolution of `.bsdf` is chosen by that; the cells of
a MERL `.binary` are fixed, and too wide for mirrors.

{forms(exports)}

## In Mitsuba {mitsuba["mitsuba"]}: {sum(row["verdict"] == "agrees" for row in mitsuba["rows"])} of {len(mitsuba["rows"])} pictures agree

Spheres of {len(mitsuba["materials"])} materials ({", ".join(mitsuba["materials"])}) in {" and ".join(f"`{name}`" for name in mitsuba["variants"])} against `nbrdf render`
(`{mitsuba["command"]}`; [mitsuba.json](mitsuba.json)). A picture agrees where the difference of means is within {percent(mitsuba["tolerance"]["bsdf"])} for
tables and {percent(mitsuba["tolerance"]["plugin"])} for networks, plus {mitsuba["sigmas"]:.0f} standard errors: where noise is large, that says little.

{renderers(mitsuba)}

## In a browser: at least {least["psnr"]:.1f} dB

Pages of {materials} materials under both lights, drawn by {browser["browser"].split(" built")[0]} by software, against `nbrdf render`, {browser["size"]} × {browser["size"]} pixels
(`{browser["command"]}`; [browser.json](browser.json)). {exact} of {len(drawn)} pictures are the same to the bit; the furthest is `{least["material"]}` under
light `{least["light"]}`, {least["psnr"]:.1f} dB. Required are {browser["least_psnr"]:.0f} dB.
""")


if __name__ == "__main__":
    (DOCS / "exports.md").write_text(page())
    sys.exit(0)
