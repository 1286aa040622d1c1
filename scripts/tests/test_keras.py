"""What `nbrdf export --to keras` writes, read by Keras itself."""

import os
from tempfile import TemporaryDirectory

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from nbrdf_jax import coordinates, directions, network

# Keras writes its settings into the home folder when it is imported.
HOME = TemporaryDirectory()
os.environ |= {"KERAS_BACKEND": "jax", "KERAS_HOME": HOME.name}
keras = pytest.importorskip("keras", reason="Keras is not installed: pip install -e 'scripts[keras]'")


@pytest.fixture
def loosely():
    """Keras adds biases to batches, which our own code must not do unsaid."""
    with jax.numpy_rank_promotion("allow"), jax.numpy_dtype_promotion("standard"):
        yield


@pytest.mark.parametrize("by_name", [False, True])
def test_keras_loads_the_weights_into_the_model_of_the_description_and_predicts_what_the_network_does(exported, loosely, by_name):
    model = keras.models.model_from_json((exported / "chrome.json").read_text())
    model.load_weights(exported / "chrome.h5", by_name=by_name)
    arrays = np.load(exported / "chrome.npz")
    weights = np.concatenate([arrays[f"{kind}{layer}"].ravel() for layer in (1, 2, 3) for kind in ("fc", "b")]).astype(np.float64)
    light, view = (vectors[::16] for vectors in directions.rus32k())
    inputs = coordinates.network_inputs(light, view)
    # The network's last step is no layer of the model.
    predicted = np.maximum(np.expm1(np.asarray(model(jnp.asarray(inputs, np.float32)), np.float64)), 0)
    expected = network.reflectance(weights, inputs)
    assert expected.max() > 1 and np.abs(predicted - expected).max() <= 1e-5 * (1 + expected).max()
    assert np.abs(np.log1p(predicted) - np.log1p(expected)).max() < 1e-5
