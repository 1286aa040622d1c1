"""The pages of materials, drawn by a browser, against the pictures of `nbrdf render`.

    python scripts/browser_check.py [OUT]

Each of the materials is written as a page by `nbrdf export` and rendered by `nbrdf render`, under both lights; a headless Chromium
(NBRDF_BROWSER) draws the page by software, 128 x 128 pixels. Pictures are compared as they are displayed, pixel by pixel where the sphere
is. The figures go to OUT, docs/browser.json by default. Exit code 1 where a picture is further away than LEAST_PSNR.
"""

import base64
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
NBRDF = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "nbrdf"
MATERIALS = ["alum-bronze", "black-obsidian", "blue-acrylic", "cherry-235", "chrome", "gold-metallic-paint", "green-latex", "pearl-paint",
             "pink-felt", "red-plastic", "two-layer-silver", "white-fabric", "rgl/cc_ibiza_sunset", "rgl/satin_gold"]  # fmt: skip
LIGHTS = ["studio", "point"]
SIZE = 128
LEAST_PSNR = 45.0  # dB
HIGHEST_PSNR = 100.0  # dB, of equal pictures
FLAGS = ["--headless", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
DRAWN = re.compile(r'<img[^>]* src="data:image/png;base64,([^"]+)"')
SAID = re.compile(r'role="alert"[^>]*>([^<]*)')


def run(*words: object) -> str:
    """Runs a program; what it says on standard output."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=300)
    if done.returncode:
        raise SystemExit(f"{words[0]} ended with exit code {done.returncode}:\n{done.stderr}")
    return done.stdout


def read(png: bytes) -> np.ndarray:
    """A picture's displayed values of 0..1, [SIZE, SIZE, 3]."""
    values = np.asarray(Image.open(BytesIO(png)).convert("RGB"), dtype=np.float64) / 255
    if values.shape != (SIZE, SIZE, 3):
        raise SystemExit(f"expected {SIZE} x {SIZE} pixels, found {values.shape[1]} x {values.shape[0]}")
    return values


def covered() -> np.ndarray:
    """Where the sphere is: orthographic, radius 0.99 of half the picture, seen at the centres of pixels."""
    across = (2 * (np.arange(SIZE) + 0.5) / SIZE - 1) / 0.99
    return across[:, None] ** 2 + across[None, :] ** 2 < 1


def compare(drawn: np.ndarray, rendered: np.ndarray) -> dict:
    """PSNR in dB and the largest difference in steps of 1/255. Beside the sphere both are black."""
    inside = covered()
    if drawn[~inside].any() or rendered[~inside].any():
        raise SystemExit("a picture is not black beside the sphere")
    if not rendered.any():
        raise SystemExit("a rendered picture is black")
    error = drawn[inside] - rendered[inside]
    mean = float((error**2).mean())
    psnr = HIGHEST_PSNR if mean == 0 else min(-10 * np.log10(mean), HIGHEST_PSNR)
    return {"psnr": round(float(psnr), 2), "largest_step": round(float(np.abs(error).max()) * 255)}


def draw(browser: str, page: Path, light: str) -> bytes:
    """The page's picture as a browser draws it that knows nothing of earlier ones."""
    with tempfile.TemporaryDirectory() as profile:
        # Chromium's own sandbox does not run as root.
        root = ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        address = f"{page.as_uri()}?test={SIZE}&light={light}"
        dom = run(browser, *FLAGS, *root, f"--user-data-dir={profile}", "--dump-dom", address)
    if found := DRAWN.search(dom):
        return base64.b64decode(found[1])
    said = SAID.search(dom)
    raise SystemExit(f"{page.name} draws nothing: {said[1] if said else 'the page stayed as it was'}")


def check(browser: str, folder: Path, material: str) -> list[dict]:
    """The figures of one material under each light."""
    stem = folder / material.replace("/", "_")
    page, picture = (stem.with_suffix(suffix) for suffix in (".html", ".png"))
    run(NBRDF, "export", material, "--to", "html", "-q", "-o", page)
    rows = []
    for light in LIGHTS:
        run(NBRDF, "render", material, "-q", "--light", light, "--size", SIZE, "-o", picture)
        rows.append({"material": material, "light": light, **compare(read(draw(browser, page, light)), read(picture.read_bytes()))})
    return rows


def main(arguments: list[str]) -> int:
    """The exit code."""
    out = Path(arguments[0]) if arguments else ROOT / "docs" / "browser.json"
    browser = os.environ.get("NBRDF_BROWSER") or shutil.which("chromium")
    if not browser:
        print("missing: Chromium; NBRDF_BROWSER names one", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        found = pool.map(lambda material: check(browser, Path(folder), material), MATERIALS)
        rows = [row for rows in found for row in rows]
    worst = min(rows, key=lambda row: row["psnr"])
    version = run(browser, "--version").strip()
    report = {"schema": 1, "command": "scripts/browser_check.py", "browser": version, "size": SIZE, "least_psnr": LEAST_PSNR, "rows": rows}
    out.write_text(json.dumps(report, indent=1) + "\n")
    print(f"{len(rows)} pictures of {len(MATERIALS)} materials: at least {worst['psnr']} dB ({worst['material']}, {worst['light']})")
    if worst["psnr"] < LEAST_PSNR:
        print(f"at least {LEAST_PSNR} dB were expected", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
