"""Writes docs/exports.md of four records in docs: exports, parametric, mitsuba and browser (.json).

    python3 scripts/make_exports.py

scripts/make_exports.sh makes all of them anew.
"""

import json
import sys
from collections import Counter, defaultdict
from pathlib import Path

from exports_fits import section as fits
from results_table import ROOT, fine_percent, number, table, wrapped

DOCS = ROOT / "docs"
LIGHTS = {
    "point": "one lamp",
    "studio": "eleven lamps",
    "drawn_by_material": "a map, directions drawn by the material",
    "drawn_by_both": "a map, directions drawn by both",
}
MODELS = {"bsdf": "`.bsdf` in `measured`", "scene": "the exported scene", "plugin": "networks, `mitsuba_nbrdf.py`"}
AGAINST = {"network": "the network", "table": "the same table"}


def read(name: str) -> dict:
    return json.loads((DOCS / f"{name}.json").read_text())


def size(count: float) -> str:
    """Bytes for people."""
    return f"{count / 1e6:.1f} MB" if count >= 1e6 else f"{count / 1e3:.1f} kB"


def percent(share: float) -> str:
    return f"{100 * share:.2f} %"


def forms(record: dict) -> str:
    """The table of forms, as their files are read again."""
    rows = []
    for row in record["rows"]:
        error, psnr, mean, moved = row["log_error"], row["studio_psnr"], row["image_mean_error"], row["image_pixel_error"]
        worst = moved["worst"][0].rsplit(" ", 1)[0] if moved["max"] else "–"
        rows.append([
            f"`{row['form']}`", size(row["mean_bytes"]), size(row["largest_bytes"]), number(error["mean"], 5), number(error["max"], 4),
            number(psnr["mean"], 1), number(psnr["max"], 1), percent(mean["mean"]), percent(mean["max"]), percent(moved["mean"]), percent(moved["max"]), worst,
        ])  # fmt: skip
    head = ["form", "bytes, mean", "largest", "log_error, mean", "worst", "studio PSNR, mean", "worst", "image mean, mean", "worst", "light elsewhere, mean", "worst", "of"]
    return table(head, rows)


def distance(row: dict) -> float:
    """Of the light that is elsewhere where there is no noise, of the means where there is."""
    return row.get("elsewhere", row["difference"])


def renderers(record: dict) -> str:
    """Verdicts and largest differences of every model under every light."""
    kinds = defaultdict(list)
    for row in record["rows"]:
        kinds[row["model"], row["against"], row["light"]].append(row)
    order = lambda kind: [list(names).index(name) for names, name in zip((MODELS, AGAINST, LIGHTS), kind)]  # noqa: E731
    rows = []
    for model, against, light in sorted(kinds, key=order):
        group = kinds[model, against, light]
        worst = max(group, key=distance)
        counts = [str(sum(row["verdict"] == verdict for row in group)) for verdict in ("agrees", "too noisy to tell", "apart")]
        noise = max(row["noise"] for row in group)
        rows.append([
            MODELS[model], AGAINST[against], LIGHTS[light], *counts, fine_percent(distance(worst)), worst["material"],
            fine_percent(noise) if noise else "none",
        ])  # fmt: skip
    return table(["in Mitsuba", "against", "light", "agree", "too noisy", "apart", "largest difference", "of", "largest noise"], rows)


