"""The figures of one walk between two materials (PROTOCOL, "Interpolation quality")."""

import numpy as np

from . import metrics, physics
from .places import walked
from .smoothness import Smoothness
from .ssim import ssim
from .walks import End, Mix, Walk

STEPS, BEYOND = 16, 8
KEYS = (
    "end_error", "mix_psnr", "mix_ssim", "mix_rmse", "length_ratio", "step_ratio", "hue_excursion",
    "negative_share", "negative_share_beyond", "albedo_max", "albedo_max_beyond",
)  # fmt: skip
BOUNDS = ("negative_share_low", "negative_share_high", "negative_share_beyond_low", "negative_share_beyond_high")


def walk_quality(walk: Walk, ends: tuple[End, End]) -> dict[str, float]:
    """All `KEYS` and `BOUNDS`. Shares and albedos are the worst over t in [0, 1], `_beyond` over t in [−½, 1½]."""
    pictures, errors, worst = [], [], {True: (0.0,) * 4, False: (0.0,) * 4}
    for step in range(-BEYOND, STEPS + BEYOND + 1):
        is_between = 0 <= step <= STEPS
        places = walked(is_between)
        signed = walk.at(step / STEPS)(places)
        f = np.maximum(signed, 0)
        found = *physics.negative_shares(places.part(signed, "rus32k")), physics.albedo_max(places.part(f, "albedo"))
        worst[is_between] = tuple(map(max, worst[is_between], found))
        if is_between:
            pictures.append(places.pixels(f, "studio"))
        if step in (0, STEPS):
            own = np.maximum(ends[step // STEPS](places), 0)
            cosine = places.light[places.parts["rus32k"], 2]
            errors.append(metrics.log_error(places.part(own, "rus32k"), places.part(f, "rus32k"), cosine))
    places = walked(True)
    mixed = places.pixels(np.maximum(Mix(ends).at(0.5)(places), 0), "studio")
    middle, scene = pictures[STEPS // 2], places.spheres["studio"]
    smooth = Smoothness.of(np.stack(pictures))
    beyond = tuple(map(max, worst[True], worst[False]))
    return {
        "end_error": float(np.mean(errors)),
        "mix_psnr": float(metrics.psnr(mixed, middle)),
        "mix_ssim": ssim(scene.picture(mixed), scene.picture(middle)),
        "mix_rmse": float(metrics.rmse(mixed, middle)),
        "length_ratio": smooth.length_ratio,
        "step_ratio": smooth.step_ratio,
        "hue_excursion": smooth.hue_excursion,
        **_shares(worst[True], ""),
        **_shares(beyond, "_beyond"),
        "albedo_max": worst[True][3],
        "albedo_max_beyond": beyond[3],
    }


def _shares(worst: tuple[float, ...], suffix: str) -> dict[str, float]:
    return {f"negative_share{suffix}{side}": share for side, share in zip(("", "_low", "_high"), worst)}
