"""The Mitsuba plugin: it reads what nbrdf writes, agrees with the other implementation, and draws what its density says."""

import hashlib
import json
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save_file

from nbrdf_jax import autoencoder, coordinates, network

mitsuba = pytest.importorskip("mitsuba", reason="Mitsuba 3 is not installed: pip install mitsuba")
mitsuba.set_variant("scalar_rgb")
import mitsuba_nbrdf as plugin  # noqa: E402  needs a variant


@pytest.fixture
def weights() -> np.ndarray:
    return np.random.default_rng(3).normal(0, 0.3, 675).astype(np.float32)


def npz(path, weights):
    layers = [layer for pair in network.layers(weights) for layer in pair]
    np.savez(path, **dict(zip(("fc1", "b1", "fc2", "b2", "fc3", "b3"), layers)))
    return path


def directions(count: int) -> tuple[np.ndarray, np.ndarray]:
    random = np.random.default_rng(4)
    vectors = random.normal(size=(2, count, 3))
    vectors[..., 2] = np.abs(vectors[..., 2]) + 0.05
    light, view = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return light, view


def test_all_forms_are_read_alike(weights, tmp_path):
    save_file({"weights": weights}, tmp_path / "a.safetensors", metadata={"hidden": "21,21"})
    for (kernel, bias), (other_kernel, other_bias) in zip(plugin.read(npz(tmp_path / "a.npz", weights)), plugin.read(tmp_path / "a.safetensors")):
        np.testing.assert_array_equal(kernel, other_kernel)
        np.testing.assert_array_equal(bias, other_bias)


def test_a_code_decodes_as_the_other_implementation_decodes_it(checkpoint, tmp_path):
    numbers = np.random.default_rng(5).normal(size=autoencoder.read(checkpoint).code_size)
    mark = hashlib.sha256(Path(checkpoint).read_bytes()).hexdigest()[:16]
    (tmp_path / "a.json").write_text(json.dumps({"model": "znbrdf", "checkpoint": mark, "code": numbers.tolist()}))
    flat = np.concatenate([part.ravel() for layer in plugin.read(tmp_path / "a.json", checkpoint) for part in layer])
    np.testing.assert_allclose(flat, autoencoder.read(checkpoint).decode(numbers), rtol=1e-5, atol=1e-6)


def test_what_is_no_network_is_refused_with_what_was_found(weights, tmp_path):
    (tmp_path / "a.json").write_text(json.dumps({"model": "pca_tables", "code": [1.0]}))
    np.savez(tmp_path / "b.npz", fc1=weights)
    for name, found in (("a.json", "pca_tables"), ("b.npz", "fc1 b1"), ("c.npz", "no such file"), ("a.png", "no such file")):
        with pytest.raises(plugin.InvalidFile, match=found):
            plugin.read(tmp_path / name)


def test_the_reflectance_is_that_of_the_other_implementation_times_the_cosine(weights, tmp_path):
    bsdf = mitsuba.load_dict({"type": "nbrdf", "filename": str(npz(tmp_path / "a.npz", weights)), "share": 0.5, "width": 0.3})
    light, view = directions(40)
    inputs = np.concatenate(coordinates.half_difference(light, view), axis=1)
    wanted = network.reflectance(weights.astype(np.float64), inputs) * light[:, 2:]
    for to_light, to_view, value in zip(light, view, wanted):
        surface = mitsuba.SurfaceInteraction3f()
        surface.wi = to_view.tolist()
        found = np.array(bsdf.eval(mitsuba.BSDFContext(), surface, to_light.tolist()))
        np.testing.assert_allclose(found, value, rtol=1e-4, atol=1e-6)
        assert np.all(np.array(bsdf.eval(mitsuba.BSDFContext(), surface, [0, 0.6, -0.8])) == 0)


def test_lights_are_drawn_with_the_density_that_pdf_gives(weights, tmp_path):
    bsdf = mitsuba.load_dict({"type": "nbrdf", "filename": str(npz(tmp_path / "a.npz", weights)), "share": 0.6, "width": 0.4})
    surface = mitsuba.SurfaceInteraction3f()
    surface.wi = [0.6, 0.0, 0.8]
    random, count = np.random.default_rng(6), 4000
    heights, lost = [], 0
    for u, v, w in random.random((count, 3)):
        drawn, _ = bsdf.sample(mitsuba.BSDFContext(), surface, w, [u, v])
        lost += drawn.wo.z <= 0
        heights.append(drawn.wo.z)
    found, edges = np.histogram(heights, bins=5, range=(0, 1))
    # The same shares by the density, over even lights.
    z, phi = random.random(count), 2 * np.pi * random.random(count)
    lights = np.stack((np.sqrt(1 - z * z) * np.cos(phi), np.sqrt(1 - z * z) * np.sin(phi), z), axis=1)
    density = np.array([bsdf.pdf(mitsuba.BSDFContext(), surface, light.tolist()) for light in lights])
    wanted = np.histogram(z, bins=edges, weights=density * 2 * np.pi / count)[0]
    np.testing.assert_allclose(found / count, wanted, atol=0.04)
    assert abs(wanted.sum() + lost / count - 1) < 0.06
