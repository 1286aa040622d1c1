"""Fits thousands of networks at once, from one shared start, and writes a library that `nbrdf` reads.

    python scripts/fit_batch.py merl_nbrdf.zip paint.binary paper_white_rgb.bsdf -o library
    python scripts/fit_batch.py --synthetic 1000 -o library
    nbrdf list --library library

Runs on all devices that JAX finds, without change. Materials are fitted in chunks; a run that was stopped goes on where it
was when the same command is given again.
Exit codes: 0 done, 1 a fit did not stay finite, 2 usage, 3 a file is missing or invalid.
"""

import argparse
import hashlib
import json
import resource
import shlex
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import jax
import numpy as np
from tqdm import tqdm

from nbrdf_jax import batch_fit, data, fitted_library, library, metrics, origins, sample_sets, sources
from nbrdf_jax.batch_fit import Options
from nbrdf_jax.evaluation import of_network
from nbrdf_jax.fit_parts import FitParts
from nbrdf_jax.fitted_library import Entry, Provenance
from nbrdf_jax.invalid import InvalidFile, exit_code
from nbrdf_jax.places import Places, Reflectance, walked
from nbrdf_jax.sample_sets import SampleSets
from nbrdf_jax.sources import Source
from nbrdf_jax.workers import each

SHARED = data.REPOSITORY / "nbrdf-core" / "assets" / "shared" / "library.safetensors"


def judged(reference: Reflectance, weights: np.ndarray, places: Places) -> dict[str, float]:
    """How far a network is from what it was fitted to, at the places of a walk between the ends."""
    f, g = (np.maximum(reflectance(places), 0) for reflectance in (reference, of_network(weights)))
    cosine = places.light[places.parts["rus32k"], 2]
    pairs, pictures = ([part(values, name) for values in (f, g)] for part, name in ((places.part, "rus32k"), (places.pixels, "studio")))
    return {
        "log_error": float(metrics.log_error(*pairs, cosine)),
        "relative_log": float(metrics.relative_log(*pairs, cosine)),
        "studio_psnr": float(metrics.psnr(*pictures)),
    }


@dataclass
class Spent:
    """Seconds by what they were spent on, and of every block of steps the seconds for a step of a material, by the clock and of processor time."""

    seconds: dict[str, float] = field(default_factory=lambda: dict.fromkeys(("targets", "compile", "fit", "judge"), 0.0))
    steps: dict[str, list[float]] = field(default_factory=lambda: {"clock": [], "processor": []})


def fitted(chunk: list[Source], start: np.ndarray, sets: SampleSets, options: Options, bar: tqdm, spent: Spent) -> list[Entry]:
    """One chunk; what was spent on it is added to `spent`."""
    begin = time.perf_counter()
    mesh = batch_fit.devices_mesh()
    # Every device takes as many: the last material stands in where there are too few.
    filled = chunk + [chunk[-1]] * (-len(chunk) % mesh.size)
    reflectances = [source.load() for source in chunk]
    targets = list(each(lambda f: sets.wanted(np.maximum(f(sets.places), 0)), reflectances))
    targets += [targets[-1]] * (len(filled) - len(chunk))
    wanted = tuple(np.stack([target[kind] for target in targets]) for kind in range(3))
    del targets
    ready = time.perf_counter()
    last, compiling = (ready, time.process_time()), 0.0

    def told(steps: int) -> None:
        nonlocal last, compiling
        now = time.perf_counter(), time.process_time()
        passed = [after - before for before, after in zip(last, now)]
        if steps == 0:
            compiling += passed[0]
        else:
            for kind, seconds in zip(spent.steps.values(), passed):
                kind.append(seconds / steps / len(chunk))
        last = now
        bar.update(steps * len(chunk))

    weights = batch_fit.fit(np.broadcast_to(start, (len(filled), len(start))), wanted, sets, options, mesh, told)[: len(chunk)].astype(np.float64)
    done = time.perf_counter()
    places = walked(True)  # here, or every thread would make them for itself
    errors = list(each(lambda pair: judged(*pair, places), list(zip(reflectances, weights))))
    for what, seconds in (("targets", ready - begin), ("compile", compiling), ("fit", done - ready - compiling), ("judge", time.perf_counter() - done)):
        spent.seconds[what] += seconds
    return [Entry(source.name, source.file, own, error) for source, own, error in zip(chunk, weights, errors)]


def job(given: list[Source], files: dict[str, str], start: np.ndarray, arguments: argparse.Namespace) -> dict[str, object]:
    """What makes one run the same as another; `files` have their checksums by name."""
    names = hashlib.sha256("\n".join(f"{source.name} {source.file}" for source in given).encode()).hexdigest()
    own = {key: getattr(arguments, key) for key in ("steps", "sets", "seed", "chunk", "synthetic")}
    return {"names": names, "files": files, "start": hashlib.sha256(start.tobytes()).hexdigest(), **own}


