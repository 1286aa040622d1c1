"""`fit_batch.py` against `nbrdf fit`: the same files, as many steps, several seeds each; `nbrdf info --against` judges both.

Files are the measured tables at hand, and tables that `nbrdf export` writes of published networks which nothing learned leaves
out: both programs read them. Choices that concern fitting are made on those that are not held out.
"""

import json
import os
from collections import defaultdict
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from safetensors.numpy import load_file, save_file

from . import data, library, program, split
from .fitted_library import networks_metadata
from .spread import is_higher_better
from .two_samples import TwoSamples, overall_difference, overall_ratio, overall_spread

# Mirrors, paints, plastics, fabrics, stone.
TABLES = {"merl": ("brass", "blue-fabric", "gold-paint", "green-acrylic", "pvc", "white-marble"), "rgl": ("rgl/satin_gold", "rgl/vch_golden_yellow")}
KEYS = ("log_error", "relative_log", "studio_psnr", "studio_flip")
PROGRAMS = ("fit_batch.py", "nbrdf fit")


def files(binary: Path, folder: Path) -> list[Path]:
    """What is fitted: measured tables, then tables of networks, which are written into the folder."""
    measured = sorted((data.folder() / "rgl_measured").glob("*.bsdf"))
    for database, names in TABLES.items():
        for name in names:
            stem = f"{name.removeprefix('rgl/')}_rgb" if database == "rgl" else name
            program.report(binary, ["export", name, "--library", str(data.archive(database)), "--to", "bsdf", "-o", str(folder / stem)])
    return measured + sorted(folder.glob("*.bsdf"))


def fits(binary: Path, sources: Sequence[Path], folder: Path, seed: int, steps: int, batch: Callable[[list[str]], object]) -> list[dict]:
    """Figures of all files by both programs with one seed; `batch` runs `fit_batch.py` with these arguments."""
    batch([*map(str, sources), "--steps", str(steps), "--seed", str(seed), "-o", str(folder / "library")])
    tensors = load_file(folder / "library" / "library.safetensors")

    def both(source: Path) -> list[dict]:
        name = library.name_of(source.stem)
        networks = dict(zip(PROGRAMS, (folder / f"{source.stem}-{which}.safetensors" for which in ("first", "second"))))
        save_file({"weights": tensors[name]}, networks[PROGRAMS[0]], metadata=networks_metadata())
        fit = ["fit", str(source), "--steps", str(steps), "--seed", str(seed), "--threads", "1", "-o", str(networks[PROGRAMS[1]])]
        program.report(binary, fit)
        return [{"material": name, "by": by, "seed": seed, **_figures(binary, source, network)} for by, network in networks.items()]

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return [row for rows in pool.map(both, sources) for row in rows]


def compared(rows: Sequence[dict]) -> dict[str, object]:
    """Every material's figures by both programs over seeds; over all materials the ratio of errors, of their spread, and the difference of PSNR."""
    found: dict[str, dict[str, dict[str, list[float]]]] = defaultdict(lambda: {key: {by: [] for by in PROGRAMS} for key in KEYS})
    for row in rows:
        for key in KEYS:
            found[row["material"]][key][row["by"]].append(row[key])
    standard = [name for database in data.ARCHIVES for name in library.read(data.archive(database))]
    held_out = {name for database in data.ARCHIVES for name in split.held_out(standard, database)}
    pairs = {name: {key: TwoSamples(*(by[key][label] for label in PROGRAMS), is_higher_better(key)) for key in KEYS} for name, by in found.items()}
    materials = [{"material": name, "held_out": name in held_out, **{key: pair.row() for key, pair in own.items()}} for name, own in pairs.items()]
    overall = {key: (overall_difference if is_higher_better(key) else overall_ratio)([own[key] for own in pairs.values()]) for key in KEYS}
    overall["log_error_spread"] = overall_spread([own["log_error"] for own in pairs.values()])
    return {"first": PROGRAMS[0], "second": PROGRAMS[1], "materials": materials, "overall": overall}


def _figures(binary: Path, source: Path, network: Path) -> dict[str, float]:
    against = json.loads(program.report(binary, ["info", str(source), "--against", str(network)]))["against"]["figures"]
    return {key: against[key] for key in KEYS}
