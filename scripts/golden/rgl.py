"""What RGL `.bsdf` files hold, read by Mitsuba 3, and a brushed metal of our own making, since none of the measured files at
hand changes when it is turned. The four measured files come from NBRDF_DATA; what is written holds directions and a few
results, never a measured table."""

import json
import struct
import tempfile
from pathlib import Path

import mitsuba
import numpy as np

from nbrdf_jax import data
from nbrdf_jax.invalid import InvalidFile

MATERIALS = ("cc_ibiza_sunset", "cg_sunflower", "colodur_napoli_4f", "paper_white")
COUNT = 24


def hemisphere(random: np.random.Generator) -> np.ndarray:
    """Unit vectors [COUNT, 3], the cosine evenly over .05..1."""
    cosine = random.uniform(0.05, 1, COUNT)
    phi = random.uniform(-np.pi, np.pi, COUNT)
    sine = np.sqrt(1 - cosine**2)
    return np.stack([sine * np.cos(phi), sine * np.sin(phi), cosine], axis=1)


def tensor_file(fields: dict[str, np.ndarray]) -> bytes:
    """A tensor file: a header of names, types and shapes, then the numbers."""
    kinds = {np.dtype(np.uint8): 1, np.dtype(np.float32): 10}
    start = 18 + sum(2 + len(name) + 2 + 1 + 8 + 8 * values.ndim for name, values in fields.items())
    header, data = b"tensor_file\0\x01\0" + struct.pack("<I", len(fields)), b""
    for name, values in fields.items():
        header += struct.pack("<H", len(name)) + name.encode() + struct.pack("<HB", values.ndim, kinds[values.dtype])
        header += struct.pack("<Q", start + len(data)) + struct.pack(f"<{values.ndim}Q", *values.shape)
        data += values.tobytes()
    return header + data


def brushed() -> bytes:
    """GGX, rougher across the brush than along it, at the half vectors of a grid; f cos θ without the Jacobian."""
    phi, theta = np.linspace(-np.pi, np.pi, 9), np.linspace(0, 1.5, 4)
    x, y = np.meshgrid(*[np.linspace(0, 1, 12)] * 2)
    half = spherical(x**2 * np.pi / 2, (2 * y - 1) * np.pi)
    view = spherical(*np.meshgrid(theta, phi))
    cosine = np.einsum("ptc,hwc->pthw", view, half)
    light_z = 2 * cosine * half[..., 2] - view[..., 2, None, None]
    spread = (half[..., 0] / 0.3) ** 2 + (half[..., 1] / 0.6) ** 2 + half[..., 2] ** 2
    normals = 1 / (np.pi * 0.3 * 0.6 * spread**2)
    lobe = np.where((light_z > 0) & (cosine > 0), normals * light_z / (4 * np.maximum(light_z, 0.2) * np.maximum(view[..., 2, None, None], 0.2)), 0)
    base = np.maximum(light_z, 0) / np.pi
    colour = np.array([0.9, 0.6, 0.3])[:, None, None]
    rgb = 0.05 * base[:, :, None] + colour * lobe[:, :, None]
    # Any density would do: one that changes with the eye in both angles has the warp looked up as that of a measured file.
    visible = 1 + 0.3 * np.sin(theta)[:, None, None] * (np.sin(phi)[:, None, None, None] * (x - 0.5) + y - 0.5)
    fields = {
        "description": np.frombuffer(b"brushed metal, synthetic", np.uint8),
        "jacobian": np.zeros(1, np.uint8),
        **{name: values.astype(np.float32) for name, values in {
            "phi_i": phi, "theta_i": theta, "ndf": np.ones((2, 2)), "sigma": np.ones((2, 2)), "vndf": visible,
            "luminance": rgb.mean(axis=2), "rgb": rgb,
        }.items()},
    }
    return tensor_file(fields)


def spherical(theta: np.ndarray, phi: np.ndarray) -> np.ndarray:
    """Unit vectors [..., 3] of polar angle and azimuth."""
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)


def rgl() -> bytes:
    """f_r of every file at the same pairs."""
    mitsuba.set_variant("scalar_rgb")
    random = np.random.default_rng(5)
    light, view = hemisphere(random), hemisphere(random)
    with tempfile.TemporaryDirectory() as folder:
        own = Path(folder) / "brushed.bsdf"
        own.write_bytes(brushed())
        paths = {name: data.folder() / "rgl_measured" / f"{name}_rgb.bsdf" for name in MATERIALS} | {own.stem: own}
        values = {name: values_of(path, light, view) for name, path in paths.items()}
    digits = [[float(f"{v:.9g}") for v in row] for row in light], [[float(f"{v:.9g}") for v in row] for row in view]
    about = f"f_r [1/sr] clamped at 0 by Mitsuba {mitsuba.__version__}, plugin measured, scalar_rgb"
    golden = {"schema": 1, "command": "python scripts/make_golden.py rgl", "about": about, "light": digits[0], "view": digits[1], "f": values}
    return (json.dumps(golden, separators=(",", ":")).replace("],[", "],\n[") + "\n").encode()


def values_of(path: Path, light: np.ndarray, view: np.ndarray) -> list[list[float]]:
    """f_r [pairs, 3] of one file, clamped at 0."""
    if not path.is_file():
        raise InvalidFile(path, "a measured material", "no such file", "set NBRDF_DATA")
    bsdf = mitsuba.load_dict({"type": "measured", "filename": str(path)})
    rows = []
    for to_light, to_view in zip(light, view):
        surface = mitsuba.SurfaceInteraction3f()
        surface.wi = to_view.tolist()
        surface.wavelengths = []
        # Mitsuba gives f cos θ of the light, and keeps what noise has taken below zero.
        value = np.array(bsdf.eval(mitsuba.BSDFContext(), surface, to_light.tolist())) / to_light[2]
        rows.append([float(f"{v:.6g}") for v in np.maximum(value, 0)])
    return rows
