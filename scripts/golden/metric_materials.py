"""Directions, lights, GGX and albedo once more, in NumPy from docs and papers: neither from the Rust code nor from `nbrdf_jax`."""

import numpy as np


def spherical(theta, phi):
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta) + 0 * phi], -1)


def ggx(light, view, diffuse, f0, alpha):
    """k_d/pi + D G F / (4 cos cos): D from tan^2, Smith G from Lambda, as in Walter 2007 and Heitz 2014."""
    half = light + view
    half = half / np.linalg.norm(half, axis=-1, keepdims=True)
    ci, co, ch = light[..., 2], view[..., 2], half[..., 2]
    tan2 = (half[..., 0] ** 2 + half[..., 1] ** 2) / ch**2
    d = 1 / (np.pi * alpha**2 * ch**4 * (1 + tan2 / alpha**2) ** 2)
    lam = lambda c: (np.sqrt(1 + alpha**2 * (1 - c**2) / c**2) - 1) / 2
    g = 1 / (1 + lam(ci) + lam(co))
    schlick = (1 - np.sum(light * half, -1))[..., None] ** 5
    f = np.array(f0) + (1 - np.array(f0)) * schlick
    value = np.array(diffuse) / np.pi + (d * g / (4 * ci * co))[..., None] * f
    return np.where(((ci > 0) & (co > 0))[..., None], value, 0)


def rus32k():
    root = 1.2207440846057596
    k = np.arange(32768)[:, None] + 1
    u = np.modf(0.5 + k * (1 / root ** np.arange(1, 4)))[0]
    half, diff, phi = u[:, 0] * np.pi / 2, u[:, 1] * np.pi / 2, 2 * np.pi * u[:, 2]
    turn = np.zeros((len(k), 3, 3))
    turn[:, 0, 0], turn[:, 0, 2], turn[:, 1, 1] = np.cos(half), np.sin(half), 1
    turn[:, 2, 0], turn[:, 2, 2] = -np.sin(half), np.cos(half)
    light = np.einsum("kij,kj->ki", turn, spherical(diff, phi))
    view = np.einsum("kij,kj->ki", turn, spherical(diff, phi + np.pi))
    keep = (light[:, 2] > 0) & (view[:, 2] > 0)
    return light[keep], view[keep]


def studio():
    unit = lambda v: np.array(v) / np.linalg.norm(v)
    lamps = [
        (unit([0.5, 0.6, 0.8]), [0.75, 0.72, 0.68]),
        (unit([-0.7, 0.3, 0.6]), [0.25, 0.28, 0.32]),
        (unit([0.1, -0.5, 0.9]), [0.15] * 3),
    ]
    for k in range(8):
        lamps.append((spherical(np.radians(75 if k % 2 == 0 else 50), np.radians(45.0 * k)), [0.03] * 3))
    return lamps


def render(material, lamps, size=128):
    c = ((np.arange(size) + 0.5) / size * 2 - 1) / 0.99
    x, y = np.meshgrid(c, -c)
    inside = x**2 + y**2 < 1
    n = np.stack([x, y, np.sqrt(np.clip(1 - x**2 - y**2, 0, None))], -1)[inside]
    t = np.cross(n, [0.3, 0.2, -0.9])  # any frame: the materials are isotropic
    t /= np.linalg.norm(t, axis=-1, keepdims=True)
    frame = np.stack([t, np.cross(n, t), n], 1)
    view = frame @ np.array([0, 0, 1.0])
    radiance = np.zeros_like(n)
    with np.errstate(all="ignore"):
        for direction, share in lamps:
            light = frame @ direction
            f = ggx(light, view, **material)
            radiance += np.nan_to_num(f) * np.pi * np.array(share) * np.clip(light[:, 2:], 0, None)
    image = np.zeros((size, size, 3))
    image[inside] = radiance
    return image, inside


def albedo(material, theta_o, n=1500):
    """Midpoint rule in (theta, phi), far finer than the quadrature under test."""
    theta = (np.arange(n) + 0.5) / n * np.pi / 2
    phi = (np.arange(n) + 0.5) / n * np.pi
    light = spherical(theta[:, None], phi[None, :])
    view = np.broadcast_to(spherical(np.array(theta_o), np.array(0.0)), light.shape)
    weight = (np.cos(theta) * np.sin(theta))[:, None, None] * (np.pi / 2 / n) * (2 * np.pi / n)
    return (ggx(light, view, **material) * weight).sum((0, 1))


def material_cases():
    a = {"diffuse": [0.2, 0.15, 0.1], "f0": [0.04] * 3, "alpha": 0.1}
    b = {"diffuse": [0.0, 0.0, 0.0], "f0": [1.0, 0.77, 0.34], "alpha": 0.35}
    light, view = rus32k()
    fa, fb = ggx(light, view, **a), ggx(light, view, **b)
    c = light[:, 2:]
    pictures = {}
    for name, lamps in {"point": [(np.array([1, 0, 1]) / 2**0.5, [1.0] * 3)], "studio": studio()}.items():
        for key, material in {"a": a, "b": b}.items():
            image, inside = render(material, lamps)
            pictures[f"{name}_{key}"] = {
                "mean": image[inside].mean(0).tolist(),
                "pixels": [[x, y, image[y, x].tolist()] for x, y in [(64, 64), (92, 60), (80, 30), (30, 45), (70, 118)]],
            }
    picks = [0, 1, 1000, len(light) - 1]
    return {
        "a": a,
        "b": b,
        "rus32k": {
            "count": len(light),
            "mean_light": light.mean(0).tolist(),
            "mean_view": view.mean(0).tolist(),
            "picks": [[k, light[k].tolist(), view[k].tolist()] for k in picks],
        },
        "values_a": [[k, fa[k].tolist()] for k in picks],
        "log_error": np.abs(np.log(1 + fa * c) - np.log(1 + fb * c)).mean(),
        "relative_log": np.abs(np.log(fa * c + 1e-3) - np.log(fb * c + 1e-3)).mean(),
        "albedo": [
            [key, degrees, albedo(m, np.radians(degrees)).tolist()]
            for key, m in {"a": a, "b": b, "white_0.1": {"diffuse": [0] * 3, "f0": [1] * 3, "alpha": 0.1}}.items()
            for degrees in (0, 45, 80)
        ],
        "covered": int(inside.sum()),
        "pictures": pictures,
    }
