import json

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import evaluate
from nbrdf_jax import autoencoder, library, split
from nbrdf_jax.coordinates import network_inputs
from nbrdf_jax.directions import rus32k
from nbrdf_jax.judge import judge
from nbrdf_jax.metrics import log_error, psnr
from nbrdf_jax.network import reflectance
from nbrdf_jax.sphere import LitSphere

KEYS = ("log_error", "studio_psnr")


def row(variant, names, codes, figures):
    stats = {key: {"mean": float(np.mean(getattr(figures, key)))} for key in KEYS}
    materials = [
        {"name": name, "code": [float(x) for x in code]} | {key: float(getattr(figures, key)[i]) for key in KEYS}
        for i, (name, code) in enumerate(zip(names, codes))
    ]
    return {"name": "znbrdf", "variant": variant, "database": "merl", **stats, "materials": materials}


@pytest.fixture
def honest(networks, checkpoint):
    """A report whose numbers are right, by construction."""
    model, read = autoencoder.read(checkpoint), library.read(networks)
    names = split.held_out(read, "merl")
    reference = jnp.asarray(np.stack([read[name] for name in names]))
    codes = jax.vmap(model.encode)(reference)
    moved = codes + 0.1
    variants = (("unrolled", codes - 0.1), ("feed_forward", codes), ("refined", moved))
    rows = [row(variant, names, c, judge(reference, jax.vmap(model.decode)(c))) for variant, c in variants]
    other = {"name": "pca_32", "variant": "projection", "log_error": {"mean": 1.0}}
    return {"schema": 1, "reference": "builtin", "rows": [other, *rows]}


def run(report, networks, checkpoint, tmp_path, *more):
    path = tmp_path / "evaluate.json"
    path.write_text(report if isinstance(report, str) else json.dumps(report))
    return evaluate.main(["--report", str(path), "--checkpoint", str(checkpoint), "--networks", str(networks), *more])


def test_an_honest_report_is_confirmed(honest, networks, checkpoint, tmp_path, capsys):
    assert run(honest, networks, checkpoint, tmp_path) == 0
    out = capsys.readouterr().out
    assert "unrolled" in out and "feed_forward" in out and "refined" in out and "DISAGREES" not in out


@pytest.mark.parametrize("which", [1, 2, 3])
@pytest.mark.parametrize("key", KEYS)
def test_a_wrong_mean_is_caught(honest, networks, checkpoint, tmp_path, capsys, which, key):
    honest["rows"][which][key]["mean"] *= 1.01
    assert run(honest, networks, checkpoint, tmp_path) == 1
    assert "DISAGREES" in capsys.readouterr().out
    assert run(honest, networks, checkpoint, tmp_path, "--tolerance", "0.02") == 0


def test_an_unrolled_or_refined_code_that_is_not_the_one_measured_is_caught(honest, networks, checkpoint, tmp_path):
    for which in (1, 3):
        honest["rows"][which]["materials"][0]["code"][0] += 1.0
        assert run(honest, networks, checkpoint, tmp_path) == 1
        honest["rows"][which]["materials"][0]["code"][0] -= 1.0


def test_a_missing_held_out_material_is_refused(honest, networks, checkpoint, tmp_path, capsys):
    honest["rows"][2]["materials"].pop()
    assert run(honest, networks, checkpoint, tmp_path) == 3
    assert "m7" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "says"),
    [("", "JSON"), ("{}", "schema"), ('{"schema": 2}', "schema"), ('{"schema": 1, "reference": "builtin", "rows": []}', "znbrdf"),
     ('{"schema": 1, "reference": "builtin", "rows": [{"name": "znbrdf", "variant": "refined"}]}', "log_error")],
)  # fmt: skip
def test_an_invalid_report_is_named_with_exit_code_3(text, says, networks, checkpoint, tmp_path, capsys):
    assert run(text, networks, checkpoint, tmp_path) == 3
    error = capsys.readouterr().err
    assert "evaluate.json" in error and says in error


def test_missing_files_are_named_with_exit_code_3(honest, networks, checkpoint, tmp_path, capsys):
    for missing in ({"networks": tmp_path / "none.zip"}, {"checkpoint": tmp_path / "none.safetensors"}):
        paths = {"networks": networks, "checkpoint": checkpoint} | missing
        assert run(honest, **paths, tmp_path=tmp_path) == 3
        assert "no such file" in capsys.readouterr().err


def test_a_builtin_reference_needs_its_library(honest, checkpoint, tmp_path, capsys):
    path = tmp_path / "evaluate.json"
    path.write_text(json.dumps(honest))
    assert evaluate.main(["--report", str(path), "--checkpoint", str(checkpoint)]) == 3
    assert "--networks" in capsys.readouterr().err


def test_figures_equal_the_slow_way(networks):
    read = library.read(networks)
    a, b = read["m0"], read["m1"]
    figures = judge(jnp.asarray(a)[None, :], jnp.asarray(b)[None, :])
    light, view = rus32k()
    inputs = network_inputs(light, view)
    expected = log_error(reflectance(a, inputs), reflectance(b, inputs), light[:, 2])
    assert figures.log_error[0] == pytest.approx(expected, rel=1e-12)
    scene = LitSphere.under("studio", 128)
    pictures = [scene.render(lambda l, v, w=w: reflectance(w, network_inputs(l, v)))[scene.covered] for w in (a, b)]
    assert figures.studio_psnr[0] == pytest.approx(psnr(*pictures), rel=1e-12)


def test_twenty_published_materials_against_themselves(merl):
    held_out = jnp.asarray(np.stack([merl[name] for name in split.held_out(merl, "merl")]))
    figures = judge(held_out, held_out)
    assert (figures.log_error == 0).all() and (figures.studio_psnr == 100).all()
