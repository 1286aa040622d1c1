"""Linear algebra: systems, the rank of tables, connected charts."""

import numpy as np

from nbrdf_jax.coordinates import vectors_from_angles

from .materials import MATERIALS, parameters
from .text import document, printed, rounded


def charting() -> bytes:
    """The connection of eight local charts of a bent sheet, from the sum over pairs of charts itself (Brand 2002, equation 5)."""
    random = np.random.default_rng(15)
    points, charts, dim = 40, 8, 2
    flat = random.uniform(-1, 1, (points, dim))
    sheet = np.stack([flat[:, 0], flat[:, 1], 0.6 * flat[:, 0] ** 2 - 0.3 * flat[:, 0] * flat[:, 1]], axis=1)
    centres = sheet[:charts]
    axes = np.linalg.qr(random.normal(0, 0.2, (charts, 3, dim)) + np.eye(3)[:, :dim])[0]
    local = printed(np.einsum("knc,kca->kna", sheet - centres[:, None], axes))
    density = np.exp(-((sheet[:, None] - centres) ** 2).sum(2) / 0.5)
    weights = printed(density / density.sum(axis=1, keepdims=True))
    lifted = np.concatenate([local, np.ones((charts, points, 1))], axis=2)
    size = charts * (dim + 1)
    disagreement, agreement = np.zeros((size, size)), np.zeros((size, points))
    for i in range(points):
        for k in range(charts):
            agreement[k * (dim + 1) : (k + 1) * (dim + 1), i] = weights[i, k] * lifted[k, i]
            for j in range(k):
                difference = np.zeros(size)
                difference[k * (dim + 1) : (k + 1) * (dim + 1)] = lifted[k, i]
                difference[j * (dim + 1) : (j + 1) * (dim + 1)] = -lifted[j, i]
                disagreement += weights[i, k] * weights[i, j] * np.outer(difference, difference)
    variance = agreement @ (np.eye(points) - 1 / points) @ agreement.T
    total = disagreement + agreement @ agreement.T
    shares, maps = np.linalg.eig(np.linalg.solve(total, variance))
    best = np.argsort(-shares.real)[:dim]
    coordinates = (maps.real[:, best].T @ agreement).T
    coordinates *= np.sqrt(points) / np.linalg.norm(coordinates, axis=0)
    coordinates *= np.sign(coordinates[np.abs(coordinates).argmax(axis=0), range(dim)])
    about = "local coordinates [chart][point], weights [point][chart], share of variance agreed on, coordinates of unit variance whose largest number is positive"
    return document("charting", about, {"local": local, "weights": weights, "agreement": shares.real[best], "coordinates": coordinates})


def least_squares() -> bytes:
    """Systems from well posed to nearly singular: condition number, and plain and ridge answers."""
    random = np.random.default_rng(11)
    systems = []
    for rows, unknowns, falling in ((9, 4, 0.0), (30, 8, 0.5), (5, 7, 0.4)):
        # The k-th column all but repeats the mean of those before it, by 10 to the power −falling · k.
        columns = [random.normal(size=rows)]
        for k in range(1, unknowns):
            columns.append(np.mean(columns, axis=0) * (falling > 0) + 10.0 ** (-falling * k) * random.normal(size=rows))
        # Rounded first, so that whoever reads the file starts from the same numbers.
        matrix, right = np.array(rounded(np.stack(columns, axis=1))), np.array(rounded(random.normal(size=rows)))
        damping = 0.05
        ridge = np.linalg.solve(matrix.T @ matrix + damping * np.eye(unknowns), matrix.T @ right)
        plain = np.linalg.lstsq(matrix, right, rcond=None)[0]
        systems.append({"matrix": matrix, "right": right, "condition": float(np.linalg.cond(matrix)), "plain": plain, "damping": damping, "ridge": ridge})
    return document("least_squares", "min |matrix x - right|^2 + damping |x|^2; plain is the shortest answer without damping", {"systems": systems})


def rank() -> bytes:
    """Singular values of tables of 90 × 90 × 180 cells as matrices [90, 48600], by LAPACK's SVD; frames as in the Rust module `rank`."""
    middles = [(np.arange(n) + 0.5) / n for n in (90, 90, 180)]
    first, second, turn = (v.ravel() for v in np.meshgrid(*middles, indexing="ij"))
    zero = np.zeros_like(first)
    theta_i, theta_o = first * np.pi / 2, second * np.pi / 2
    frames = {
        "half_difference": vectors_from_angles(first**2 * np.pi / 2, zero, theta_o, turn * np.pi),
        "standard": tuple(
            np.stack((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)), axis=-1) for theta, phi in ((theta_i, zero), (theta_o, turn * np.pi))
        ),
    }
    rows = []
    for name in ("roughness_start", "metal_middle"):
        for frame, (light, view) in frames.items():
            weighted = MATERIALS[name](light, view) * np.maximum(light[:, 2:], 0.05)
            below = ((light[:, 2] <= 0) | (view[:, 2] <= 0)).reshape(90, -1)
            for values, stored in (("plain", weighted), ("log", np.log(weighted + 1e-3))):
                table = stored.reshape(90, -1, 3)
                for row in range(1, 90):
                    table[row, below[row]] = table[row - 1, below[row]]
                # Transposed: LAPACK takes columns, and copying rows into columns takes longer than the rest.
                found = np.linalg.svd(table.reshape(90, -1).T, compute_uv=False)
                shares = found / found.sum()
                effective = float(np.exp(-np.sum(shares[shares > 0] * np.log(shares[shares > 0]))))
                rows.append({"material": name, "frame": frame, "values": values, "effective_rank": effective, "normalised": found[:8] / found[0]})
    materials = {row["material"]: parameters(MATERIALS[row["material"]]) for row in rows}
    return document("rank", "a cell below the horizon repeats the one before it in its first angle", {"materials": materials, "rows": rows})
