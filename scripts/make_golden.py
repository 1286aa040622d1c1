"""Golden numbers for the tests of every other implementation, by NumPy in float64 (derivatives by JAX). Same inputs, same bytes.

    python scripts/make_golden.py [WHICH ...]      (default: all)

`forward` needs the published networks (NBRDF_DATA); its file holds directions and results, never a published weight.
"""

import argparse
import json
import re
import sys
from pathlib import Path
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
from safetensors.numpy import save

from nbrdf_jax import data, library, lobes, metrics, objective
from nbrdf_jax.analytic import Microfacet, f0_from_ior
from nbrdf_jax.coordinates import half_difference, network_inputs, vectors_from_angles
from nbrdf_jax.delta_e_itp import delta_e_itp
from nbrdf_jax.directions import golden_directions, rus32k
from nbrdf_jax.invalid import InvalidFile
from nbrdf_jax.network import reflectance
from nbrdf_jax.sphere import LitSphere
from nbrdf_jax.ssim import ssim

FOLDER = Path(__file__).resolve().parents[1] / "tests" / "golden"
DIGITS = 12  # printed; fewer than float64 has, so that another libm prints the same bytes
LIGHTS = ("point", "studio")

GLOSSY = (f0_from_ior(1.5),) * 3
MATERIALS = {
    "lambert": Microfacet((0.8, 0.5, 0.2)),
    "roughness_start": Microfacet((0.2, 0.15, 0.1), GLOSSY, 0.1),
    "roughness_middle": Microfacet((0.2, 0.15, 0.1), GLOSSY, 0.35),
    "metal_middle": Microfacet((0.2, 0.025, 0.025), (0.52, 0.405, 0.19), 0.3),
    "metal_middle_beckmann": Microfacet((0.2, 0.025, 0.025), (0.52, 0.405, 0.19), 0.3, "beckmann"),
    "metal_middle_gtr1": Microfacet((0.2, 0.025, 0.025), (0.52, 0.405, 0.19), 0.3, "gtr1"),
}
PAIRS = (("lambert", "roughness_middle"), ("roughness_start", "roughness_middle"), ("metal_middle", "roughness_middle"))


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


def coordinates() -> bytes:
    """Angles beside light, view, half and difference vectors, from near the normal to grazing."""
    angles = [(h, p, d, q) for h in (1e-4, 0.3, 0.9) for p in (0.0, 2.5) for d in (1e-4, 0.4, 0.7) for q in (0.0, 1.0, 3.0, -2.0)]
    light, view = vectors_from_angles(*np.array(angles).T)
    half, difference = half_difference(light, view)
    keys = ("theta_half", "phi_half", "theta_diff", "phi_diff")
    rows = [
        dict(zip(keys, row), light=light[i], view=view[i], half=half[i], difference=difference[i])
        for i, row in enumerate(angles)
        if min(light[i, 2], view[i, 2]) > 0
    ]
    return _json("coordinates", "radians; half has phi_half rotated away; compare phi modulo 2 pi", {"cases": rows})


def merl() -> bytes:
    """Cells of a MERL table that a formula fills, looked up as the database's own reader does (BRDFRead.cpp)."""
    random = np.random.default_rng(3)
    angles = random.uniform(0, 1, (400, 3)) * (np.pi / 2, np.pi / 2, 2 * np.pi)
    half, difference, turn = angles.T
    light, view = (v.astype(np.float32).astype(np.float64) for v in vectors_from_angles(half, np.zeros_like(half), difference, turn))
    h, d = half_difference(light, view)
    theta_half = np.arctan2(np.hypot(h[:, 0], h[:, 1]), h[:, 2])
    theta_diff = np.arctan2(np.hypot(d[:, 0], d[:, 1]), d[:, 2])
    phi_diff = np.arctan2(d[:, 1], d[:, 0]) % np.pi
    places = np.stack([90 * np.sqrt(theta_half / (np.pi / 2)), theta_diff / (np.pi / 2) * 90, phi_diff / np.pi * 180], axis=1)
    # Next to the edge of a cell, rounding decides.
    clear = (np.abs(places - np.round(places)) > 1e-3).all(axis=1) & (light[:, 2] > 0) & (view[:, 2] > 0)
    cells = np.minimum(places.astype(int), (89, 89, 179))
    index = cells[:, 2] + 180 * (cells[:, 1] + 90 * cells[:, 0])
    number = index[:, None] + 90 * 90 * 180 * np.arange(3)
    stored = (7919 * number % 10007) / 7
    measured = (number % 11 != 0).all(axis=1)
    f = stored * np.array([1.0, 1.15, 1.66]) / 1500
    rows = [{"light": light[i], "view": view[i], "f": f[i]} for i in np.flatnonzero(clear & measured)]
    return _json("merl", "nearest cells; stored number k of the three planes is ((7919 k) mod 10007) / 7, -1 where k mod 11 = 0", {"rows": rows})


