"""How `fit_batch.py` scales and how good it is: docs/fit_batch.json, of which `make_fit_batch.py` makes a page.

    python scripts/scale_fit.py [scaling] [quality]      (default: both; what is not measured stays as it is recorded)

Scaling: 1, 10, 100 and 1000 made-up materials on one, two and four simulated devices (`--xla_force_host_platform_device_count`),
each in a process of its own, to be run where nothing else does: seconds for a step of a material, by the clock and of processor time, are
the median over blocks of steps; compiling is told apart; beside them stand the machine's load before each run and the cores that others
took meanwhile, which the clock suffers from and processor time hardly. 256 sets, so that memory is that of a fit of 4096 steps (four times as much from 16 384 on). Simulated devices share the machine's cores: they show
that the work is split, not how fast it can be.
Quality: the same files by `fit_batch.py` and by `nbrdf fit`, as many steps and several seeds each (`nbrdf_jax/fit_quality.py`).
Exit codes: 0 done, 2 usage, 3 a file or the program is missing or invalid.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from tqdm import tqdm

from nbrdf_jax import data, fit_quality, program
from nbrdf_jax.fitted_library import whole
from nbrdf_jax.invalid import InvalidFile, exit_code
from nbrdf_jax.other_load import OtherLoad

SCRIPT = Path(__file__).with_name("fit_batch.py")
OUTPUT = data.REPOSITORY / "docs" / "fit_batch.json"
DEVICES, SETS = (1, 2, 4), 256
STEPS = {1: 4000, 10: 4000, 100: 1500, 1000: 500}  # by materials: at least three blocks of steps in all chunks
DEFAULTS = {"most": max(STEPS), "steps": 30_000, "seeds": 6}
PARTS = ("scaling", "quality")


def fit(arguments: list[str], devices: int) -> dict:
    """Runs `fit_batch.py` in a process of its own → its report, and the seconds of all of it."""
    flags = f"--xla_force_host_platform_device_count={devices} --xla_cpu_multi_thread_eigen=false"
    begin = time.perf_counter()
    done = subprocess.run([sys.executable, str(SCRIPT), *arguments, "--json"], env=os.environ | {"XLA_FLAGS": flags, "JAX_PLATFORMS": "cpu"}, capture_output=True)
    if done.returncode:
        raise InvalidFile(f"{SCRIPT} {' '.join(arguments)}", "exit code 0", f"{done.returncode}: {done.stderr.decode(errors='replace')[-400:]}")
    return json.loads(done.stdout) | {"whole_s": time.perf_counter() - begin}


def scaling(most: int) -> dict:
    """A row for every number of materials and devices."""
    rows = []
    for devices, count in tqdm([(devices, count) for devices in DEVICES for count in STEPS if count <= most], desc="scaling", file=sys.stderr, disable=None):
        with tempfile.TemporaryDirectory() as folder, OtherLoad() as other:
            found = fit(["--synthetic", str(count), "--steps", str(STEPS[count]), "--sets", str(SETS), "-o", folder], devices)
        (clock, processor), seconds = found["step_of_material_s"].values(), found["seconds"]
        rows.append({
            "devices": devices, "materials": count, "steps": STEPS[count], "load_before": other.before, "others_cores": other.cores, "blocks": len(clock), "step_of_material_s": statistics.median(clock),
            "slowest_block_s": max(clock), "processor_s": statistics.median(processor), "compile_s": seconds["compile"], "whole_s": found["whole_s"], "peak_mb": found["peak_bytes"] / 1e6,
            **{f"{what}_per_material_s": seconds[what] / count for what in ("targets", "judge")},
        })  # fmt: skip
    return {"command": "python scripts/scale_fit.py scaling" + _unless("most", most), "cores": os.cpu_count(), "sets": SETS, "rows": rows}


def quality(binary: Path, steps: int, seeds: int) -> dict:
    """Both programs with every seed."""
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sources = fit_quality.files(binary, folder)
        for seed in tqdm(range(seeds), desc="quality", unit="seed", file=sys.stderr, disable=None):
            own = folder / str(seed)
            own.mkdir()
            rows += fit_quality.fits(binary, sources, own, seed, steps, lambda arguments: fit(arguments, os.cpu_count() or 1))
    return {"command": "python scripts/scale_fit.py quality" + _unless("steps", steps) + _unless("seeds", seeds), "steps": steps, "seeds": seeds, **fit_quality.compared(rows), "fits": rows}


def _unless(key: str, value: int) -> str:
    """The option, where it is not the default."""
    return "" if value == DEFAULTS[key] else f" --{key} {value}"


def run(arguments: argparse.Namespace) -> int:
    """Exit code."""
    parts = {"scaling": lambda: scaling(arguments.most), "quality": lambda: quality(arguments.binary, arguments.steps, arguments.seeds)}
    wanted = arguments.parts or PARTS
    if "quality" in wanted:
        program.required(arguments.binary)
    for part in wanted:
        measured = parts[part]()
        # Each as soon as it is there: the other takes minutes, and may fail.
        kept = json.loads(arguments.output.read_text()) if arguments.output.is_file() else {}
        content = {"schema": 2} | {other: kept.get(other) for other in PARTS} | {part: measured}
        whole(arguments.output, (json.dumps(content, indent=1) + "\n").encode())
    print(arguments.output)
    return 0


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", metavar="PART", help="scaling, quality (default: both)")
    parser.add_argument("--binary", type=Path, default=program.BUILT)
    parser.add_argument("--steps", type=int, default=DEFAULTS["steps"], help="of the fits whose quality is compared (default: %(default)s)")
    parser.add_argument("--seeds", type=int, default=DEFAULTS["seeds"], help="of the fits whose quality is compared, at least two (default: %(default)s)")
    parser.add_argument("--most", type=int, default=DEFAULTS["most"], metavar="N", help="no more materials than these where scaling is measured (default: %(default)s)")
    parser.add_argument("-o", "--output", type=Path, default=OUTPUT)
    arguments = parser.parse_args(argv)
    if unknown := [part for part in arguments.parts if part not in PARTS]:
        parser.error(f"{unknown[0]}: expected {' or '.join(PARTS)}")
    if arguments.seeds < 2 or min(arguments.steps, arguments.most) < 1:
        parser.error("--seeds is at least 2, --steps and --most at least 1")
    return exit_code(lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())
