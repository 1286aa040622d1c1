import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nbrdf_jax.analytic import Microfacet
from nbrdf_jax.directions import rus32k
from nbrdf_jax.network import reflectance
from nbrdf_jax.pca import Pca
from nbrdf_jax.pca_tables import PcaTables, stored, tabulated
from nbrdf_jax.pca_tables import reflectance as of_stored
from nbrdf_jax.places import Places
from nbrdf_jax.table_grid import CELLS, Stencil, cell_directions

seeds = st.integers(0, 2**32 - 1)


def rows(seed: int, count: int = 9, length: int = 40) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(count, length))


@settings(max_examples=50, deadline=None)
@given(seeds, st.integers(1, 8))
def test_components_are_at_right_angles_and_of_length_one(seed, count):
    components = Pca.learn(rows(seed), count).components
    assert np.allclose(components @ components.T, np.eye(count), atol=1e-9)


@settings(max_examples=50, deadline=None)
@given(seeds)
def test_projecting_again_changes_nothing_and_all_components_keep_all(seed):
    given_rows = rows(seed)
    few, whole = Pca.learn(given_rows, 3), Pca.learn(given_rows, 8)
    once = few.reconstruct(few.project(given_rows[0]))
    assert np.allclose(few.reconstruct(few.project(once)), once, atol=1e-9)
    assert np.allclose(whole.reconstruct(whole.project(given_rows[4])), given_rows[4], atol=1e-9)


def test_variances_fall_and_signs_are_fixed():
    given_rows = rows(1)
    found = Pca.learn(given_rows, 6)
    spread = ((given_rows - found.mean) @ found.components.T).var(axis=0)
    assert (np.diff(spread) <= 1e-12).all()
    assert (found.components[np.arange(6), np.abs(found.components).argmax(axis=1)] > 0).all()
    assert np.allclose(found.components, Pca.learn(given_rows[::-1], 6).components)
    with pytest.raises(ValueError, match="more than 9"):
        Pca.learn(given_rows, 9)


@settings(max_examples=100, deadline=None)
@given(st.floats(0, 1e4), st.floats(1e-3, 1))
def test_what_is_stored_comes_back(f, cosine):
    back = of_stored(stored(np.full((1, 3), f), np.array([cosine])), np.array([cosine]))
    assert np.allclose(back, f, rtol=1e-9, atol=1e-12)


def test_cells_are_read_back_in_their_middles_and_linear_between():
    light, view = cell_directions()
    assert light.shape == (np.prod(CELLS), 3) and min(light[:, 2].min(), view[:, 2].min()) > 0
    table = np.random.default_rng(2).normal(size=(np.prod(CELLS), 3))
    own = np.random.default_rng(3).integers(0, len(table), 200)
    stencil = Stencil.around(light[own], view[own])
    assert np.allclose(stencil.weights.sum(axis=1), 1)
    # Cells below the horizon are read at the place of the one they repeat.
    places = {tuple(np.round(pair, 9)): index for index, pair in enumerate(np.concatenate((light, view), axis=1)[::-1])}
    first = len(table) - 1 - np.array([places[tuple(np.round(np.concatenate((light[i], view[i])), 9))] for i in own])
    assert np.allclose(stencil.read(table), table[first], atol=1e-6)


def test_a_basis_gives_its_training_materials_back():
    materials = [Microfacet((0.1 * k, 0.05, 0.3 / k), (0.04, 0.04, 0.04), 0.2 + 0.05 * k) for k in range(1, 5)]
    tables = np.stack([tabulated(material(*cell_directions())) for material in materials])
    basis = PcaTables(Pca.learn(tables, 3))
    light, view = (vectors[::37] for vectors in rus32k())
    places = Places(light, view, {}, {})
    found = basis.decode(basis.pca.project(tables[2]))(places)
    truth = materials[2](light, view)
    upright = (light[:, 2] > 0.2) & (view[:, 2] > 0.2)
    assert np.abs(found / truth - 1)[upright].max() < 0.08


@settings(max_examples=50, deadline=None)
@given(seeds)
def test_a_network_is_the_same_whatever_the_order_and_scale_of_its_units(seed):
    random = np.random.default_rng(seed)
    weights, inputs = random.normal(0, 0.4, 675), random.uniform(-1, 1, (20, 6))
    other = weights.copy()
    first, second, scale = random.permutation(21), random.permutation(21), random.uniform(0.5, 2, 21)
    other[:126] = (weights[:126].reshape(6, 21)[:, first] * scale).ravel()
    other[126:147] = weights[126:147][first] * scale
    middle = weights[147:588].reshape(21, 21)[first] / scale[:, None]
    other[147:588] = middle[:, second].ravel()
    other[588:609] = weights[588:609][second]
    other[609:672] = weights[609:672].reshape(21, 3)[second].ravel()
    assert np.allclose(reflectance(weights, inputs), reflectance(other, inputs), rtol=1e-9, atol=1e-12)


def test_shapes_that_do_not_fit_are_refused_and_nothing_is_rounded_silently():
    with pytest.raises(Exception, match="type"):
        reflectance(np.zeros(675), np.zeros((4, 5)))
    with pytest.raises(Exception, match="(?i)promotion"):
        jnp.zeros(3, jnp.float32) + jnp.zeros(3, jnp.float64)
    with pytest.raises(Exception, match="(?i)rank"):
        jnp.zeros((2, 3)) + jnp.zeros(3)
