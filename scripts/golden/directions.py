"""Angles and vectors, and the cells of a MERL table that they fall into."""

import numpy as np

from nbrdf_jax.coordinates import half_difference, vectors_from_angles

from .text import document


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
    return document("coordinates", "radians; half has phi_half rotated away; compare phi modulo 2 pi", {"cases": rows})


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
    return document("merl", "nearest cells; stored number k of the three planes is ((7919 k) mod 10007) / 7, -1 where k mod 11 = 0", {"rows": rows})