def provenance(called: dict[Path, str], paths: list[Path], begun: Path, arguments: argparse.Namespace) -> Provenance:
    """The command with all that changes its result, and what every file that was read is from."""
    command = ["scripts/fit_batch.py", *(called[path] for path in paths)]
    command += ["--synthetic", str(arguments.synthetic)] if arguments.synthetic else []
    command += ["--start", called[begun]] if arguments.start != SHARED else []
    for key in ("steps", "sets", "chunk", "seed"):
        command += [f"--{key}", str(getattr(arguments, key))]
    rows = [row for path in dict.fromkeys([*paths, begun]) for row in origins.derived(path, called[path])]
    return Provenance("Networks fitted from one shared start", shlex.join(command), arguments.seed, [row for place, row in enumerate(rows) if row not in rows[:place]])


def run(arguments: argparse.Namespace) -> int:
    """Exit code."""
    paths, begun = [sources.file_of(path).absolute() for path in arguments.sources], sources.file_of(arguments.start).absolute()
    called = origins.told_apart([*paths, begun])
    given = sources.checked([source for path in paths for source in sources.of_file(path, called[path])] + sources.synthetic(arguments.synthetic, arguments.seed))
    if len(given) > fitted_library.MOST:
        raise InvalidFile(arguments.output, f"at most {fitted_library.MOST} materials in a library", str(len(given)), "several libraries")
    start = library.shared_start(begun)
    # Before anything is fitted: files that cannot be read are found here.
    made = provenance(called, paths, begun, arguments)
    parts = FitParts(arguments.output, job(given, {called[path]: origins.sha256(path) for path in paths}, start, arguments))
    options = Options(arguments.steps, seed=arguments.seed)
    sets = SampleSets.drawn(arguments.seed, arguments.sets)
    chunks = [given[first : first + arguments.chunk] for first in range(0, len(given), arguments.chunk)]
    entries, spent = [], Spent()
    with tqdm(total=len(given) * arguments.steps, desc="fitting", unit="step", unit_scale=True, leave=False, file=sys.stderr, disable=None) as bar:
        for place, chunk in enumerate(chunks):
            if parts.path(place).is_file():
                bar.update(len(chunk) * arguments.steps)
            else:
                parts.written(place, fitted(chunk, start, sets, options, bar, spent))
            entries += parts.read(place, chunk)
    lost = [entry.name for entry in entries if not np.isfinite(entry.weights).all()]
    if lost:
        print(f"error: {', '.join(lost[:5])}: did not stay finite; nothing was written", file=sys.stderr)
        return 1
    fitted_library.write(arguments.output, start, entries, made, list(library.read(SHARED)))
    parts.remove()
    error = np.array([entry.error["log_error"] for entry in entries])
    summary = {
        "schema": 1, "materials": len(entries), "steps": arguments.steps, "sets": len(sets.factor), "devices": jax.device_count(), "platform": jax.devices()[0].platform,
        "seconds": spent.seconds, "step_of_material_s": spent.steps, "peak_bytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024, "log_error": {"mean": float(error.mean()), "median": float(np.median(error)), "max": float(error.max())},
    }  # fmt: skip
    print(json.dumps(summary) if arguments.json else f"{len(entries)} materials in {arguments.output}, log_error {error.mean():.4f} on average, {error.max():.4f} at most")
    return 0


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", type=Path, nargs="*", metavar="SRC", help="libraries (.zip, .safetensors, folders), MERL .binary, RGL .bsdf")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FOLDER", help="folder of the library")
    parser.add_argument("--synthetic", type=int, default=0, metavar="N", help="N made-up materials besides")
    parser.add_argument("--start", type=Path, default=SHARED, metavar="SAFETENSORS", help="library whose shared start is begun with (default: the built-in one)")
    parser.add_argument("--steps", type=int, default=Options.steps, help="of each fit (default: %(default)s)")
    parser.add_argument("--sets", type=int, default=0, help="sets of directions (default: one for every 16 steps, 1024 at most)")
    parser.add_argument("--chunk", type=int, default=128, help="materials fitted at once: 5 MB each at 1024 sets (default: %(default)s)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true", help="print what was done as JSON")
    arguments = parser.parse_args(argv)
    if not arguments.sources and not arguments.synthetic:
        parser.error("give a source, or --synthetic N")
    if min(arguments.steps, arguments.chunk) < 1 or min(arguments.synthetic, arguments.sets, arguments.seed) < 0:
        parser.error("--steps and --chunk are at least 1, --synthetic, --sets and --seed at least 0")
    arguments.sets = arguments.sets or sample_sets.worth(arguments.steps)
    return exit_code(lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())
