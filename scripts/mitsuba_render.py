"""Pictures by Mitsuba 3 for `mitsuba_check.py`, one variant to a process: a library that aborts takes only this one along.

    python scripts/mitsuba_render.py JOB.json

JOB.json: `variant`, `output` (.npz), `materials` (`name`, and of `bsdf`, `scene`, `plugin` those that there are: a table, a scene,
parameters of the plugin; with a scene `as_it_comes`, whether it is rendered so, too), `lamps` (name → directions towards the
lamp and irradiance), `environment` (.exr) or null, `effort` of `bsdf` and `plugin` (`lamps` is the size of pictures under lamps;
`size`, `samples`, `most_passes` and `ways` are for the map) and of `scene` (`lamps` as well; `size`, `samples`, `most_passes` and
`target` are for the scene as it comes), `target` (noise to stop at). The output holds arrays [passes, size, size, 3] named
material/model/light.

Under lamps rays go through the middles of pixels, as those of `nbrdf render` do, and lamps are lit one by one: nothing is left
to chance, and one pass is exact. Under a map samples are those of orthogonal arrays (W. Jarosz et al., *Orthogonal Array Sampling
for Monte Carlo Rendering*, 2019), several times less noisy than independent ones; passes are added until noise is at the target.
So they are for an exported scene just as it comes, which draws one of its lamps for each sample.
"""

from __future__ import annotations

import json
import os
import sys
import xml.etree.ElementTree as ElementTree
from copy import deepcopy
from pathlib import Path

import mitsuba as mi
import numpy as np

from mitsuba_judge import LEAST_PASSES, relative_noise

RADIUS = 0.99
# One sample, in the middle of the pixel.
MIDDLE = {"type": "stratified", "jitter": False, "sample_count": 1}
# Light of either's directions alone, or of both by the balance heuristic: samples of the material and of the map.
WAYS = {"drawn_by_material": (1, 0), "drawn_by_both": (1, 1)}


def scene(bsdf: mi.BSDF, emitter: dict, size: int, integrator: dict, sampler: dict) -> mi.Scene:
    """The sphere of `nbrdf render`, under one emitter."""
    film = {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    view = mi.ScalarTransform4f().look_at(origin=[0, 0, 4], target=[0, 0, 0], up=[0, 1, 0])
    sensor = {"type": "orthographic", "to_world": view, "film": film, "sampler": sampler}
    sphere = {"type": "sphere", "radius": RADIUS, "bsdf": bsdf}
    return mi.load_dict({"type": "scene", "integrator": integrator, "sensor": sensor, "sphere": sphere, "emitter": emitter})


def picture(lit: mi.Scene, seed: int = 0) -> np.ndarray:
    """[size, size, 3]."""
    return np.array(mi.render(lit, seed=seed), dtype=np.float64)[..., :3]


def under_lamps(bsdf: mi.BSDF, lamps: dict, size: int) -> np.ndarray:
    """[1, size, size, 3], without noise."""
    integrator = {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0}
    total = np.zeros((size, size, 3))
    for direction, irradiance in zip(lamps["directions"], lamps["irradiance"]):
        emitter = {"type": "directional", "direction": [-x for x in direction], "irradiance": {"type": "rgb", "value": irradiance}}
        total += picture(scene(bsdf, emitter, size, integrator, MIDDLE))
    return total[np.newaxis]


def of_file(path: Path, size: int) -> np.ndarray:
    """A scene as it comes, but for its sampler, lamp by lamp; [1, size, size, 3], without noise."""
    root = ElementTree.parse(path).getroot()
    sensor = root.find("sensor")
    sensor.remove(sensor.find("sampler"))
    sampler = ElementTree.SubElement(sensor, "sampler", type=MIDDLE["type"])
    ElementTree.SubElement(sampler, "boolean", name="jitter", value="false")
    ElementTree.SubElement(sampler, "integer", name="sample_count", value="1")
    total = np.zeros((size, size, 3))
    # Several processes may be at this scene; what it refers to is beside it.
    single = path.with_name(f"{path.stem}-lamp-{os.getpid()}.xml")
    for lamp in range(len(root.findall("emitter"))):
        lit = deepcopy(root)
        for index, emitter in enumerate(lit.findall("emitter")):
            if index != lamp:
                lit.remove(emitter)
        ElementTree.ElementTree(lit).write(single)
        total += picture(mi.load_file(str(single), size=size))
    return total[np.newaxis]


def around(bsdf: mi.BSDF, path: str, effort: dict, way: str, target: float) -> np.ndarray:
    """Under an environment, pass by pass; [passes, size, size, 3]."""
    by_bsdf, by_map = WAYS[way]
    integrator = {"type": "direct", "bsdf_samples": by_bsdf, "emitter_samples": by_map, "hide_emitters": True}
    sampler = {"type": "orthogonal", "sample_count": effort["samples"]}
    lit = scene(bsdf, {"type": "envmap", "filename": path}, effort["size"], integrator, sampler)
    return passes(lit, effort["most_passes"], target)


def as_it_comes(path: Path, effort: dict) -> np.ndarray:
    """A scene with its own sampler, film and lamps, as `mi.load_file` reads it; [passes, size, size, 3]."""
    lit = mi.load_file(str(path), size=effort["size"], samples=effort["samples"])
    return passes(lit, effort["most_passes"], effort["target"])


def passes(lit: mi.Scene, most: int, target: float) -> np.ndarray:
    """Pictures of other seeds until the noise of their mean is known to be at the target, or there are so many."""
    done: list[np.ndarray] = []
    while len(done) < LEAST_PASSES or (len(done) < most and not relative_noise(done) <= target):
        done.append(picture(lit, seed=len(done)))
    return np.stack(done)


def main() -> None:
    job = json.loads(Path(sys.argv[1]).read_text())
    mi.set_variant(job["variant"])
    import mitsuba_nbrdf  # noqa: F401  registers the plugin, for the variant that is set

    pictures = {}
    for material in job["materials"]:
        for model in ("bsdf", "plugin"):
            if model not in material:
                continue
            bsdf = mi.load_dict(material["plugin"] if model == "plugin" else {"type": "measured", "filename": material["bsdf"]})
            name, effort = f"{material['name']}/{model}", job["effort"][model]
            for light, lamps in job["lamps"].items():
                pictures[f"{name}/{light}"] = under_lamps(bsdf, lamps, effort["lamps"])
            for way in effort["ways"] if job["environment"] else ():
                pictures[f"{name}/{way}"] = around(bsdf, job["environment"], effort, way, job["target"])
        if "scene" in material:
            path, effort = Path(material["scene"]), job["effort"]["scene"]
            pictures[f"{material['name']}/scene/studio"] = of_file(path, effort["lamps"])
            if material["as_it_comes"]:
                pictures[f"{material['name']}/scene/studio_drawn"] = as_it_comes(path, effort)
        print(f"  {job['variant']}: {material['name']}", file=sys.stderr, flush=True)
    np.savez(job["output"], **pictures)


if __name__ == "__main__":
    main()