def in_mitsuba(record: dict) -> str:
    """The section of the comparison with Mitsuba, whatever it found."""
    verdicts = Counter(row["verdict"] for row in record["rows"])
    noisy, apart = verdicts["too noisy to tell"], verdicts["apart"]
    finding = f"{verdicts['agrees']} of {len(record['rows'])} comparisons agree, {apart or 'none'} {'is' if apart == 1 else 'are'} apart, {noisy or 'none'} too noisy to tell"
    lamps, around = record["tolerance"]["lamps"], record["tolerance"]["map"]
    tables = [row for row in record["rows"] if row["model"] == "bsdf" and "elsewhere" in row]
    stored, read = (max(distance(row) for row in tables if row["against"] == against) for against in AGAINST)
    cause = ": what differs is what the table's resolution leaves out, not how it is read" if read < 0.1 * stored else ""
    every = ""
    if record.get("all"):
        count, worst = record["all"]["materials"], record["all"]["worst"]
        every = f"""
The tables of all {count} materials under both lamps in `{record["all"]["variant"]}`: {len(record["all"]["apart"]) or "none"} of {record["all"]["comparisons"]} comparisons apart; the furthest from its
network is `{worst["network"]["material"]}` ({fine_percent(distance(worst["network"]))}), from the same table as nbrdf reads it `{worst["table"]["material"]}` ({fine_percent(distance(worst["table"]))}).
"""
    return f"""## In Mitsuba {record["mitsuba"]}: {finding}

Spheres of {len(record["materials"])} materials ({", ".join(record["materials"])}) in {" and ".join(f"`{name}`" for name in record["variants"])} against `nbrdf render`
(`{record["command"]}`; [mitsuba.json](mitsuba.json)). Under lamps both send one ray through the middle of each pixel, and Mitsuba lights
one lamp at a time, those of the exported scene too: there is no noise, and *difference* is the share of the light that is in another place. Tables
are shown in the size and under the lamps that their resolution is chosen by; the map is a light that it is not chosen by. Agreed is
within {fine_percent(lamps["table"])} for a table against the network that it was made of, which is what an export allows, and within {fine_percent(lamps["same"])} for
the same reflectance in both. Under a map, where light is drawn by the material, or by material and map together, *difference* is that of the means;
agreed is where it is within {fine_percent(around["table"])} or {fine_percent(around["same"])} and {record["sigmas"]:.0f} standard errors, and blocks of the picture within theirs. Where the
standard error (*noise*) is above {fine_percent(record["most_noise"])} of the mean, it is too noisy to tell, and counts as neither.

{renderers(record)}

Under lamps tables in Mitsuba are within {fine_percent(stored)} of their networks, and within {fine_percent(read)} of the same tables as nbrdf reads
them{cause}.
{every}"""


def page() -> str:
    exports, parametric, mitsuba, browser = (read(name) for name in ("exports", "parametric", "mitsuba", "browser"))
    drawn = browser["rows"]
    exact = sum(row["largest_step"] == 0 for row in drawn)
    least = min(drawn, key=lambda row: row["psnr"])
    materials = len({row["material"] for row in drawn})
    return wrapped(f"""# Exports: how far each is from its source

`nbrdf export --list` names all forms; every export has a manifest with its own error. Below are all materials at once.

## Read again: weights are the same to the bit, `.bsdf` within 1 %, MERL tables and fits are not, of mirrors

{exports["rows"][0]["materials"]} published networks of MERL, written and read again (`{exports["command"]}`; [exports.json](exports.json)). *Image mean*: relative
difference of the mean of linear sphere pictures; *light elsewhere*: share of their light that is in another place, both of the worst of channels and
lights. The resolution of `.bsdf` is chosen so that the latter is within 1 %; the cells of a MERL `.binary` are fixed, and too wide for mirrors.
`gltf`, `mtlx` and `principled` are fits, of which more below.

{forms(exports)}

Of source code (`glsl`, `hlsl`, `wgsl`, `c`, `rs`, `html`) these are its numbers. The code is compiled and run by the tests (tests/shader.rs), over
directions of the metrics and at the edges of the coordinates: each value must be within 1e-4 of the library's, relative to it or to a hundredth
of a white Lambertian. C is compiled as C99 and as C++11, HLSL by glslang; WGSL, GLSL and HLSL run in a Vulkan driver in software.

{fits(parametric)}
{in_mitsuba(mitsuba)}
## In a browser: at least {least["psnr"]:.1f} dB

Pages of {materials} materials under both lights, drawn by {browser["browser"].split(" built")[0]} by software, against `nbrdf render`, {browser["size"]} × {browser["size"]} pixels
(`{browser["command"]}`; [browser.json](browser.json)). {exact} of {len(drawn)} pictures are the same to the bit; the furthest is `{least["material"]}` under
light `{least["light"]}`, {least["psnr"]:.1f} dB. Required are {browser["least_psnr"]:.0f} dB.
""")


if __name__ == "__main__":
    (DOCS / "exports.md").write_text(page())
    sys.exit(0)
