"""Writes tests/golden/metrics.json: figures of merit computed by programs other than ours.

Image errors come from scikit-image (PSNR, SSIM), flip-evaluator (LDR-FLIP) and colour-science (ICtCp, u'v');
directions, lights, GGX and albedo are written anew in numpy from docs and papers, not from the Rust code.

    pip install numpy scikit-image flip-evaluator colour-science
    python scripts/make_golden_metrics.py
"""

import importlib.metadata
import json
import pathlib
import warnings

import numpy as np

warnings.filterwarnings("ignore")
import colour  # noqa: E402
import flip_evaluator  # noqa: E402
import skimage.metrics  # noqa: E402

OUT = pathlib.Path(__file__).resolve().parents[1] / "tests" / "golden" / "metrics.json"
LEVELS = 204.0  # one byte per channel, linear value = byte / 204: up to 1.25, so clipping is seen


# --- images -----------------------------------------------------------------------------------------------------


def display(linear):
    return np.clip(linear, 0, 1) ** (1 / 2.2)


def ball(height, width, centre, colour_, gloss):
    """A lit ball on black, like the pictures the metrics are for."""
    y, x = np.mgrid[0:height, 0:width]
    x = (2 * x + 1 - width) / min(width, height)
    y = (height - 2 * y - 1) / min(width, height)
    z = np.sqrt(np.clip(1 - x * x - y * y, 0, None))
    lit = np.clip(x * centre[0] + y * centre[1] + z * centre[2], 0, None)
    return (lit[..., None] * np.array(colour_) + 1.3 * lit[..., None] ** gloss) * (z > 0)[..., None]


def image_pairs(rng):
    light = np.array([0.5, 0.4, 0.77])
    a = ball(40, 48, light, (0.5, 0.2, 0.1), 60)
    yield "gloss", a, ball(40, 48, light, (0.5, 0.2, 0.1), 15)
    yield "hue", a, ball(40, 48, light, (0.1, 0.2, 0.5), 60)
    noise = rng.uniform(0, 1, (32, 36, 3)) ** 2
    yield "noise", noise, noise + rng.normal(0, 0.08, noise.shape)
    step = np.where(np.arange(36)[None, :, None] < 18, 0.02, 0.9) * np.ones((32, 1, 3))
    yield "edge", step, np.roll(step, 2, axis=1) * np.array([1.0, 0.9, 1.1])


def ictcp(linear):
    """BT.2100 ICtCp of linear BT.709, white at 100 cd/m^2; colour's default luminance scale is absolute."""
    rgb = colour.RGB_to_RGB(
        np.clip(linear, 0, 1), "ITU-R BT.709", "ITU-R BT.2020", chromatic_adaptation_transform=None
    )
    return colour.RGB_to_ICtCp(rgb * 100.0, method="ITU-R BT.2100-2 PQ")


def delta_e_itp(f, g):
    return 720 * np.sqrt(np.sum(((ictcp(f) - ictcp(g)) * np.array([1, 0.5, 1])) ** 2, axis=-1))


def uv(linear):
    return colour.xy_to_Luv_uv(
        colour.XYZ_to_xy(colour.RGB_COLOURSPACES["ITU-R BT.709"].matrix_RGB_to_XYZ @ linear)
    )


def image_case(name, f, g):
    to_bytes = lambda image: np.clip(np.round(image * LEVELS), 0, 255).astype(np.uint8)
    bf, bg = to_bytes(f), to_bytes(g)
    f, g = bf / LEVELS, bg / LEVELS
    height, width = f.shape[:2]
    y, x = np.mgrid[0:height, 0:width]
    covered = (2 * x + 1 - width) ** 2 + (2 * y + 1 - height) ** 2 < min(width, height) ** 2
    df, dg = display(f), display(g)
    error = (df - dg)[covered]
    flip_map, flip, _ = flip_evaluator.evaluate(
        df.astype(np.float32), dg.astype(np.float32), "LDR", inputsRGB=True, applyMagma=False, parameters={"ppd": 67.0}
    )
    itp = delta_e_itp(f, g)
    return {
        "name": name,
        "width": width,
        "height": height,
        "reference": bf.tobytes().hex(),
        "other": bg.tobytes().hex(),
        "mae": np.abs(error).mean(),
        "rmse": np.sqrt((error**2).mean()),
        "psnr": skimage.metrics.peak_signal_noise_ratio(df[covered], dg[covered], data_range=1),
        "ssim": skimage.metrics.structural_similarity(
            df, dg, channel_axis=2, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1
        ),
        "flip": float(flip),
        "flip_max": float(np.max(flip_map)),
        "delta_e_itp": itp[covered].mean(),
        "delta_e_itp_max": itp.max(),
        "uv_reference": uv(np.clip(f, 0, 1)[covered].mean(axis=0)).tolist(),
        "uv_other": uv(np.clip(g, 0, 1)[covered].mean(axis=0)).tolist(),
    }


# --- materials --------------------------------------------------------------------------------------------------


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


def rounded(value):
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, list):
        return [rounded(item) for item in value]
    return float(f"{float(value):.10g}") if isinstance(value, (float, np.floating)) else value


def main():
    rng = np.random.default_rng(7)
    packages = ["numpy", "scikit-image", "flip-evaluator", "colour-science"]
    golden = {
        "made_by": "scripts/make_golden_metrics.py",
        "with": {package: importlib.metadata.version(package) for package in packages},
        "levels": LEVELS,
        "images": [image_case(*pair) for pair in image_pairs(rng)],
        "materials": material_cases(),
    }
    OUT.parent.mkdir(parents=True, exist_ok=True)
    OUT.write_text(json.dumps(rounded(golden), indent=1) + "\n")


if __name__ == "__main__":
    main()