def sphere() -> bytes:
    """Linear pictures of known materials, 32 × 32: some pixels, and the mean over the covered ones."""
    materials = {}
    for name, material in MATERIALS.items():
        materials[name] = _parameters(material)
        for light in LIGHTS:
            lit = LitSphere.under(light, 32)
            picture = lit.render(material)
            pixels = [{"row": row, "column": column, "rgb": picture[row, column]} for row in range(4, 32, 6) for column in range(4, 32, 6) if lit.covered[row, column]]
            materials[name][light] = {"covered": int(lit.covered.sum()), "mean": picture[lit.covered].mean(axis=0), "pixels": pixels}
    return _json("sphere", "linear radiance; row 0 is the top row; alpha is not squared", {"size": 32, "materials": materials})


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
    value, by_weight = jax.value_and_grad(objective.loss)(jnp.asarray(own), jnp.asarray(inputs), jnp.asarray(factor), tuple(map(jnp.asarray, wanted)), counts)
    tensors = {"own": own, "other": other, "light": light, "view": view, "factor": factor, "loss": np.array([float(value)]), "gradient": np.asarray(by_weight)}
    about = f"loss and gradient of 'own' against 'other', {counts}, float64 rounded to float32; made by scripts/make_golden.py gradient"
    return save({name: tensor.astype(np.float32) for name, tensor in tensors.items()}, metadata={"about": about})


def metric_values() -> bytes:
    """Metrics between known materials; pictures 128 × 128."""
    light, view = rus32k()
    lit = {name: LitSphere.under(name, 128) for name in LIGHTS}
    rows = []
    for first, second in PAIRS:
        a, b = MATERIALS[first], MATERIALS[second]
        f, g = a(light, view), b(light, view)
        row: dict[str, Any] = {"reference": first, "other": second}
        row |= {metric.__name__: metric(f, g, light[:, 2]) for metric in (metrics.log_error, metrics.relative_log)}
        for name, scene in lit.items():
            x, y = scene.render(a), scene.render(b)
            row |= {f"{name}_{metric.__name__}": metric(x[scene.covered], y[scene.covered]) for metric in (metrics.mae, metrics.rmse, metrics.psnr, delta_e_itp)}
            row[f"{name}_ssim"] = ssim(x, y)
        rows.append(row)
    materials = {name: _parameters(material) for name, material in MATERIALS.items()}
    return _json("judged", "keys as in the measuring protocol", {"directions": len(light), "size": 128, "materials": materials, "pairs": rows})


LOBES = {
    "ward": {"diffuse": [0.3, 0.1, 0.02], "specular": [0.05, 0.2, 0.9], "alpha": 0.15},
    "ward_sharp": {"diffuse": [0.3, 0.1, 0.02], "specular": [0.05, 0.2, 0.9], "alpha": 0.02},
    "abc": {"diffuse": [0.0, 0.1, 0.4], "a": [1.0, 50.0, 2000.0], "b": 2e5, "c": 1.2, "ior": 1.45},
    "abc_metal": {"diffuse": [0.01, 0.0, 0.0], "a": [900.0, 700.0, 600.0], "b": 60.0, "c": 1.9, "ior": 90.0},
    "free_fresnel_ggx": {"diffuse": [0.3, 0.1, 0.02], "f0": [0.04, 0.2, 0.9], "f90": [0.5, 1.0, 0.6], "alpha": 0.1, "facets": "ggx"},
    "free_fresnel_blinn_phong": {"diffuse": [0.3, 0.1, 0.02], "f0": [0.04, 0.2, 0.9], "f90": [0.5, 1.0, 0.6], "alpha": 0.05, "facets": "blinn_phong"},
    # Of the sizes that published fits have: soft, sharp, and a channel whose shadows c alone makes sudden.
    "sgd": {
        "diffuse": [0.3, 0.05, 0.01], "specular": [0.04, 0.5, 0.2], "kappa": [4.0, 30.0, 5000.0],
        "alpha": [0.4, 0.02, 0.0002], "p": [1.2, 0.5, 0.4], "f0": [0.05, 0.8, 5.0], "f1": [0.02, 0.3, 4.9],
        "lam": [3.0, 5.0, 1e-5], "c": [1e-7, 2e-5, 1e4], "k": [47.0, 30.0, 200.0], "theta0": [0.1, -0.3, 0.6],
    },
}  # fmt: skip


def lobe_values() -> bytes:
    """f [100, 3] of analytic lobes at pairs all over and at pairs near the mirror direction."""
    light, view = (v[:50] for v in golden_directions())
    u = np.modf(0.5 + np.arange(1, 51)[:, None] * np.array([0.8191725134, 0.6710436067, 0.5497004779]))[0]
    near = vectors_from_angles(0.1 * u[:, 0] ** 2, np.zeros(50), 1.4 * u[:, 1], 2 * np.pi * u[:, 2])
    light, view = (np.concatenate([all_over, mirror]).astype(np.float32) for all_over, mirror in zip((light, view), near))
    rows = {}
    for name, parameters in LOBES.items():
        formula = next(getattr(lobes, known) for known in ("ward", "abc", "free_fresnel", "sgd") if name.startswith(known))
        rows[name] = parameters | {"f": formula(light.astype(np.float64), view.astype(np.float64), **parameters)}
    return _json("lobes", "f_r [1/sr], not clamped; float64", {"light": light.astype(np.float64), "view": view.astype(np.float64), "lobes": rows})


