"""The golden files in the repository are what the script makes now."""

import json

import numpy as np
import pytest
from safetensors.numpy import load, load_file

import make_golden


@pytest.mark.parametrize("which", ["coordinates", "merl", "sphere", "judged", "lobes", "charting", "least_squares", "rank"])
def test_the_numbers_are_those_of_the_formulas(which):
    name, make = make_golden.FILES[which]
    _same(json.loads(make()), json.loads((make_golden.FOLDER / name).read_text()))


def test_the_numbers_are_those_of_the_published_networks(merl, rgl):
    made, stored = load(make_golden.forward()), load_file(make_golden.FOLDER / "forward.safetensors")
    assert made.keys() == stored.keys() == merl.keys() | rgl.keys() | {"light", "view"}
    for name, tensor in stored.items():
        assert tensor.shape == (1000, 3) and tensor.dtype == np.float32
        assert np.allclose(tensor, made[name], rtol=1e-6, atol=1e-9), name


def test_the_gradient_is_that_of_the_second_implementation():
    made, stored = load(make_golden.gradient()), load_file(make_golden.FOLDER / "gradient.safetensors")
    assert made.keys() == stored.keys()
    for name, tensor in stored.items():
        assert np.allclose(tensor, made[name], rtol=1e-6, atol=1e-9), name


def test_making_twice_gives_the_same_bytes():
    assert make_golden.sphere() == make_golden.sphere()


def _same(a, b) -> None:
    if isinstance(a, dict):
        assert a.keys() == b.keys()
        [_same(a[key], b[key]) for key in a]
    elif isinstance(a, list):
        assert len(a) == len(b)
        [_same(x, y) for x, y in zip(a, b)]
    else:
        assert a == b or a == pytest.approx(b, rel=1e-9, abs=1e-12)
