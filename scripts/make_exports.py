"""Writes docs/exports.md of four records in docs: exports, parametric, mitsuba and browser (.json).

    python3 scripts/make_exports.py

scripts/make_exports.sh makes all of them anew.
"""

import json
import sys
from pathlib import Path

import exports_fits
import exports_mitsuba
from results_table import ROOT, number, table, wrapped

DOCS = ROOT / "docs"


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


def page() -> str:
    exports, parametric, mitsuba, browser = (read(name) for name in ("exports", "parametric", "mitsuba", "browser"))
    worst = {row["form"]: row["image_pixel_error"]["max"] for row in exports["rows"]}
    drawn = browser["rows"]
    exact = sum(row["largest_step"] == 0 for row in drawn)
    least = min(drawn, key=lambda row: row["psnr"])
    materials = len({row["material"] for row in drawn})
    return wrapped(f"""# Exports: how far each is from its source

`nbrdf export --list` names all forms; every export has a manifest with its own error. Below are all materials at once.

## Read again: weights are the same to the bit; light elsewhere in a `.bsdf` is {percent(worst["bsdf"])} at most, in a MERL `.binary` {percent(worst["binary"])}

{exports["rows"][0]["materials"]} published networks of MERL, written and read again (`{exports["command"]}`; [exports.json](exports.json)). *Image mean*: relative
difference of the mean of linear sphere pictures; *light elsewhere*: share of their light that is in another place, both of the worst of channels and
lights; *of* whom the last figure is. PSNR ends at 100 dB. The resolution of `.bsdf` is chosen so that the latter is within 1 %; the cells of a MERL `.binary` are fixed.
`gltf`, `mtlx` and `principled` are fits, of which more below.

{forms(exports)}

Of source code (`glsl`, `hlsl`, `wgsl`, `c`, `rs`, `html`) these are its numbers. The code is compiled and run by the tests (tests/shader.rs), over
directions of the metrics and at the edges of the coordinates: each value must be within 1e-4 of the library's, relative to it or to a hundredth
of a white Lambertian. C is compiled as C99 and as C++11, HLSL by glslang; WGSL, GLSL and HLSL run in a Vulkan driver in software.

{exports_fits.section(parametric)}
{exports_mitsuba.section(mitsuba)}
## In a browser: at least {least["psnr"]:.1f} dB

Pages of {materials} materials under both lights, drawn by {browser["browser"].split(" built")[0]} by software, against `nbrdf render`, {browser["size"]} × {browser["size"]} pixels
(`{browser["command"]}`; [browser.json](browser.json)). {exact} of {len(drawn)} pictures are the same to the bit; the furthest is `{least["material"]}` under
light `{least["light"]}`, {least["psnr"]:.1f} dB. Required are {browser["least_psnr"]:.0f} dB.
""")


if __name__ == "__main__":
    (DOCS / "exports.md").write_text(page())
    sys.exit(0)
