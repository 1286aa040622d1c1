"""Spheres of known materials, and metrics between them."""

from typing import Any

from nbrdf_jax import metrics
from nbrdf_jax.delta_e_itp import delta_e_itp
from nbrdf_jax.directions import rus32k
from nbrdf_jax.sphere import LitSphere
from nbrdf_jax.ssim import ssim

from .materials import MATERIALS, PAIRS, parameters
from .text import document

LIGHTS = ("point", "studio")


def sphere() -> bytes:
    """Linear pictures of known materials, 32 × 32: some pixels, and the mean over the covered ones."""
    materials = {}
    for name, material in MATERIALS.items():
        materials[name] = parameters(material)
        for light in LIGHTS:
            lit = LitSphere.under(light, 32)
            picture = lit.render(material)
            pixels = [{"row": row, "column": column, "rgb": picture[row, column]} for row in range(4, 32, 6) for column in range(4, 32, 6) if lit.covered[row, column]]
            materials[name][light] = {"covered": int(lit.covered.sum()), "mean": picture[lit.covered].mean(axis=0), "pixels": pixels}
    return document("sphere", "linear radiance; row 0 is the top row; alpha is not squared", {"size": 32, "materials": materials})


def judged() -> bytes:
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
    materials = {name: parameters(material) for name, material in MATERIALS.items()}
    return document("judged", "keys as in the measuring protocol", {"directions": len(light), "size": 128, "materials": materials, "pairs": rows})
