"""Analytic lobes of the papers."""

import numpy as np

from nbrdf_jax import lobes
from nbrdf_jax.coordinates import vectors_from_angles
from nbrdf_jax.directions import golden_directions

from .text import document

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
    return document("lobes", "f_r [1/sr], not clamped; float64", {"light": light.astype(np.float64), "view": view.astype(np.float64), "lobes": rows})
