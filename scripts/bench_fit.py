"""How fast one NBRDF is fitted: `nbrdf speed` beside the same steps in jitted JAX, one thread each.

    python scripts/bench_fit.py [--nbrdf target/release/nbrdf] [--steps 4000]

The same counts of samples, loss, Adam and learning rate; float32. JAX finds its samples and targets prepared and is timed
without compilation; nbrdf draws its own. Prints JSON.
"""

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path

# One thread, before JAX is loaded.
os.environ["XLA_FLAGS"] = os.environ.get("XLA_FLAGS", "") + " --xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})

import jax
import jax.numpy as jnp
import numpy as np

from nbrdf_jax.coordinates import network_inputs, vectors_from_angles
from nbrdf_jax.network import reflectance
from nbrdf_jax.objective import STEP, features, loss

SETS, RATE = 256, 3e-3


def samples(random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Network inputs [512, 6] and factors [512] of one set, uniform in the Rusinkiewicz angles."""
    angles = random.uniform(0, 1, (4 * STEP.directions, 3)) * (np.pi / 2, np.pi / 2, 2 * np.pi)
    light, view = vectors_from_angles(angles[:, 0], np.zeros(len(angles)), angles[:, 1], angles[:, 2])
    above = np.flatnonzero((light[:, 2] > 0) & (view[:, 2] > 0))[: STEP.directions]
    return network_inputs(light[above], view[above]), light[above, 2]


def fit(steps: int) -> float:
    """Seconds per step of a compiled fit of one made-up network to another."""
    random = np.random.default_rng(0)
    sets = [samples(random) for _ in range(SETS)]
    start, target = (random.normal(0, 0.3, 675).astype(np.float32) for _ in range(2))
    wanted = [features(reflectance(target.astype(np.float64), inputs), factor, STEP) for inputs, factor in sets]
    single = lambda arrays: jnp.asarray(np.stack(arrays), dtype=jnp.float32)
    inputs, factors = single([s[0] for s in sets]), single([s[1] for s in sets])
    targets = tuple(single([w[kind] for w in wanted]) for kind in range(3))
    order = jnp.asarray(random.integers(0, SETS, steps))
    gradient = jax.grad(lambda weights, i: loss(weights, inputs[i], factors[i], tuple(t[i] for t in targets), STEP))

    def step(state, at):
        weights, mean, square = state
        index, i = at
        g = gradient(weights, i)
        mean, square = mean + 0.1 * (g - mean), square + 0.001 * (g * g - square)
        count = (index + 1).astype(jnp.float32)
        rate = 0.5 * RATE * (1 + jnp.cos(jnp.pi * index.astype(jnp.float32) / steps))
        size = jnp.sqrt(square / (1 - 0.999**count)) + 1e-8
        return (weights - rate * mean / (1 - 0.9**count) / size, mean, square), None

    run = jax.jit(lambda weights: jax.lax.scan(step, (weights, jnp.zeros_like(weights), jnp.zeros_like(weights)), (jnp.arange(steps), order))[0][0])
    weights = jnp.asarray(start)
    fitted = run(weights).block_until_ready()
    if not np.isfinite(np.asarray(fitted)).all():
        raise FloatingPointError("the fit diverged")
    times = []
    for _ in range(5):
        begin = time.perf_counter()
        run(weights).block_until_ready()
        times.append(time.perf_counter() - begin)
    return float(np.median(times)) / steps


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--nbrdf", type=Path, default=Path(__file__).resolve().parents[1] / "target/release/nbrdf")
    parser.add_argument("--steps", type=int, default=4000)
    arguments = parser.parse_args()
    if not arguments.nbrdf.is_file():
        print(f"error: {arguments.nbrdf}: no such program; build it with `cargo build --release`", file=sys.stderr)
        return 3
    report = json.loads(subprocess.run([arguments.nbrdf, "speed", "--json", "--quiet"], check=True, capture_output=True).stdout)
    own, other = report["fit"]["step_s"], fit(arguments.steps)
    print(json.dumps({"schema": 1, "nbrdf_step_s": own, "jax_step_s": other, "times_faster": other / own}, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
