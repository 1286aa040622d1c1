import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from nbrdf_jax import metrics, physics
from nbrdf_jax.albedo import AlbedoLights
from nbrdf_jax.analytic import Microfacet
from nbrdf_jax.data import REPOSITORY
from nbrdf_jax.delta_e_itp import delta_e_itp
from nbrdf_jax.flip import flip, flip_of_displayed
from nbrdf_jax.judge import BOUNDS, KEYS, Seen, figures
from nbrdf_jax.smoothness import Smoothness, chromaticity
from nbrdf_jax.spread import Spread
from nbrdf_jax.ssim import ssim

pixels = arrays.arrays(np.float64, (12, 3), elements=st.floats(0, 1.5))
pictures = arrays.arrays(np.float64, (24, 24, 3), elements=st.floats(0, 1.5))


@settings(max_examples=40, deadline=None)
@given(pixels, pixels)
def test_distances_are_symmetric_and_zero_for_equals(a, b):
    for distance in (metrics.mae, metrics.rmse, delta_e_itp):
        assert distance(a, a) == 0 and distance(a, b) == pytest.approx(distance(b, a), abs=1e-12) and distance(a, b) >= 0
    assert metrics.psnr(a, b) == pytest.approx(min(100, -20 * np.log10(max(metrics.rmse(a, b), 1e-5))))
    assert metrics.mae(a, b) <= metrics.rmse(a, b) + 1e-12


@settings(max_examples=15, deadline=None)
@given(pictures, pictures)
def test_similarities_of_pictures_are_bounded(a, b):
    assert ssim(a, a) == pytest.approx(1) and ssim(a, b) == pytest.approx(ssim(b, a)) and ssim(a, b) <= 1 + 1e-12
    assert flip(a, a) == 0 and flip(a, b) == pytest.approx(flip(b, a)) and 0 <= flip(a, b) <= 1


def golden_images():
    for case in json.loads((REPOSITORY / "tests" / "golden" / "metrics.json").read_text())["images"]:
        shape = case["height"], case["width"], 3
        yield case, *(np.frombuffer(bytes.fromhex(case[side]), np.uint8).reshape(shape) / 204.0 for side in ("reference", "other"))


def test_flip_and_ssim_are_those_of_their_authors_programs():
    for case, reference, other in golden_images():
        errors = flip_of_displayed(metrics.display(reference), metrics.display(other))
        assert errors.mean() == pytest.approx(case["flip"], rel=1e-4), case["name"]
        assert errors.max() == pytest.approx(case["flip_max"], rel=1e-4), case["name"]
        assert ssim(reference, other) == pytest.approx(case["ssim"], rel=1e-9)


def test_the_albedo_of_formulas_is_what_a_fine_integral_gives():
    lights = AlbedoLights.around_mirror()
    assert np.bincount(lights.viewer).min() > 4096 and len(np.bincount(lights.viewer)) == 18
    assert lights.largest(np.full((len(lights.weights), 3), 0.5 / np.pi)) == pytest.approx(0.5, abs=1e-6)
    golden = json.loads((REPOSITORY / "tests" / "golden" / "metrics.json").read_text())["materials"]
    for key, degrees, expected in golden["albedo"]:
        parameters = golden.get(key) or {"diffuse": [0, 0, 0], "f0": [1, 1, 1], "alpha": 0.1}
        material = Microfacet(*(tuple(map(float, parameters[name])) for name in ("diffuse", "f0")), parameters["alpha"])
        mine = lights.viewer == degrees // 5
        found = (material(*lights.pairs) * lights.weights[:, None])[mine].sum(axis=0)
        assert found == pytest.approx(expected, rel=3e-3), (key, degrees)


def test_what_could_not_exist_is_found():
    values = np.ones((10, 3))
    values[3, 1], values[4, 2] = -1e-9, np.nan
    assert physics.negative_share(values) == 0.2
    assert physics.reciprocity(np.zeros((4, 3)), np.zeros((4, 3))) == 0
    assert physics.reciprocity(np.full((4, 3), 2.0), np.full((4, 3), 1.0)) == pytest.approx(0.5)
    assert physics.albedo_max(np.full((len(AlbedoLights.around_mirror().weights), 3), np.nan)) == np.inf


def test_every_key_is_measured_and_a_material_is_no_distance_from_itself():
    seen = Seen.of(lambda places: Microfacet((0.2, 0.1, 0.3), (0.04, 0.04, 0.04), 0.3)(places.light, places.view))
    found = figures(seen, seen)
    assert set(found) == {*KEYS, *BOUNDS}
    assert found["log_error"] == found["studio_flip"] == found["point_mae"] == found["negative_share"] == 0
    assert found["reciprocity"] < 1e-12 and 0 < found["albedo_max"] < 1


def test_a_straight_even_walk_has_ratios_of_one_and_a_detour_shows():
    grey = np.linspace(0.2, 0.6, 5)[:, None, None] * np.ones((1, 4, 3))
    straight = Smoothness.of(grey)
    assert straight.length_ratio == pytest.approx(1) and straight.hue_excursion == pytest.approx(0, abs=1e-12)
    detour = grey.copy()
    detour[2, :, 1] += 0.3
    assert Smoothness.of(detour).length_ratio > 1.2 and Smoothness.of(detour).hue_excursion > 0.01
    assert Smoothness.of(grey[:1].repeat(3, axis=0)) == Smoothness(1.0, 1.0, 0.0)
    assert chromaticity(np.ones(3)) == pytest.approx([0.1978, 0.4683], abs=1e-4)


def test_the_tail_points_to_the_bad_side():
    names, values = [f"m{i}" for i in range(11)], np.arange(11.0)
    errors, decibels = Spread.of(names, values, False), Spread.of(names, values, True)
    assert (errors.mean, errors.median, errors.p90, errors.max, errors.worst[0]) == (5, 5, 9, 10, "m10")
    assert (decibels.p90, decibels.max, decibels.worst) == (1, 0, ("m0", "m1", "m2", "m3", "m4"))
