"""Independent second implementation of nbrdf, written from the papers and the measuring protocol.

Every numeric function asks its arguments which library they come from (`x.__array_namespace__()`), so the
same lines run in NumPy (golden numbers) and in JAX (batches, `vmap`, `jit`). All of it is float64, but for the fits of many
networks at once. Where the protocol leaves a choice open (where cells of a table lie, how a walk is bounded beyond its ends),
docs/conventions.md and the heads of the files say which one is shared.
"""

import jax

# Silent broadcasting and silent float32 are the two ways an oracle goes wrong without anyone noticing.
jax.config.update("jax_enable_x64", True)
jax.config.update("jax_numpy_rank_promotion", "raise")
jax.config.update("jax_numpy_dtype_promotion", "strict")
