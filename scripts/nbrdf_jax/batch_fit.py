"""Fits many networks at once, each to its own material, all on the same directions.

Adam 3e-3 falling along a cosine; the loss is `objective.loss` with a pull towards the start. Materials are spread over all
devices (`jax.sharding`); a device takes a few at a time through a block of steps, on a processor so few that all stay in
its cache. No material's result depends on its neighbours.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial

import jax
import jax.numpy as jnp
import numpy as np
from jax.sharding import Mesh, NamedSharding, PartitionSpec
from jaxtyping import Float

from .network import WIDTHS, size
from .objective import Counts, loss
from .sample_sets import SampleSets

BLOCK = 500  # steps between two looks at the clock
TOGETHER = {"cpu": 1}  # materials of a device at a time; elsewhere all that it has
CLIP = 10.0  # of a gradient's length
FIRST, SECOND, TINY = 0.9, 0.999, 1e-8  # of Adam (Kingma and Ba 2015)

State = tuple[jax.Array, jax.Array, jax.Array]  # weights, first and second moments [m, 675]


@dataclass(frozen=True)
class Options:
    """How long and how carefully; `proximity` is the weight of ½‖w − start‖²."""

    steps: int = 30_000
    rate: float = 3e-3
    proximity: float = 1e-5
    seed: int = 0


def devices_mesh() -> Mesh:
    """All devices in a row."""
    return jax.make_mesh((jax.device_count(),), ("materials",), axis_types=(jax.sharding.AxisType.Auto,))


def fit(starts: Float[np.ndarray, "m w"], wanted: tuple[np.ndarray, ...], sets: SampleSets, options: Options, mesh: Mesh, progress: Callable[[int], object]) -> Float[np.ndarray, "m w"]:
    """starts [m, 675], wanted features [m, s, …] of `SampleSets.wanted` → weights [m, 675]; m is a multiple of the devices.

    `progress` is told how many steps have been taken: none when a block is ready to begin, compiled where it was not yet.
    """
    split, whole = _shardings(mesh)
    put = lambda array, sharding: jax.device_put(np.asarray(array, np.float32), sharding)
    state = put(starts, split), put(np.zeros_like(starts), split), put(np.zeros_like(starts), split)
    targets = put(starts, split), *(put(kind, split) for kind in wanted)
    shared = put(sets.inputs, whole), put(sets.factor, whole)
    order = np.random.default_rng((options.seed, 2)).integers(0, len(sets.factor), options.steps).astype(np.int32)
    for first in range(0, options.steps, BLOCK):
        picked, number = jax.device_put(order[first : first + BLOCK], whole), jax.device_put(np.int32(first), whole)
        block = _compiled(mesh, sets.counts, options, len(picked), len(starts), len(sets.factor))
        progress(0)
        state = block(state, targets, shared, picked, number)
        state[0].block_until_ready()
        progress(len(picked))
    return np.asarray(state[0])


def random_start(seed: int, index: int) -> Float[np.ndarray, "w"]:  # noqa: F821
    """Glorot and Bengio (2010): uniform within √(6 / (inputs + outputs)), biases 0."""
    random, parts = np.random.default_rng((seed, 4, index)), []
    for rows, columns in zip(WIDTHS, WIDTHS[1:]):
        limit = np.sqrt(6 / (rows + columns))
        parts += [random.uniform(-limit, limit, rows * columns), np.zeros(columns)]
    return np.concatenate(parts)


def _shardings(mesh: Mesh) -> tuple[NamedSharding, NamedSharding]:
    """Of what belongs to a material, and of what all share."""
    return NamedSharding(mesh, PartitionSpec("materials")), NamedSharding(mesh, PartitionSpec())


@cache
def _compiled(mesh: Mesh, counts: Counts, options: Options, steps: int, materials: int, sets: int) -> jax.stages.Compiled:
    """A block of so many steps; compiled once for all chunks of one size."""
    split, whole = _shardings(mesh)

    def shape(sharding: NamedSharding, *sizes: int, kind: type = np.float32) -> jax.ShapeDtypeStruct:
        return jax.ShapeDtypeStruct(sizes, kind, sharding=sharding)

    weights = shape(split, materials, size())
    targets = weights, *(shape(split, materials, sets, count, 3) for count in (counts.log, counts.relative, counts.pixels))
    shared = shape(whole, sets, counts.directions, WIDTHS[0]), shape(whole, sets, counts.directions)
    numbers = shape(whole, steps, kind=np.int32), shape(whole, kind=np.int32)
    return _block(mesh, counts, options).lower((weights,) * 3, targets, shared, *numbers).compile()


def _block(mesh: Mesh, counts: Counts, options: Options) -> jax.stages.Wrapped:
    """A block of steps of all materials, to be compiled."""
    split, whole = PartitionSpec("materials"), PartitionSpec()

    def block(state: State, targets: tuple[jax.Array, ...], shared: tuple[jax.Array, ...], picked: jax.Array, first: jax.Array) -> State:
        def one(material: tuple[State, tuple[jax.Array, ...]]) -> State:
            own, wanted = material
            step = partial(_step, targets=wanted, shared=shared, counts=counts, options=options)
            return jax.lax.scan(step, own, (picked, first + jnp.arange(len(picked), dtype=jnp.int32)))[0]

        together = TOGETHER.get(mesh.devices.flat[0].platform) or len(state[0])
        return jax.lax.map(one, (state, targets), batch_size=min(together, len(state[0])))

    spread = jax.shard_map(block, mesh=mesh, in_specs=(split, split, whole, whole, whole), out_specs=split, check_vma=False)
    return jax.jit(spread, donate_argnums=0)


def _step(state: State, at: tuple[jax.Array, jax.Array], targets: tuple[jax.Array, ...], shared: tuple[jax.Array, ...], counts: Counts, options: Options) -> tuple[State, None]:
    """One step of Adam of one material; `targets` are its start and its features."""
    weights, mean, square = state
    (place, index), (inputs, factor), (start, *wanted) = at, shared, targets
    slope = jax.grad(lambda own: loss(own, inputs[place], factor[place], tuple(kind[place] for kind in wanted), counts))(weights)
    slope = slope + options.proximity * (weights - start)
    length = jnp.sqrt(jnp.sum(slope * slope))
    # What is not finite is passed over: one wild step must not take the material with it.
    slope = jnp.where(jnp.isfinite(length), slope * jnp.minimum(1.0, CLIP / (length + TINY)), 0.0)
    mean, square = mean + (1 - FIRST) * (slope - mean), square + (1 - SECOND) * (slope * slope - square)
    done = index.astype(jnp.float32)
    rate = 0.5 * options.rate * (1 + jnp.cos(jnp.pi * done / options.steps))
    scale = jnp.sqrt(square / (1 - SECOND ** (done + 1))) + TINY
    return (weights - rate * mean / (1 - FIRST ** (done + 1)) / scale, mean, square), None
