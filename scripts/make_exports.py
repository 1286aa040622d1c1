"""Writes docs/exports.md of four records in docs: exports, parametric, mitsuba and browser (.json).

    python3 scripts/make_exports.py

scripts/make_exports.sh makes all of them anew.
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


FITS = {"gltf": "glTF", "open_pbr": "OpenPBR", "principled": "Principled"}
DATABASES = {"merl": "MERL", "rgl": "RGL"}


def fits(record: dict) -> str:
    """How far standard shading models are, for every database and model."""
    rows = []
    for database, models in record["databases"].items():
        for model, row in models.items():
            error, relative, psnr, itp = (row[key] for key in ("log_error", "relative_log", "studio_psnr", "studio_delta_e_itp"))
            rows.append([
                f"{FITS[model]}, {DATABASES[database]}", str(row["materials"]), number(error["mean"], 4), number(error["max"], 4), number(relative["mean"], 3),
                number(psnr["mean"], 1), number(psnr["max"], 1), number(itp["mean"], 1), number(itp["max"], 1), ", ".join(psnr["worst"][:2]),
            ])  # fmt: skip
    head = ["model, database", "materials", "log_error, mean", "worst", "relative_log, mean", "studio PSNR, mean", "worst", "ΔE_ITP, mean", "worst", "worst two by PSNR"]
    return table(head, rows)


def parts(record: dict) -> str:
    """How many materials of MERL use which part of each model."""
    of = lambda row: ", ".join(f"{part} {count}" for part, count in sorted(row["parts"].items(), key=lambda item: -item[1]) if part)  # noqa: E731
    told = [f"{FITS[model]}: {of(row) or 'none'}" for model, row in record["databases"]["merl"].items()]
    return "; ".join(told)


def best_fit(record: dict) -> tuple[str, dict]:
    """The model that is closest to MERL's materials in the mean, by pictures."""
    return max(record["databases"]["merl"].items(), key=lambda item: item[1]["studio_psnr"]["mean"])


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
    exports, parametric, mitsuba, browser = (read(name) for name in ("exports", "parametric", "mitsuba", "browser"))
    closest, closest_row = best_fit(parametric)
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

## As parameters of standard models: {FITS[closest]} is closest, {number(closest_row["studio_psnr"]["mean"], 0)} dB in the mean, {number(closest_row["studio_psnr"]["max"], 0)} dB at worst

For tools that accept nothing else: every published network fitted by each model (`{parametric["command"]}`;
[parametric.json](parametric.json)), judged as the specification evaluates those numbers. Each export comes with its own error and a picture
of the difference. The fuzz of OpenPBR and the sheen of Principled are not fitted: tools take them from tables of their own, which nothing
here could be checked against; glTF's sheen is a formula, and is.

{fits(parametric)}

Parts beyond base, metalness and roughness that MERL's materials use, by count: {parts(parametric)}.

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
