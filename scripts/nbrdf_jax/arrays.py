"""Types of arrays: NumPy (golden numbers) or JAX (batches), always float64. The tests check every shape that is written here.

One letter is one length: n pairs of directions, p pixels, m materials, w weights, k numbers of a code.
"""

import jax
import numpy as np
from jaxtyping import Bool, Float

Array = jax.Array | np.ndarray

Scalar = Float[Array, ""]
Numbers = Float[Array, "n"]  # noqa: F821
Vectors = Float[Array, "n 3"]
Inputs = Float[Array, "n 6"]
Pixels = Float[Array, "p 3"]
Picture = Float[np.ndarray, "height width 3"]
Covered = Bool[np.ndarray, "height width"]
Weights = Float[Array, "w"]  # noqa: F821
Code = Float[Array, "k"]  # noqa: F821
