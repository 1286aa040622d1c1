"""Golden numbers for reading RGL `.bsdf` files, by Mitsuba 3: tests/golden/rgl.json.

    pip install mitsuba && python scripts/make_golden_rgl.py

Mitsuba is no dependency of the other scripts: nothing but this file needs it. The four measured files come from NBRDF_DATA;
the golden file holds directions and a few results, never a measured table.
"""

import json
from pathlib import Path

import mitsuba
import numpy as np

from nbrdf_jax import data

OUTPUT = Path(__file__).resolve().parents[1] / "tests" / "golden" / "rgl.json"
MATERIALS = ("cc_ibiza_sunset", "cg_sunflower", "colodur_napoli_4f", "paper_white")
COUNT = 24


def hemisphere(random: np.random.Generator) -> np.ndarray:
    """Unit vectors [COUNT, 3], the cosine evenly over .05..1."""
    cosine = random.uniform(0.05, 1, COUNT)
    phi = random.uniform(-np.pi, np.pi, COUNT)
    sine = np.sqrt(1 - cosine**2)
    return np.stack([sine * np.cos(phi), sine * np.sin(phi), cosine], axis=1)


def main() -> None:
    mitsuba.set_variant("scalar_rgb")
    random = np.random.default_rng(5)
    light, view = hemisphere(random), hemisphere(random)
    values = {}
    for name in MATERIALS:
        path = data.folder() / "rgl_measured" / f"{name}_rgb.bsdf"
        bsdf = mitsuba.load_dict({"type": "measured", "filename": str(path)})
        rows = []
        for to_light, to_view in zip(light, view):
            surface = mitsuba.SurfaceInteraction3f()
            surface.wi = to_view.tolist()
            surface.wavelengths = []
            # Mitsuba gives f cos θ of the light, and keeps what noise has taken below zero.
            value = np.array(bsdf.eval(mitsuba.BSDFContext(), surface, to_light.tolist())) / to_light[2]
            rows.append([float(f"{v:.6g}") for v in np.maximum(value, 0)])
        values[name] = rows
    digits = [[float(f"{v:.9g}") for v in row] for row in light], [[float(f"{v:.9g}") for v in row] for row in view]
    golden = {"schema": 1, "about": "f_r [1/sr] clamped at 0 by Mitsuba " + mitsuba.__version__ + ", plugin measured, scalar_rgb", "light": digits[0], "view": digits[1], "f": values}
    text = json.dumps(golden, separators=(",", ":")).replace("],[", "],\n[")
    OUTPUT.write_text(text + "\n")
    print(OUTPUT)


if __name__ == "__main__":
    main()