def charting() -> bytes:
    """The connection of eight local charts of a bent sheet, from the sum over pairs of charts itself (Brand 2002, equation 5)."""
    random = np.random.default_rng(15)
    points, charts, dim = 40, 8, 2
    flat = random.uniform(-1, 1, (points, dim))
    sheet = np.stack([flat[:, 0], flat[:, 1], 0.6 * flat[:, 0] ** 2 - 0.3 * flat[:, 0] * flat[:, 1]], axis=1)
    centres = sheet[:charts]
    axes = np.linalg.qr(random.normal(0, 0.2, (charts, 3, dim)) + np.eye(3)[:, :dim])[0]
    local = _printed(np.einsum("knc,kca->kna", sheet - centres[:, None], axes))
    density = np.exp(-((sheet[:, None] - centres) ** 2).sum(2) / 0.5)
    weights = _printed(density / density.sum(axis=1, keepdims=True))
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
    return _json("charting", about, {"local": local, "weights": weights, "agreement": shares.real[best], "coordinates": coordinates})


def _printed(values: np.ndarray) -> np.ndarray:
    """Rounded to what is printed, so that whoever reads the file starts from the same numbers."""
    return np.round(values, 9)


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
        matrix, right = np.array(_rounded(np.stack(columns, axis=1))), np.array(_rounded(random.normal(size=rows)))
        damping = 0.05
        ridge = np.linalg.solve(matrix.T @ matrix + damping * np.eye(unknowns), matrix.T @ right)
        plain = np.linalg.lstsq(matrix, right, rcond=None)[0]
        systems.append({"matrix": matrix, "right": right, "condition": float(np.linalg.cond(matrix)), "plain": plain, "damping": damping, "ridge": ridge})
    return _json("least_squares", "min |matrix x - right|^2 + damping |x|^2; plain is the shortest answer without damping", {"systems": systems})


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
                found = np.linalg.svd(table.reshape(90, -1), compute_uv=False)
                shares = found / found.sum()
                effective = float(np.exp(-np.sum(shares[shares > 0] * np.log(shares[shares > 0]))))
                rows.append({"material": name, "frame": frame, "values": values, "effective_rank": effective, "normalised": found[:8] / found[0]})
    materials = {row["material"]: _parameters(MATERIALS[row["material"]]) for row in rows}
    return _json("rank", "a cell below the horizon repeats the one before it in its first angle", {"materials": materials, "rows": rows})


def _parameters(material: Microfacet) -> dict[str, Any]:
    return {"diffuse": list(material.diffuse), "f0": material.f0 and list(material.f0), "alpha": material.alpha, "lobe": material.lobe}


def _json(name: str, about: str, content: dict[str, Any]) -> bytes:
    header = {"schema": 1, "command": f"python scripts/make_golden.py {name}", "about": about}
    text = json.dumps(header | _rounded(content), indent=1)
    flat = re.sub(r"[\[{][^\[\]{}]*[\]}]", lambda match: re.sub(r"\s+", " ", match[0]), text)  # innermost on one line
    return (flat + "\n").encode()


def _rounded(value: Any) -> Any:
    """Floats to 12 significant digits, arrays to lists; −0 becomes 0."""
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | list | tuple):
        return [_rounded(item) for item in value]
    return float(f"{value:.{DIGITS}g}") + 0.0 if isinstance(value, float) else value


FILES = {
    "forward": ("forward.safetensors", forward),
    "coordinates": ("coordinates.json", coordinates),
    "merl": ("merl.json", merl),
    "sphere": ("sphere.json", sphere),
    "gradient": ("gradient.safetensors", gradient),
    "judged": ("judged.json", metric_values),
    "lobes": ("lobes.json", lobe_values),
    "charting": ("charting.json", charting),
    "least_squares": ("least_squares.json", least_squares),
    "rank": ("rank.json", rank),
}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("which", nargs="*", metavar="WHICH", help=f"of {', '.join(FILES)} (default: all)")
    parser.add_argument("-o", "--output", type=Path, default=FOLDER, help="folder (default: tests/golden)")
    arguments = parser.parse_args()
    unknown = set(arguments.which) - set(FILES)
    if unknown:
        parser.error(f"no golden file is called {', '.join(sorted(unknown))}; there are {', '.join(FILES)}")
    try:
        for which in arguments.which or FILES:
            name, make = FILES[which]
            content = make()
            temporary = arguments.output / f".{name}.part"
            temporary.write_bytes(content)
            temporary.replace(arguments.output / name)
            print(arguments.output / name)
    except InvalidFile as error:
        print(f"error: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
