"""The golden files in the repository are what the script makes now."""

import json
import sys

import numpy as np
import pytest
from safetensors.numpy import load, load_file

import make_golden


@pytest.mark.parametrize("which", ["coordinates", "merl", "sphere", "judged", "lobes", "charting", "least_squares", "rank"])
def test_the_numbers_are_those_of_the_formulas(which):
    file = make_golden.FILES[which]
    _same(json.loads(file.make()), json.loads((make_golden.FOLDER / file.name).read_text()))


def test_the_numbers_are_those_of_the_published_networks(merl, rgl):
    made, stored = load(make_golden.FILES["forward"].make()), load_file(make_golden.FOLDER / "forward.safetensors")
    assert made.keys() == stored.keys() == merl.keys() | rgl.keys() | {"light", "view"}
    for name, tensor in stored.items():
        assert tensor.shape == (1000, 3) and tensor.dtype == np.float32
        assert np.allclose(tensor, made[name], rtol=1e-6, atol=1e-9), name


def test_the_gradient_is_that_of_the_second_implementation():
    made, stored = load(make_golden.FILES["gradient"].make()), load_file(make_golden.FOLDER / "gradient.safetensors")
    assert made.keys() == stored.keys()
    for name, tensor in stored.items():
        assert np.allclose(tensor, made[name], rtol=1e-6, atol=1e-9), name


def test_making_twice_gives_the_same_bytes():
    sphere = make_golden.FILES["sphere"]
    assert sphere.make() == sphere.make()


def test_every_golden_file_is_told_of_and_says_how_it_was_made():
    names = {file.name for file in make_golden.FILES.values()}
    assert names | {"README.md", *make_golden.WRITTEN} == {path.name for path in make_golden.FOLDER.iterdir()}
    assert (make_golden.FOLDER / "README.md").read_bytes() == make_golden.readme()
    for which, file in make_golden.FILES.items():
        if file.name.endswith(".json"):
            assert f"make_golden.py {which}" in (make_golden.FOLDER / file.name).read_text()[:400], which


def test_a_missing_program_is_named_and_nothing_is_written(tmp_path, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "golden.metrics", None)
    assert make_golden.main(["sphere", "metrics", "-o", str(tmp_path)]) == 3
    assert "golden]" in capsys.readouterr().err and not list(tmp_path.iterdir())


def _same(a, b) -> None:
    if isinstance(a, dict):
        assert a.keys() == b.keys()
        [_same(a[key], b[key]) for key in a]
    elif isinstance(a, list):
        assert len(a) == len(b)
        [_same(x, y) for x, y in zip(a, b)]
    else:
        assert a == b or a == pytest.approx(b, rel=1e-9, abs=1e-12)
