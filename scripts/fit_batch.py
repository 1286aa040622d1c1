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
import shutil
import sys
import time
from pathlib import Path

import jax
import numpy as np
from safetensors import safe_open
from safetensors.numpy import load_file, save
from tqdm import tqdm

from nbrdf_jax import batch_fit, data, fitted_library, library, metrics, sample_sets, sources
from nbrdf_jax.batch_fit import Options
from nbrdf_jax.evaluation import of_network
from nbrdf_jax.fitted_library import Entry, Provenance, sha256, whole
from nbrdf_jax.invalid import InvalidFile, exit_code
from nbrdf_jax.places import Reflectance, walked
from nbrdf_jax.sample_sets import SampleSets
from nbrdf_jax.sources import Source
from nbrdf_jax.workers import each

SHARED = data.REPOSITORY / "nbrdf-core" / "assets" / "shared" / "library.safetensors"


def judged(reference: Reflectance, weights: np.ndarray) -> dict[str, float]:
    """How far a network is from what it was fitted to."""
    places = walked(True)
    f, g = (np.maximum(reflectance(places), 0) for reflectance in (reference, of_network(weights)))
    cosine = places.light[places.parts["rus32k"], 2]
    pairs, pictures = ([part(values, name) for values in (f, g)] for part, name in ((places.part, "rus32k"), (places.pixels, "studio")))
    return {
        "log_error": float(metrics.log_error(*pairs, cosine)),
        "relative_log": float(metrics.relative_log(*pairs, cosine)),
        "studio_psnr": float(metrics.psnr(*pictures)),
    }


def fitted(chunk: list[Source], start: np.ndarray, sets: SampleSets, options: Options, bar: tqdm, seconds: dict[str, float]) -> list[Entry]:
    """One chunk; `seconds` are added to, by what they were spent on."""
    begin = time.perf_counter()
    mesh = batch_fit.devices_mesh()
    # Every device takes as many: the last material stands in where there are too few.
    filled = chunk + [chunk[-1]] * (-len(chunk) % mesh.size)
    reflectances = [source.load() for source in chunk]
    targets = list(each(lambda f: sets.wanted(np.maximum(f(sets.places), 0)), reflectances))
    targets += [targets[-1]] * (len(filled) - len(chunk))
    wanted = tuple(np.stack([target[kind] for target in targets]) for kind in range(3))
    del targets
    ready = last = time.perf_counter()
    compiling = 0.0

    def told(steps: int) -> None:
        nonlocal last, compiling
        now = time.perf_counter()
        compiling, last = compiling + (now - last if steps == 0 else 0.0), now
        bar.update(steps * len(chunk))

    weights = batch_fit.fit(np.broadcast_to(start, (len(filled), len(start))), wanted, sets, options, mesh, told)[: len(chunk)].astype(np.float64)
    done = time.perf_counter()
    errors = list(each(lambda pair: judged(*pair), list(zip(reflectances, weights))))
    seconds["targets"] += ready - begin
    seconds["compile"] += compiling
    seconds["fit"] += done - ready - compiling
    seconds["judge"] += time.perf_counter() - done
    return [Entry(source.name, source.file, own, error) for source, own, error in zip(chunk, weights, errors)]


def job(given: list[Source], start: np.ndarray, arguments: argparse.Namespace) -> dict[str, object]:
    """What makes one run the same as another: parts of one are not taken for those of the other."""
    names = hashlib.sha256("\n".join(f"{source.name} {source.file}" for source in given).encode()).hexdigest()
    files = {path.name: sha256(path) for path in map(_file, arguments.sources)}
    own = {key: getattr(arguments, key) for key in ("steps", "sets", "seed", "chunk", "synthetic")}
    return {"names": names, "files": files, "start": hashlib.sha256(start.tobytes()).hexdigest(), **own}


def _file(path: Path) -> Path:
    return path / "library.safetensors" if path.is_dir() else path


def part_written(path: Path, entries: list[Entry]) -> None:
    """The networks of a chunk, their errors beside them."""
    whole(path, save({entry.name: entry.weights.astype(np.float32) for entry in entries}, metadata={"errors": json.dumps({entry.name: entry.error for entry in entries})}))


def part_read(path: Path, chunk: list[Source]) -> list[Entry]:
    """What `part_written` wrote."""
    with safe_open(path, framework="numpy") as file:
        errors = json.loads(file.metadata()["errors"])
    tensors = load_file(path)
    return [Entry(source.name, source.file, tensors[source.name].astype(np.float64), errors[source.name]) for source in chunk]


def run(arguments: argparse.Namespace) -> int:
    """Exit code."""
    given = sources.checked([source for path in arguments.sources for source in sources.of_path(path)] + sources.synthetic(arguments.synthetic, arguments.seed))
    start = library.shared_start(arguments.start)
    parts = arguments.output / ".fit_batch"
    parts.mkdir(parents=True, exist_ok=True)
    mine, known = job(given, start, arguments), parts / "job.json"
    if known.is_file() and json.loads(known.read_text()) != mine:
        raise InvalidFile(parts, "parts of this run", "those of another", f"finish that one, or remove {parts}")
    whole(known, json.dumps(mine).encode())
    options = Options(arguments.steps, seed=arguments.seed)
    sets = SampleSets.drawn(arguments.seed, arguments.sets or sample_sets.worth(arguments.steps))
    chunks = [given[first : first + arguments.chunk] for first in range(0, len(given), arguments.chunk)]
    entries, seconds = [], {"targets": 0.0, "compile": 0.0, "fit": 0.0, "judge": 0.0}
    with tqdm(total=len(given) * arguments.steps, desc="fitting", unit="step", unit_scale=True, leave=False, file=sys.stderr, disable=None) as bar:
        for place, chunk in enumerate(chunks):
            path = parts / f"chunk-{place:05}.safetensors"
            if path.is_file():
                bar.update(len(chunk) * arguments.steps)
            else:
                part_written(path, fitted(chunk, start, sets, options, bar, seconds))
            entries += part_read(path, chunk)
    lost = [entry.name for entry in entries if not np.isfinite(entry.weights).all()]
    if lost:
        print(f"error: {', '.join(lost[:5])}: did not stay finite; nothing was written", file=sys.stderr)
        return 1
    derived = [{"file": name, "sha256": digits, "source": "", "terms": ""} for name, digits in mine["files"].items()]
    command = f"scripts/fit_batch.py {' '.join(path.name for path in arguments.sources)} --synthetic {arguments.synthetic} --steps {arguments.steps} --seed {arguments.seed}"
    provenance = Provenance("Networks fitted from one shared start", command, arguments.seed, derived)
    fitted_library.write(arguments.output, start, entries, provenance, list(library.read(SHARED)))
    shutil.rmtree(parts)
    error = np.array([entry.error["log_error"] for entry in entries])
    summary = {
        "schema": 1, "materials": len(entries), "steps": arguments.steps, "sets": len(sets.factor), "devices": jax.device_count(), "platform": jax.devices()[0].platform,
        "seconds": seconds, "peak_bytes": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024, "log_error": {"mean": float(error.mean()), "median": float(np.median(error)), "max": float(error.max())},
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
    return exit_code(lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())
