import numpy as np
import pytest

from nbrdf_jax import family_ends
from nbrdf_jax.analytic import Microfacet
from nbrdf_jax.coordinates import network_inputs
from nbrdf_jax.directions import rus32k
from nbrdf_jax.families import LOBES, NAMES, Family, all_families, of_formula
from nbrdf_jax.family_ends import FamilyEnds
from nbrdf_jax.metrics import log_error
from nbrdf_jax.network import reflectance
from nbrdf_jax.places import walked


def test_families_begin_and_end_as_the_protocol_says():
    assert len(all_families()) == len(LOBES) * len(NAMES) == 16
    assert Family("roughness", "gtr1").at(1.0) == Microfacet((0.2, 0.15, 0.1), (0.04, 0.04, 0.04), 0.6, "gtr1")
    assert Family("metal", "ggx").at(1.0) == Microfacet((0.0, 0.0, 0.0), (1.0, 0.77, 0.34), 0.3, "ggx")
    assert Family("ior", "beckmann").at(0.0).f0 == pytest.approx((0.01701323,) * 3)
    assert Family("colour", "ggx").at(0.5).diffuse == pytest.approx((0.35, 0.15, 0.35))
    with pytest.raises(ValueError, match="roughness"):
        Family("weather", "ggx").at(0.5)


@pytest.mark.parametrize("family", all_families(), ids=lambda family: f"{family.lobe}-{family.name}")
def test_the_true_middle_has_no_error_and_an_end_has(family):
    places = walked(False)
    assert family.middle_error(of_formula(family.at(0.5)), places) == 0
    assert family.middle_error(of_formula(family.at(0.0)), places) > 0.005


def test_fitted_ends_come_close_to_their_formulas(monkeypatch):
    monkeypatch.setattr(family_ends, "all_families", lambda: [Family("colour", "ggx")])
    monkeypatch.setattr(family_ends, "STEPS", 500)
    monkeypatch.setattr(family_ends, "SHARED_STEPS", 100)
    start = np.random.default_rng(0).normal(0, 0.2, 675)
    ends = FamilyEnds.fitted(start)
    assert list(ends.networks) == ["family/ggx-colour-0", "family/ggx-colour-1"] == list(ends.shared)
    # From each other they are three times as far.
    light, view = (vectors[::20] for vectors in rus32k())
    inputs = network_inputs(light, view)
    for end, weights in enumerate(ends.networks.values()):
        assert log_error(Family("colour", "ggx").at(float(end))(light, view), reflectance(weights, inputs), light[:, 2]) < 0.025
