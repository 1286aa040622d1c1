"""What published networks give, and the gradient of the fitting loss. NumPy in float64, derivatives by JAX."""

import jax
import jax.numpy as jnp
import numpy as np
from safetensors.numpy import save

from nbrdf_jax import data, library, objective
from nbrdf_jax.coordinates import network_inputs
from nbrdf_jax.directions import golden_directions, rus32k
from nbrdf_jax.network import reflectance


def forward() -> bytes:
    """f [1000, 3] of each published network at the light and view [1000, 3] stored beside them."""
    light, view = golden_directions()
    inputs = network_inputs(light.astype(np.float64), view.astype(np.float64))
    tensors = {"light": light, "view": view}
    for database in data.ARCHIVES:
        for name, weights in library.read(data.archive(database)).items():
            tensors[name] = reflectance(weights, inputs).astype(np.float32)
    # One metadata key only: the writer keeps no order among several.
    return save(tensors, metadata={"about": "f_r [1/sr] clamped at 0, float64 rounded to float32; made by scripts/make_golden.py forward"})


def gradient() -> bytes:
    """The fitting loss between two made-up networks and its gradient by JAX's reverse mode."""
    random = np.random.default_rng(7)
    counts = objective.Counts(37, 50, 9, 4)
    # Rounded first, so that whoever reads the file starts from the same numbers.
    own, other = (random.normal(0, 0.3, 675).astype(np.float32).astype(np.float64) for _ in range(2))
    light, view = (vectors[: counts.directions].astype(np.float32).astype(np.float64) for vectors in rus32k())
    factor = (light[:, 2] * random.uniform(0.5, 1.0, counts.directions)).astype(np.float32).astype(np.float64)
    inputs = network_inputs(light, view)
    wanted = objective.features(reflectance(other, inputs), factor, counts)
    # Compiled whole: one by one its operations take four times as long to compile.
    value, by_weight = jax.jit(jax.value_and_grad(objective.loss), static_argnums=4)(jnp.asarray(own), jnp.asarray(inputs), jnp.asarray(factor), tuple(map(jnp.asarray, wanted)), counts)
    tensors = {"own": own, "other": other, "light": light, "view": view, "factor": factor, "loss": np.array([float(value)]), "gradient": np.asarray(by_weight)}
    about = f"loss and gradient of 'own' against 'other', {counts}, float64 rounded to float32; made by scripts/make_golden.py gradient"
    return save({name: tensor.astype(np.float32) for name, tensor in tensors.items()}, metadata={"about": about})
