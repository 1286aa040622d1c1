"""Materials, exported once and rendered by all variants of Mitsuba, against what `nbrdf render` shows."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

import mitsuba_judge as judge
from mitsuba_process import find_llvm, run_job
from mitsuba_references import LAMPS, References
from nbrdf_jax import data, lights

CHECKPOINT = Path(__file__).resolve().parents[1] / "autoencoder" / "assets" / "znbrdf.safetensors"
MATERIALS = (
    "red-fabric", "gold-metallic-paint", "blue-acrylic", "black-obsidian", "chrome", "white-fabric", "steel", "green-plastic",
    "teflon", "pickled-oak-260", "alum-bronze", "violet-rubber",
)  # fmt: skip
CODES = ("gold-metallic-paint", "violet-rubber")
# Scenes that are rendered as they come. Such noise is ten times as dear where highlights are sharp: a lamp in eleven is drawn.
DRAWN = ("red-fabric", "gold-metallic-paint", "violet-rubber")
QUICK, QUICK_DRAWN = 3, 1
# Processes at a time: Python in a scalar variant keeps one core busy, the rest all of them.
PROCESSES = 2


class Comparison:
    """What is rendered where, and how it is judged."""

    # Of the light: `same` where both render one reflectance, and single precision is all that differs (under the map also how
    # pixels are joined), `table` where one renders a table of it, as fine as `nbrdf export` makes it.
    TOLERANCE = {"lamps": {"same": 1e-4, "table": 0.01}, "map": {"same": 1e-3, "table": 0.01}}

    def __init__(self, program: Path, scratch: Path, quick: bool) -> None:
        self.scratch, self.quick = scratch, quick
        self.names = list(MATERIALS[:QUICK] if quick else MATERIALS)
        self.drawn = DRAWN[:QUICK_DRAWN] if quick else DRAWN
        self.codes = [name for name in CODES if name in self.names]
        published = data.archive("merl")
        self.networks = "published" if published.is_file() else "built-in"
        # As many seeds as passes, for what is known of their noise.
        self.references = References(program, scratch, judge.LEAST_PASSES, 1 if quick else 4, published if published.is_file() else None)
        self.library = find_llvm()
        self.variants = ["scalar_rgb"] + (["llvm_ad_rgb"] if self.library else [])
        if not self.library:
            print("SKIPPED: llvm_ad_rgb: no working LLVM was found (Debian: libllvm19; or set DRJIT_LIBLLVM_PATH)")
        if self.networks != "published":
            print(f"SKIPPED: the published networks: no {published}; the built-in refits take their place")
        self.references.run("export", *self.names, "--to", "bsdf", "-o", "tables")
        self.references.run("export", *self.names, "--to", "npz", "-o", "networks")
        for name in self.codes:
            self.references.run("encode", name, "-o", f"{name}.json")

    def materials(self) -> list[dict]:
        """Tables, scenes and networks of all, and codes of some."""
        codes = [{"type": "nbrdf", "filename": str(self.scratch / f"{name}.json"), "checkpoint": str(CHECKPOINT)} for name in self.codes]
        decoded = [{"name": f"code of {name}", "plugin": code} for name, code in zip(self.codes, codes)]
        return [self.material(name) for name in self.names] + decoded

    def material(self, name: str) -> dict:
        table = self.scratch / "tables" / name
        network = {"type": "nbrdf", "filename": str(self.scratch / "networks" / f"{name}.npz")}
        return {"name": name, "bsdf": f"{table}.bsdf", "scene": f"{table}.xml", "as_it_comes": name in self.drawn, "plugin": network}

    def job(self, variant: str, materials: list[dict], part: str, lamps: tuple[str, ...] = LAMPS) -> dict:
        """What a process is to render; see `mitsuba_render.py`."""
        quick = self.quick
        built_in = {"lamps": 128, "size": 32, "samples": 121, "most_passes": 64, "ways": ["drawn_by_material", "drawn_by_both"]}
        # Python for every ray: a thousand times slower. Material and map together are the least noise, and use all methods.
        slow = {"lamps": 32 if quick else 64, "size": 8, "samples": 49 if quick else 121, "most_passes": 64}
        slow["ways"] = built_in["ways"][1:] if quick else built_in["ways"]
        scene = {"lamps": 128, "size": 32, "samples": 128, "most_passes": 96, "target": 0.002}
        lit = {name: dict(zip(("directions", "irradiance"), (d.tolist(), (np.pi * e).tolist()))) for name in lamps for d, e in [lights.lamps(name)]}
        return {
            "variant": variant, "output": str(self.scratch / f"{variant}-{part}.npz"), "materials": materials, "lamps": lit,
            "environment": str(self.references.environment), "target": 0.002 if quick else 0.001,
            "effort": {"bsdf": built_in, "plugin": built_in if variant.startswith("llvm") else slow, "scene": scene},
        }  # fmt: skip

    def rows(self) -> list[dict]:
        """Every picture against those of `nbrdf render`."""
        materials = self.materials()
        parts = [("scalar_rgb", materials[start::PROCESSES]) for start in range(PROCESSES)]
        parts += [(variant, materials) for variant in self.variants[1:]]
        jobs = [self.job(variant, part, str(index)) for index, (variant, part) in enumerate(parts)]
        with ThreadPoolExecutor(PROCESSES) as pool:
            found = list(pool.map(lambda job: run_job(job, self.library), jobs))
        return [row for job, pictures in zip(jobs, found) for row in self.judged(job["variant"], pictures)]

    def shown(self, names: list[str], size: int) -> dict[str, tuple[np.ndarray, ...]]:
        """Of each material the pictures under `studio` by nbrdf, of its table and of its network, with the fastest variant."""
        materials = [{key: value for key, value in self.material(name).items() if key != "scene"} for name in names]
        job = self.job(self.variants[-1], materials, "shown", ("studio",))
        effort = {"lamps": size, "ways": []}
        found = run_job(job | {"effort": {"bsdf": effort, "plugin": effort}}, self.library)
        models = {name: [found[f"{name}/{model}/studio"][0] for model in ("bsdf", "plugin")] for name in names}
        return {name: (self.references.pictures(name, "studio", size)[0], *pictures) for name, pictures in models.items()}

    def of_all_tables(self) -> list[dict]:
        """Tables of every MERL material under lamps, with the fastest variant."""
        names = self.references.merl()
        self.references.run("export", *names, "--to", "bsdf", "-o", "tables")
        job = self.job(self.variants[-1], [{"name": name, "bsdf": self.material(name)["bsdf"]} for name in names], "all")
        return self.judged(job["variant"], run_job(job | {"environment": None}, self.library))

    def judged(self, variant: str, pictures: dict[str, np.ndarray]) -> list[dict]:
        rows = []
        for key, passes in pictures.items():
            name, model, light = key.rsplit("/", 2)
            for against in ("network",) if model == "plugin" else ("network", "table"):
                kind = "table" if model != "plugin" and against == "network" else "same"
                found = self.judge(passes, self.source(name, against), light, kind)
                rows.append({"variant": variant, "material": name, "model": model, "light": light, "against": against, **found})
        return rows

    def judge(self, passes: np.ndarray, source: str, light: str, kind: str) -> dict:
        wanted = self.references.pictures(source, light, passes.shape[1])
        if light in LAMPS:
            return judge.exact(passes[0], wanted[0], self.TOLERANCE["lamps"][kind])
        return judge.noisy(passes, wanted, self.TOLERANCE["map"][kind])

    def source(self, name: str, against: str) -> str:
        """What nbrdf renders: the material's table, its code, or the material."""
        if against == "table":
            return f"tables/{name}.bsdf"
        return f"{name.removeprefix('code of ')}.json" if name.startswith("code of ") else name
