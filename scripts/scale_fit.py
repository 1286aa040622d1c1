"""How `fit_batch.py` scales and how good it is: docs/fit_batch.json.

    python scripts/scale_fit.py

Scaling: 1, 10, 100 and 1000 made-up materials on one, two and four simulated devices (`--xla_force_host_platform_device_count`),
each in a process of its own: seconds for a step of a material (without compiling) and peak memory. Few steps on 256 sets, so that memory is that
of a fit of 4096 steps (four times as much from 16 384 on). Simulated devices share the machine's cores: they show that the work is split, not how fast it can be.
Quality: measured files are fitted by this and by `nbrdf fit`, as many steps each, and `nbrdf info --against` judges both.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from safetensors.numpy import load_file, save_file
from tqdm import tqdm

from nbrdf_jax import data, program
from nbrdf_jax.fitted_library import whole
from nbrdf_jax.invalid import InvalidFile

SCRIPT = Path(__file__).with_name("fit_batch.py")
OUTPUT = data.REPOSITORY / "docs" / "fit_batch.json"
COUNTS, DEVICES = (1, 10, 100, 1000), (1, 2, 4)
SCALING_STEPS, SETS = 100, 256
KEYS = ("log_error", "relative_log", "studio_psnr", "studio_flip")


def fit(arguments: list[str], devices: int) -> dict:
    """Runs `fit_batch.py` in a process of its own → its report."""
    flags = f"--xla_force_host_platform_device_count={devices} --xla_cpu_multi_thread_eigen=false"
    done = subprocess.run([sys.executable, str(SCRIPT), *arguments, "--json"], env=os.environ | {"XLA_FLAGS": flags, "JAX_PLATFORMS": "cpu"}, capture_output=True)
    if done.returncode:
        raise InvalidFile(f"{SCRIPT} {' '.join(arguments)}", "exit code 0", f"{done.returncode}: {done.stderr.decode(errors='replace')[-400:]}")
    return json.loads(done.stdout)


def scaling(counts: tuple[int, ...]) -> list[dict]:
    """A row for every number of materials and devices."""
    rows = []
    for devices, count in tqdm([(devices, count) for devices in DEVICES for count in counts], desc="scaling", file=sys.stderr, disable=None):
        with tempfile.TemporaryDirectory() as folder:
            found = fit(["--synthetic", str(count), "--steps", str(SCALING_STEPS), "--sets", str(SETS), "-o", folder], devices)
        seconds = found["seconds"]
        rows.append({
            "devices": devices, "materials": count, "step_of_material_s": seconds["fit"] / count / SCALING_STEPS, "peak_mb": round(found["peak_bytes"] / 1e6),
            **{f"{what}_per_material_s": spent / count for what, spent in seconds.items()},
        })  # fmt: skip
    return rows


def quality(binary: Path, steps: int) -> list[dict]:
    """A row for every measured file and program."""
    files = sorted((data.folder() / "rgl_measured").glob("*.bsdf"))
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        fit([*map(str, files), "--steps", str(steps), "-o", str(folder / "library")], os.cpu_count() or 1)
        tensors = load_file(folder / "library" / "library.safetensors")
        for path in tqdm(files, desc="nbrdf fit", file=sys.stderr, disable=None):
            material = "rgl/" + path.stem.removesuffix("_rgb")
            own, other = folder / "own.safetensors", folder / "other.safetensors"
            save_file({"weights": tensors[material]}, own, metadata={"hidden": "21,21"})
            program.report(binary, ["fit", str(path), "--steps", str(steps), "-o", str(other)], folder / "fit.json")
            for label, network in (("fit_batch.py", own), ("nbrdf fit", other)):
                program.report(binary, ["info", str(path), "--against", str(network)], folder / "info.json")
                against = json.loads((folder / "info.json").read_text())["against"]["figures"]
                rows.append({"material": material, "by": label, **{key: against[key] for key in KEYS if key in against}})
    return rows


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", type=Path, default=program.BUILT)
    parser.add_argument("--steps", type=int, default=30_000, help="of the fits whose quality is compared (default: %(default)s)")
    parser.add_argument("--most", type=int, default=COUNTS[-1], metavar="N", help="no more materials than these (default: %(default)s)")
    parser.add_argument("-o", "--output", type=Path, default=OUTPUT)
    arguments = parser.parse_args()
    try:
        content = {
            "schema": 1, "command": "python scripts/scale_fit.py", "cores": os.cpu_count(), "scaling_steps": SCALING_STEPS, "sets": SETS,
            "scaling": scaling(tuple(count for count in COUNTS if count <= arguments.most)), "quality_steps": arguments.steps, "quality": quality(arguments.binary, arguments.steps),
        }  # fmt: skip
    except InvalidFile as error:
        print(f"error: {error}", file=sys.stderr)
        return 3
    whole(arguments.output, (json.dumps(content, indent=1) + "\n").encode())
    print(arguments.output)
    return 0


if __name__ == "__main__":
    sys.exit(main())
