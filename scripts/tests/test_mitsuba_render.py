"""Pictures that are compared with those of `nbrdf render`: the same rays and lamps, and noise down to a target."""

from pathlib import Path

import numpy as np
import pytest

import mitsuba_judge
from nbrdf_jax.analytic import Microfacet
from nbrdf_jax.lights import lamps
from nbrdf_jax.sphere import LitSphere

mitsuba = pytest.importorskip("mitsuba", reason="Mitsuba 3 is not installed: pip install mitsuba")
mitsuba.set_variant("scalar_rgb")
import mitsuba_nbrdf  # noqa: E402  needs a variant
import mitsuba_render  # noqa: E402  needs a variant

SIZE = 24


@pytest.fixture
def white() -> "mitsuba.BSDF":
    return mitsuba.load_dict({"type": "diffuse", "reflectance": {"type": "rgb", "value": 1.0}})


@pytest.mark.parametrize("name", ["point", "studio"])
def test_a_picture_under_lamps_is_that_of_the_other_implementation_without_noise(white, name):
    directions, irradiance = lamps(name)
    found = mitsuba_render.under_lamps(white, {"directions": directions.tolist(), "irradiance": (np.pi * irradiance).tolist()}, SIZE)
    np.testing.assert_allclose(found, [LitSphere.under(name, SIZE).render(Microfacet((1.0, 1.0, 1.0)))], atol=2e-5)


@pytest.fixture
def scene(tmp_path) -> Path:
    """A white sphere with a lamp from either side."""
    lamp = '<emitter type="directional"><vector name="direction" x="{}" y="0" z="-1"/><rgb name="irradiance" value="1, 2, 3"/></emitter>'
    (tmp_path / "a.xml").write_text(
        '<scene version="3.0.0"><default name="size" value="8"/><integrator type="path"><integer name="max_depth" value="2"/></integrator>'
        '<sensor type="orthographic"><transform name="to_world"><lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform>'
        '<default name="samples" value="4"/><sampler type="independent"><integer name="sample_count" value="$samples"/></sampler><film type="hdrfilm"><integer name="width" value="$size"/><integer name="height" value="$size"/>'
        '<rfilter type="box"/></film></sensor><shape type="sphere"><float name="radius" value="0.99"/><bsdf type="diffuse"/></shape>'
        f"{lamp.format(-1)}{lamp.format(1)}</scene>"
    )
    return tmp_path / "a.xml"


def test_a_scene_is_rendered_lamp_by_lamp(scene):
    (found,) = mitsuba_render.of_file(scene, SIZE)
    assert found.shape == (SIZE, SIZE, 3)
    np.testing.assert_allclose(found, found[:, ::-1], atol=1e-5)  # one lamp from either side
    np.testing.assert_allclose(found[..., 2], 3 * found[..., 0], rtol=1e-4)
    # Facing the viewer, E cos 45° / π of each lamp and half of it reflected.
    assert found[SIZE // 2, SIZE // 2, 0] == pytest.approx(2 * np.sqrt(0.5) / np.pi * 0.5, rel=0.01)


def test_a_scene_as_it_comes_shows_the_same_with_noise(scene):
    effort = {"size": 8, "samples": 64, "most_passes": 64, "target": 0.002}
    found = mitsuba_judge.noisy(mitsuba_render.as_it_comes(scene, effort), mitsuba_render.of_file(scene, 128), 0.001)
    assert found["verdict"] == mitsuba_judge.AGREES and found["noise"] > 0.0005


def test_processes_at_one_scene_do_not_share_a_file(scene, monkeypatch):
    names = set()
    monkeypatch.setattr(mitsuba_render.mi, "load_file", lambda path, **_: names.add(path))
    monkeypatch.setattr(mitsuba_render, "picture", lambda lit: np.zeros((SIZE, SIZE, 3)))
    for process in (11, 12):
        monkeypatch.setattr(mitsuba_render.os, "getpid", lambda: process)
        mitsuba_render.of_file(scene, SIZE)
    assert len(names) == 2


def test_passes_that_are_not_finite_never_reach_the_target(monkeypatch):
    monkeypatch.setattr(mitsuba_render, "picture", lambda lit, seed: np.full((8, 8, 3), np.nan if seed == 3 else 1.0))
    assert len(mitsuba_render.passes(None, 20, 1.0)) == 20


def test_passes_are_added_until_the_noise_is_at_the_target_or_the_budget_is_used_up(white, tmp_path):
    environment = str(tmp_path / "sky.exr")
    mitsuba.Bitmap(np.linspace(0, 1, 8 * 16 * 3, dtype=np.float32).reshape(8, 16, 3)).write(environment)
    effort = {"size": 8, "samples": 4, "most_passes": 20}
    least = mitsuba_render.around(white, environment, effort, "drawn_by_material", 1.0)
    most = mitsuba_render.around(white, environment, effort, "drawn_by_both", 0.0)
    assert (least.shape, most.shape) == ((mitsuba_render.LEAST_PASSES, 8, 8, 3), (20, 8, 8, 3))
    assert np.any(least[0] != least[1])
    np.testing.assert_allclose(least.mean(), most.mean(), rtol=0.05)


class Skewed(mitsuba_nbrdf.Nbrdf):
    """Says of every light that it is drawn five percent more often than it is."""

    def pdf(self, ctx, si, wo, active=True):
        return 1.05 * super().pdf(ctx, si, wo, active)


def test_a_density_that_is_five_percent_off_is_found(tmp_path):
    random = np.random.default_rng(11)
    layers = zip(("fc1", "b1", "fc2", "b2", "fc3", "b3"), ((6, 8), 8, (8, 8), 8, (8, 3), 3))
    np.savez(tmp_path / "a.npz", **{name: np.abs(random.normal(0, 0.1, shape)).astype(np.float32) for name, shape in layers})
    mitsuba.register_bsdf("skewed", lambda props: Skewed(props))
    environment = str(tmp_path / "white.exr")
    mitsuba.Bitmap(np.ones((8, 16, 3), np.float32)).write(environment)
    effort = {"size": 8, "samples": 25, "most_passes": 16}

    def rendered(plugin: str, way: str) -> np.ndarray:
        bsdf = mitsuba.load_dict({"type": plugin, "filename": str(tmp_path / "a.npz"), "share": 0.1, "width": 0.5})
        return mitsuba_render.around(bsdf, environment, effort, way, 0.0)

    right = rendered("nbrdf", "drawn_by_both")
    for plugin, verdict in (("nbrdf", mitsuba_judge.AGREES), ("skewed", mitsuba_judge.APART)):
        assert mitsuba_judge.noisy(rendered(plugin, "drawn_by_material"), right, 0.001)["verdict"] == verdict
