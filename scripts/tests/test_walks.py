import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nbrdf_jax import physics
from nbrdf_jax.interpolation import standard_pairs
from nbrdf_jax.places import Places, lights_of_albedo
from nbrdf_jax.walks import LIMIT, Bounded, End, Mix, NearestEnd, Straight, between_weights

AT = Places(np.array([[0.6, 0.0, 0.8]]), np.array([[0.0, 0.6, 0.8]]), {}, {})


def grey(albedo: float):
    return lambda places: np.full_like(places.light, albedo / np.pi)


def ends(first: float = 0.2, second: float = 0.8) -> tuple[End, End]:
    return End(grey(first)), End(grey(second))


def shown(walk, t: float) -> float:
    return float(walk.at(t)(AT)[0, 0] * np.pi)


@settings(max_examples=60, deadline=None)
@given(st.floats(0.01, 0.9), st.floats(0.01, 0.9), st.floats(0, 1))
def test_mixes_begin_and_end_at_their_ends_and_stay_between(first, second, t):
    for floor in (None, 1e-3, 1.0):
        walk = Mix(ends(first, second), floor)
        assert shown(walk, 0.0) == pytest.approx(first) and shown(walk, 1.0) == pytest.approx(second)
        assert min(first, second) - 1e-9 <= shown(walk, t) <= max(first, second) + 1e-9
        assert shown(walk, t) == pytest.approx(shown(Mix(ends(second, first), floor), 1 - t))


def test_logarithmic_mixes_are_darker_than_the_linear_one():
    linear, log1p, log = (shown(Mix(ends(), floor), 0.5) for floor in (None, 1.0, 1e-3))
    assert linear == pytest.approx(0.5) and linear > log1p > log > 0.2


def test_the_nearest_end_jumps_behind_the_middle():
    walk = NearestEnd(ends())
    assert [shown(walk, t) for t in (0.0, 0.5, 0.51, 1.4)] == pytest.approx([0.2, 0.2, 0.8, 0.8])


def test_walks_are_straight_in_their_codes():
    seen = []
    walk = Straight((np.zeros(2), np.ones(2)), lambda code: seen.append(code) or grey(0.5))
    walk.at(0.25), walk.at(1.5)
    assert np.allclose(seen, [[0.25, 0.25], [1.5, 1.5]])
    random = np.random.default_rng(0)
    first, second = random.normal(0, 0.2, (2, 675))
    assert np.allclose(between_weights(first, second).at(0.0)(AT), between_weights(second, first).at(1.0)(AT))


def test_beyond_the_ends_a_bounded_walk_slows_down_and_stays_possible():
    walk = Bounded(Mix(ends()))
    places = [shown(walk, 1 + k / 8) for k in range(33)]
    assert (np.diff(places) >= 0).all() and places[-1] <= LIMIT + 1e-6 and places[-1] > 0.9
    assert shown(walk, 0.5) == pytest.approx(0.5)
    assert physics.albedo_max(walk.at(5.0)(lights_of_albedo())) <= LIMIT + 1e-6
    # An end that is too bright is not left.
    assert shown(Bounded(Mix(ends(0.2, 0.995))), 1.5) == pytest.approx(0.995)


def test_pairs_are_thirty_seven_apart():
    pairs = standard_pairs([f"m{i:03}" for i in range(100)] + ["rgl/x"], 100)
    assert pairs[0] == ("m000", "m037") and pairs[99] == ("m099", "m036") and len(pairs) == 100
