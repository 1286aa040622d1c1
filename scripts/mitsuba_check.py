"""Whether Mitsuba 3 shows what `nbrdf render` shows: the exported `.bsdf` in its stock plugin `measured`, the Python plugin
`mitsuba_nbrdf.py` on networks and codes, and the scene that comes with an export.

    python scripts/mitsuba_check.py [--quick] [--all] [--nbrdf PROGRAM] [-o docs/mitsuba.json] [--strip docs/images/mitsuba.png]

Spheres under the lights of measurement (`point`, `studio`) and under an environment map, where lights are drawn by the
material and, where its highlight is wide enough for it, by the map: if a plugin's density were not that of what it draws, the
two would differ. Agreement is within the noise that several seeds show, and within 1 % for tables (0.2 % for networks).
Renders with `scalar_rgb`, and with `llvm_ad_rgb` where a working LLVM is found; each library is tried in a process of its own,
since some versions abort.
Exits with 1 where pictures disagree, with 2 where Mitsuba or `nbrdf` is not there.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from mitsuba_judge import SIGMAS, averaged, compared
from mitsuba_process import find_llvm, run_job
from nbrdf_jax import lights

ROOT = Path(__file__).resolve().parents[1]
CHECKPOINT = ROOT / "autoencoder" / "assets" / "znbrdf.safetensors"
MATERIALS = (
    "red-fabric", "gold-metallic-paint", "blue-acrylic", "black-obsidian", "chrome", "white-fabric", "steel", "green-plastic",
    "teflon", "pickled-oak-260", "alum-bronze", "violet-rubber",
)  # fmt: skip
CODES = ("gold-metallic-paint", "violet-rubber")
QUICK = 3
SUPERSAMPLED = 512
TOLERANCE = {"bsdf": 0.01, "scene": 0.01, "plugin": 0.002}
SEEDS = 8
NARROWEST = 0.1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} materials, fewer samples: up to two minutes")
    parser.add_argument("--all", action="store_true", help="also the tables of all built-in MERL materials, under lamps")
    parser.add_argument("--nbrdf", type=Path, default=Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "nbrdf")
    parser.add_argument("-o", "--output", type=Path, help="the figures as JSON")
    parser.add_argument("--strip", type=Path, help="a picture: nbrdf, its table and its network in Mitsuba")
    options = parser.parse_args()
    if not options.nbrdf.is_file():
        print(f"{options.nbrdf}: no such program: build it, or name it with --nbrdf", file=sys.stderr)
        return 2
    try:
        import mitsuba as mi
    except ImportError:
        print("Mitsuba 3 is not installed: pip install -e scripts", file=sys.stderr)
        return 2
    mi.set_variant("scalar_rgb")
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        check = Check(options, Path(scratch), mi)
        report = check.run()
        if options.all:
            report["all"] = check.all(report["variants"][-1])
        report["seconds"] = round(time.monotonic() - began)
        if options.strip:
            check.strip(options.strip)
    if options.output:
        options.output.write_text(json.dumps(report, indent=1) + "\n")
    rows = report["rows"] + report.get("all", {}).get("apart", [])
    apart = [row for row in rows if row["verdict"] != "agrees"]
    for row in apart:
        print(f"{row['variant']} {row['material']} {row['model']} {row['light']}: {row['verdict']}: {row}")
    worst = max(row["relative_difference"] for row in report["rows"])
    print(f"{len(report['rows']) - len(apart)} of {len(report['rows'])} pictures agree ({', '.join(report['variants'])}); means differ by {worst:.2%} at most; {report['seconds']} s")
    return 1 if apart else 0


class Check:
    """The materials, exported and rendered once, and pictures of all variants against them."""

    def __init__(self, options: argparse.Namespace, scratch: Path, mi) -> None:
        self.options, self.scratch, self.mi = options, scratch, mi
        self.names = MATERIALS[:QUICK] if options.quick else MATERIALS
        self.library: str | None = None
        self.codes = [name for name in CODES if name in self.names]
        self.environment = scratch / "environment.exr"
        self.pictures: dict[str, dict[str, np.ndarray]] = {}

    def run(self) -> dict:
        self.write_environment()
        self.nbrdf("export", *self.names, "--to", "bsdf", "-o", "tables")
        self.nbrdf("export", *self.names, "--to", "npz", "-o", "networks")
        for name in self.codes:
            self.nbrdf("encode", name, "-o", f"{name}.json")
        self.library = library = find_llvm()
        variants = ["scalar_rgb"] + (["llvm_ad_rgb"] if library else [])
        if not library:
            print("SKIPPED: llvm_ad_rgb: no working LLVM was found (Debian: libllvm19; or set DRJIT_LIBLLVM_PATH)")
        rows = []
        for variant in variants:
            self.pictures[variant] = self.render(variant)
            rows += self.rows(variant, self.pictures[variant])
        return {
            "schema": 1, "about": "spheres by Mitsuba against `nbrdf render`",
            "command": " ".join(["python scripts/mitsuba_check.py", *(["--quick"] * self.options.quick)]),
            "mitsuba": self.mi.__version__, "llvm": Path(library).name if library else None, "variants": variants,
            "materials": list(self.names), "tolerance": TOLERANCE, "sigmas": SIGMAS, "rows": rows,
        }  # fmt: skip

    def all(self, variant: str) -> dict:
        """Tables of every MERL material under lamps, with the fastest variant: the spread of how far means differ, and what is
        apart."""
        listed = subprocess.run([self.options.nbrdf.resolve(), "list", "--json"], check=True, capture_output=True)
        names = [row["name"] for row in json.loads(listed.stdout)["materials"] if row["database"] == "merl"]
        self.nbrdf("export", *names, "--to", "bsdf", "-o", "all")
        materials = [{"name": name, "bsdf": str(self.scratch / "all" / f"{name}.bsdf")} for name in names]
        job = self.job(variant, materials, ["bsdf"]) | {"is_around": False, "output": str(self.scratch / "all.npz"), "seeds": 4}
        job["effort"] = {"bsdf": {"is_coarse": False, "size": 32, "lamp_samples": 64}}
        pictures = run_job(job, self.scratch, self.library)
        rows = self.rows(variant, pictures)
        ordered = sorted(rows, key=lambda row: row["relative_difference"])
        found = [row["relative_difference"] for row in ordered]
        worst = [f"{row['material']} {row['light']} {row['relative_difference']}" for row in ordered[:-6:-1]]
        mean = float(f"{np.mean(found):.4g}")
        return {"materials": len(names), "variant": variant, "mean": mean, "max": found[-1], "worst": worst, "apart": [row for row in rows if row["verdict"] != "agrees"]}

    def nbrdf(self, *arguments: str) -> None:
        subprocess.run([self.options.nbrdf.resolve(), *arguments, "--quiet"], cwd=self.scratch, check=True, stdout=subprocess.DEVNULL)

    def write_environment(self) -> None:
        """A sky that is brighter above, and two soft lights; smooth, so that it hardly matters how pixels are joined."""
        height = 64
        theta, phi = np.meshgrid((np.arange(height) + 0.5) / height * np.pi, (np.arange(2 * height) + 0.5) / height * np.pi, indexing="ij")
        sky = np.stack((0.3 + 0.2 * np.cos(theta), 0.35 + 0.2 * np.cos(theta), 0.45 + 0.25 * np.cos(theta)), axis=-1)
        lamp = lambda t, p, colour: np.exp(6 * (np.cos(theta) * np.cos(t) + np.sin(theta) * np.sin(t) * np.cos(phi - p) - 1))[..., None] * colour  # noqa: E731
        pixels = sky + lamp(0.9, 3.9, np.array([3.0, 2.6, 2.2])) + lamp(1.4, 2.1, np.array([0.7, 0.9, 1.2]))
        self.mi.Bitmap(pixels.astype(np.float32)).write(str(self.environment))

    def job(self, variant: str, materials: list[dict], models: list[str]) -> dict:
        """What a process is to render; see `mitsuba_render.py`."""
        is_fast, quick = variant.startswith("llvm"), self.options.quick
        plain = {"is_coarse": False, "size": 32, "lamp_samples": 64, "material_samples": 64, "map_samples": 256}
        slow = {"is_coarse": True, "size": 8 if quick else 16, "lamp_samples": 4, "material_samples": 16, "map_samples": 32}
        if is_fast and not quick:
            plain |= {"size": 64}
        lamps = {}
        for name in ("point", "studio"):
            directions, irradiance = lights.lamps(name)
            lamps[name] = {"directions": directions.tolist(), "irradiance": (np.pi * irradiance).tolist()}
        return {
            "variant": variant, "output": str(self.scratch / f"{variant}.npz"), "materials": materials, "models": models,
            "lamps": lamps, "environment": str(self.environment), "is_around": True, "narrowest": NARROWEST, "seeds": SEEDS,
            "scene_size": 64, "scene_samples": 16 if quick else 256, "effort": {"bsdf": plain, "plugin": plain if is_fast else slow},
        }  # fmt: skip

    def render(self, variant: str) -> dict[str, np.ndarray]:
        """Tables, networks and scenes of all materials, and codes of some."""
        materials = []
        for name in self.names:
            network = {"type": "nbrdf", "filename": str(self.scratch / "networks" / f"{name}.npz")}
            table = self.scratch / "tables" / f"{name}"
            materials.append({"name": name, "bsdf": f"{table}.bsdf", "scene": f"{table}.xml", "plugin": network})
        pictures = run_job(self.job(variant, materials, ["bsdf", "plugin"]), self.scratch, self.library)
        decoded = []
        for name in self.codes:
            code = {"type": "nbrdf", "filename": str(self.scratch / f"{name}.json"), "checkpoint": str(CHECKPOINT)}
            decoded.append({"name": f"code of {name}", "plugin": code})
        return pictures | run_job(self.job(variant, decoded, ["plugin"]), self.scratch, self.library)

    def reference(self, name: str, light: str, size: int) -> np.ndarray:
        """The picture of `nbrdf render`, averaged down to this size."""
        path = self.scratch / f"{name.replace(' ', '_')}-{light}.exr"
        if not path.exists():
            material = f"{name.removeprefix('code of ')}.json" if name.startswith("code of ") else name
            how = ["--light", light] if light in ("point", "studio") else ["--environment", str(self.environment), "--samples", "64" if self.options.quick else "256"]
            self.nbrdf("render", material, "-o", path.name, "--size", str(SUPERSAMPLED if light in ("point", "studio") else 64), *how)
        pixels = np.array(self.mi.Bitmap(str(path)))[..., :3].astype(np.float64)
        return averaged(pixels, size)

    def rows(self, variant: str, pictures: dict[str, np.ndarray]) -> list[dict]:
        """Every picture against that of `nbrdf render`."""
        rows = []
        for key, seeds in pictures.items():
            name, model, light = key.rsplit("/", 2)
            is_around = light.startswith("drawn_by")
            wanted = self.reference(name, "environment" if is_around else light, seeds.shape[1])
            row = compared(seeds, wanted, TOLERANCE[model], is_around)
            rows.append({"variant": variant, "material": name, "model": model, "light": light, **row})
        return rows

    def strip(self, path: Path) -> None:
        """Three rows under `studio`: nbrdf, the table, the network; materials from left to right."""
        pictures = self.pictures[list(self.pictures)[-1]]
        columns = []
        for name in self.names:
            # Python in a scalar variant is too slow for narrow highlights: such a place stays black.
            nothing = np.zeros((1, 64, 64, 3))
            table, network = (pictures.get(f"{name}/{model}/studio", nothing).mean(axis=0) for model in ("scene", "plugin"))
            shown = [enlarged(picture, 128) for picture in (self.reference(name, "studio", 64), table, network)]
            columns.append(np.concatenate(shown, axis=0))
        pixels = np.clip(np.concatenate(columns, axis=1), 0, 1) ** (1 / 2.2)
        path.parent.mkdir(parents=True, exist_ok=True)
        self.mi.Bitmap(np.round(255 * pixels).astype(np.uint8)).write(str(path))


def enlarged(pixels: np.ndarray, size: int) -> np.ndarray:
    """The nearest pixel for each."""
    places = np.arange(size) * pixels.shape[0] // size
    return pixels[places][:, places]


if __name__ == "__main__":
    sys.exit(main())
