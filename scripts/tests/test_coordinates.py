import jax.numpy as jnp
import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from nbrdf_jax.coordinates import angles_from_vectors, half_difference, vectors_from_angles
from nbrdf_jax.directions import golden_directions, rus32k

quarter = st.floats(1e-3, np.pi / 2 - 1e-3)
turn = st.floats(-np.pi + 1e-6, np.pi - 1e-6)


def pair(*angles: float) -> tuple[np.ndarray, np.ndarray]:
    return vectors_from_angles(*(np.array([angle]) for angle in angles))


@settings(max_examples=300, deadline=None)
@given(quarter, turn, quarter, turn)
def test_angles_survive_the_round_trip(theta_half, phi_half, theta_diff, phi_diff):
    light, view = pair(theta_half, phi_half, theta_diff, phi_diff)
    assume(light[0, 2] > 0 and view[0, 2] > 0)
    back = np.array(angles_from_vectors(light, view))[:, 0]
    difference = np.array([theta_half, phi_half, theta_diff, phi_diff]) - back
    assert np.abs(np.angle(np.exp(1j * difference))).max() < 1e-8


@settings(max_examples=100, deadline=None)
@given(quarter, turn, quarter, turn)
def test_vectors_have_length_one_and_half_lies_between(theta_half, phi_half, theta_diff, phi_diff):
    light, view = pair(theta_half, phi_half, theta_diff, phi_diff)
    assert np.allclose(np.linalg.norm([light, view], axis=-1), 1, atol=1e-14)
    between = (light + view) / np.linalg.norm(light + view)
    half = [np.sin(theta_half) * np.cos(phi_half), np.sin(theta_half) * np.sin(phi_half), np.cos(theta_half)]
    assert np.allclose(between, [half], atol=1e-12)


def test_the_difference_vector_is_the_light_not_the_view():
    light, view = pair(0.0, 0.0, 0.5, 0.3)
    _, difference = half_difference(light, view)
    assert np.allclose(difference, light) and not np.allclose(difference, view)


def test_turning_both_about_the_normal_changes_nothing():
    light, view = rus32k()
    cos, sin = np.cos(1.1), np.sin(1.1)
    turn = np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1]])
    for before, after in zip(half_difference(light, view), half_difference(light @ turn.T, view @ turn.T)):
        assert np.allclose(before, after, atol=1e-12)


def test_half_stays_exact_near_the_normal():
    light, view = pair(1e-9, 0.7, 0.4, 0.2)
    half, _ = half_difference(light, view)
    assert abs(half[0, 0] / 1e-9 - 1) < 1e-6 and half[0, 1] == 0


def test_numpy_and_jax_agree():
    light, view = rus32k()
    for ours, theirs in zip(half_difference(light, view), half_difference(jnp.asarray(light), jnp.asarray(view))):
        assert np.allclose(ours, theirs, atol=1e-15)


def test_the_direction_set_is_the_protocols():
    light, view = rus32k()
    assert light.shape == (20231, 3)
    theta_half, phi_half, theta_diff, phi_diff = angles_from_vectors(light, view)
    g = 1.2207440846057596
    first = np.array([0.5 + g**-1, 0.5 + g**-2, 0.5 + g**-3]) % 1
    assert np.allclose(g**4, g + 1) and np.allclose(phi_half, 0, atol=1e-12)
    assert np.allclose([theta_half[0], theta_diff[0], phi_diff[0] % (2 * np.pi)], first * [np.pi / 2, np.pi / 2, 2 * np.pi])
    assert (phi_diff < 0).any() and (phi_diff > 0).any()


def test_golden_directions_are_float32_above_the_horizon():
    light, view = golden_directions()
    assert light.dtype == view.dtype == np.float32 and light.shape == view.shape == (1000, 3)
    assert min(light[:, 2].min(), view[:, 2].min()) > 0
