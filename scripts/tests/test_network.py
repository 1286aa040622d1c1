import math

import jax.numpy as jnp
import numpy as np
import pytest
from safetensors.numpy import save_file

from nbrdf_jax import library, split
from nbrdf_jax.coordinates import network_inputs
from nbrdf_jax.directions import rus32k
from nbrdf_jax.invalid import InvalidFile
from nbrdf_jax.network import reflectance, size, unclamped


def literal(weights: np.ndarray, x: list[float]) -> list[float]:
    """The same network as a slow loop over single numbers, written from the layout alone."""
    numbers = iter(weights)
    for layer, (rows, columns) in enumerate([(6, 21), (21, 21), (21, 3)]):
        kernel = [[next(numbers) for _ in range(columns)] for _ in range(rows)]
        bias = [next(numbers) for _ in range(columns)]
        x = [sum(x[row] * kernel[row][column] for row in range(rows)) + bias[column] for column in range(columns)]
        x = [max(value, 0.0) for value in x] if layer < 2 else [max(math.exp(value) - 1, 0.0) for value in x]
    assert next(numbers, None) is None
    return x


def test_equals_a_literal_loop():
    random = np.random.default_rng(0)
    weights, inputs = random.normal(0, 0.4, 675), random.uniform(-1, 1, (40, 6))
    expected = [literal(weights, list(row)) for row in inputs]
    assert np.allclose(reflectance(weights, inputs), expected, rtol=1e-12, atol=1e-14)
    assert np.allclose(reflectance(jnp.asarray(weights), jnp.asarray(inputs)), expected, rtol=1e-12, atol=1e-14)


def test_has_675_weights_and_refuses_others():
    assert size() == 675
    with pytest.raises(ValueError, match="675"):
        reflectance(np.zeros(674), np.zeros((1, 6)))


def test_output_is_clamped_at_zero():
    weights = np.zeros(675)
    weights[-3:] = -1
    assert (unclamped(weights, np.zeros((1, 6))) < 0).all()
    assert (reflectance(weights, np.zeros((1, 6))) == 0).all()


def test_all_134_published_networks_are_read(merl, rgl):
    assert (len(merl), len(rgl)) == (100, 34)
    assert abs(sum(weights.sum() for weights in merl.values()) - 3766.335698) < 1e-6
    assert "chrome" in merl and "rgl/paper_white" in rgl


def test_published_networks_are_materials(merl, rgl):
    light, view = (vectors[:2000] for vectors in rus32k())
    inputs = network_inputs(light, view)
    for weights in (merl | rgl).values():
        f = reflectance(weights, inputs)
        assert np.isfinite(f).all() and 0 < np.median(f) < 2


def test_held_out_are_every_fifth_and_every_fourth(merl, rgl):
    mine = split.held_out(merl, "merl")
    assert len(mine) == 20 and mine[:4] == ["aluminium", "black-oxidized-steel", "blue-metallic-paint", "chrome"]
    assert len(split.held_out(merl | rgl, "rgl")) == 9


def test_names_are_sorted_not_file_names():
    names = ["chrome-steel", "chrome", "a", "b"]
    assert split.held_out(names, "merl") == ["chrome"]  # a, b, chrome, chrome-steel


def test_a_library_keeps_names_and_numbers(tmp_path):
    weights = np.arange(675, dtype=np.float32)
    save_file({"rgl/paper_white": weights, "chrome": weights + 1}, tmp_path / "x.safetensors")
    read = library.read(tmp_path / "x.safetensors")
    assert list(read) == ["chrome", "rgl/paper_white"] and read["chrome"].dtype == np.float64
    assert (read["rgl/paper_white"] == weights).all()


@pytest.mark.parametrize("tensor", [np.zeros(674, np.float32), np.zeros(675, np.float64)])
def test_a_library_of_the_wrong_kind_is_refused(tmp_path, tensor):
    save_file({"chrome": tensor}, tmp_path / "x.safetensors")
    with pytest.raises(InvalidFile, match="chrome"):
        library.read(tmp_path / "x.safetensors")
