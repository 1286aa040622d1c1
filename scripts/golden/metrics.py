"""Figures of merit computed by programs other than ours: scikit-image (PSNR, SSIM), flip-evaluator (LDR-FLIP) and
colour-science (ICtCp, u'v'); materials by `metric_materials`."""

import importlib.metadata
import json
import warnings

import numpy as np

warnings.filterwarnings("ignore")
import colour  # noqa: E402
import flip_evaluator  # noqa: E402
import skimage.metrics  # noqa: E402

from .metric_materials import material_cases  # noqa: E402

LEVELS = 204.0  # one byte per channel, linear value = byte / 204: up to 1.25, so clipping is seen
PACKAGES = ("numpy", "scikit-image", "flip-evaluator", "colour-science")


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


def metric_values() -> bytes:
    """Pairs of pictures and of materials with their figures."""
    rng = np.random.default_rng(7)
    golden = {
        "made_by": "scripts/make_golden.py metrics",
        "with": {package: importlib.metadata.version(package) for package in PACKAGES},
        "levels": LEVELS,
        "images": [image_case(*pair) for pair in image_pairs(rng)],
        "materials": material_cases(),
    }
    return (json.dumps(_rounded(golden), indent=1) + "\n").encode()


def _rounded(value):
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_rounded(item) for item in value]
    return float(f"{float(value):.10g}") if isinstance(value, (float, np.floating)) else value
