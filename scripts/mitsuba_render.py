"""Pictures by Mitsuba 3 for `mitsuba_check.py`, one variant to a process: a library that aborts takes only this one along.

    python scripts/mitsuba_render.py JOB.json

JOB.json: `variant`, `output` (.npz), `materials` (name, bsdf, scene, plugin as a dict of parameters), `lamps` (name → directions
towards the lamp and irradiance), `environment` (.exr), `effort` of each model (sizes and samples), `seeds`, `is_around` (also
under the map), `narrowest` (width of the lobe that a map or a coarse picture still finds). The output holds arrays
[seeds, size, size, 3] named material/model/light, model `bsdf`, `plugin` or, for the scene that comes with an export, `scene`.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import mitsuba as mi
import numpy as np

RADIUS = 0.99


def scene(bsdf: mi.BSDF, emitter: dict, size: int, integrator: dict, sampler: str) -> mi.Scene:
    """The sphere of `nbrdf render`, under one emitter."""
    film = {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    view = mi.ScalarTransform4f().look_at(origin=[0, 0, 4], target=[0, 0, 0], up=[0, 1, 0])
    sensor = {"type": "orthographic", "to_world": view, "film": film, "sampler": {"type": sampler}}
    sphere = {"type": "sphere", "radius": RADIUS, "bsdf": bsdf}
    return mi.load_dict({"type": "scene", "integrator": integrator, "sensor": sensor, "sphere": sphere, "emitter": emitter})


def under_lamps(bsdf: mi.BSDF, lamps: dict, size: int, samples: int, seeds: int) -> np.ndarray:
    """Lamp by lamp, so that none is left to chance; [seeds, size, size, 3]."""
    total = np.zeros((seeds, size, size, 3))
    for direction, irradiance in zip(lamps["directions"], lamps["irradiance"]):
        emitter = {"type": "directional", "direction": [-x for x in direction], "irradiance": {"type": "rgb", "value": irradiance}}
        lit = scene(bsdf, emitter, size, {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0}, "stratified")
        total += np.stack([np.array(mi.render(lit, spp=samples, seed=seed)) for seed in range(seeds)])
    return total


def around(bsdf: mi.BSDF, path: str, size: int, samples: int, seeds: int, by_bsdf: bool) -> np.ndarray:
    """Under an environment, lights drawn by the material or by the map; [seeds, size, size, 3]."""
    integrator = {"type": "direct", "bsdf_samples": int(by_bsdf), "emitter_samples": int(not by_bsdf), "hide_emitters": True}
    lit = scene(bsdf, {"type": "envmap", "filename": path}, size, integrator, "independent")
    return np.stack([np.array(mi.render(lit, spp=samples, seed=seed)) for seed in range(seeds)])


def main() -> None:
    job = json.loads(Path(sys.argv[1]).read_text())
    mi.set_variant(job["variant"])
    import mitsuba_nbrdf  # registers the plugin, for the variant that is set

    pictures = {}
    for material in job["materials"]:
        for model in job["models"]:
            is_python = model == "plugin"
            parameters = material["plugin"] if is_python else {"type": "measured", "filename": material["bsdf"]}
            bsdf = mi.load_dict(parameters)
            effort = job["effort"]["plugin" if is_python else "bsdf"]
            name = f"{material['name']}/{model}"
            network = material["plugin"] if "plugin" in material else None
            width = 1.0
            if network:
                _, width = mitsuba_nbrdf.lobe(mitsuba_nbrdf.read(network["filename"], network.get("checkpoint")))
            # A narrow highlight is hardly ever found by a map or a few pixels: rare, bright hits would say nothing in any
            # affordable time.
            is_wide = width >= job["narrowest"]
            if is_wide or not effort["is_coarse"]:
                for light, lamps in job["lamps"].items():
                    pictures[f"{name}/{light}"] = under_lamps(bsdf, lamps, effort["size"], effort["lamp_samples"], job["seeds"])
            if not job["is_around"]:
                continue
            ways = (("drawn_by_material", True), ("drawn_by_map", False))
            for light, by_bsdf in ways if is_wide else ways[:1]:
                samples = effort["material_samples"] if by_bsdf else effort["map_samples"]
                pictures[f"{name}/{light}"] = around(bsdf, job["environment"], effort["size"], samples, job["seeds"], by_bsdf)
        if "scene" in material:
            size, samples = job["scene_size"], job["scene_samples"]
            ready = mi.load_file(material["scene"], size=size, samples=samples)
            seeds = [np.array(mi.render(ready, seed=seed))[..., :3] for seed in range(job["seeds"])]
            pictures[f"{material['name']}/scene/studio"] = np.stack(seeds)
        print(f"  {job['variant']}: {material['name']}", file=sys.stderr, flush=True)
    np.savez(job["output"], **pictures)


if __name__ == "__main__":
    main()
