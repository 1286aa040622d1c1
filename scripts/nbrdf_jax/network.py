"""The NBRDF (Sztrajman et al. 2021, doi 10.1111/cgf.14335, section 3): 6 → 21 → 21 → 3, relu, relu, exp(y) − 1.

One network is one flat vector, layer by layer: kernel (in, out) row-major, then bias: 126+21, 441+21, 63+3 = 675.
"""

from .arrays import Array, Inputs, Vectors, Weights

WIDTHS = (6, 21, 21, 3)
LARGEST = 80.0  # of y: far beyond what networks were fitted to, values stay finite also in float32


def size(widths: tuple[int, ...] = WIDTHS) -> int:
    """How many weights a network of these widths has."""
    return sum((rows + 1) * columns for rows, columns in zip(widths, widths[1:]))


def layers(weights: Weights, widths: tuple[int, ...] = WIDTHS) -> list[tuple[Array, Array]]:
    """weights [675] → (kernel [in, out], bias [out]) of each layer."""
    if weights.shape != (size(widths),):
        raise ValueError(f"a network {widths} has {size(widths)} weights, found an array of shape {weights.shape}")
    parts, start = [], 0
    for rows, columns in zip(widths, widths[1:]):
        middle, end = start + rows * columns, start + (rows + 1) * columns
        parts.append((weights[start:middle].reshape(rows, columns), weights[middle:end]))
        start = end
    return parts


def unclamped(weights: Weights, inputs: Inputs, widths: tuple[int, ...] = WIDTHS) -> Vectors:
    """weights [675], inputs [n, 6] → exp(y) − 1 [n, 3], which may dip below 0."""
    xp = inputs.__array_namespace__()
    *hidden, (kernel, bias) = layers(weights, widths)
    x = inputs
    for hidden_kernel, hidden_bias in hidden:
        x = xp.maximum(x @ hidden_kernel + hidden_bias[None, :], 0.0)
    return xp.expm1(xp.minimum(x @ kernel + bias[None, :], LARGEST))


def reflectance(weights: Weights, inputs: Inputs, widths: tuple[int, ...] = WIDTHS) -> Vectors:
    """weights [675], inputs [n, 6] → f_r [n, 3] in 1/sr, linear RGB, clamped at 0, never the cosine."""
    xp = inputs.__array_namespace__()
    return xp.maximum(unclamped(weights, inputs, widths), 0.0)
