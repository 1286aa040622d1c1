from itertools import permutations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from safetensors.numpy import save_file

from nbrdf_jax import autoencoder
from nbrdf_jax.invalid import InvalidFile
from nbrdf_jax.network import reflectance

SHARED, CHANNEL = 5, 2


@pytest.fixture(scope="module")
def model(module_checkpoint):
    return autoencoder.read(module_checkpoint)


@pytest.fixture(scope="module")
def compiled(model):
    """Encoding and decoding, each compiled whole: one by one their operations take longer."""
    return jax.jit(model.encode), jax.jit(model.decode)


def permuted_weights(weights: np.ndarray, order: tuple[int, ...]) -> np.ndarray:
    """The network whose colour channels are those of `weights` in another order."""
    result = weights.copy()
    result[609:672] = weights[609:672].reshape(21, 3)[:, order].ravel()
    result[672:] = weights[672:][list(order)]
    return result


def permuted_code(code: np.ndarray, order: tuple[int, ...]) -> np.ndarray:
    return np.concatenate((code[:SHARED], code[SHARED:].reshape(3, CHANNEL)[list(order)].ravel()))


def test_sizes_come_from_the_tensors(model):
    assert (model.shared_size, model.channel_size, model.code_size) == (5, 2, 11)
    assert model.widths == (6, 21, 21, 3)


@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_permuting_rgb_permutes_the_code_and_back(compiled, order):
    encode, decode = compiled
    weights = np.random.default_rng(3).normal(0, 0.3, 675)
    code = np.asarray(encode(jnp.asarray(weights)))
    other = np.asarray(encode(jnp.asarray(permuted_weights(weights, order))))
    assert np.allclose(other, permuted_code(code, order), atol=1e-12)
    decoded = np.asarray(decode(jnp.asarray(permuted_code(code, order))))
    assert np.allclose(decoded, permuted_weights(np.asarray(decode(jnp.asarray(code))), order), atol=1e-12)


def test_the_code_ignores_neuron_order_and_scale(compiled):
    encode, _ = compiled
    weights = np.random.default_rng(4).normal(0, 0.3, 675)
    shuffle, scale = np.random.default_rng(5).permutation(21), np.linspace(0.5, 2, 21)
    other = weights.copy()
    other[:126] = (weights[:126].reshape(6, 21)[:, shuffle] * scale).ravel()
    other[126:147] = weights[126:147][shuffle] * scale
    other[147:588] = (weights[147:588].reshape(21, 21)[shuffle] / scale[:, None]).ravel()
    assert np.allclose(encode(jnp.asarray(weights)), encode(jnp.asarray(other)), atol=1e-10)


def test_equals_a_literal_forward(compiled, tensors):
    encode, decode = compiled
    t = {name: tensor.astype(np.float64) for name, tensor in tensors.items()}
    weights = np.random.default_rng(6).normal(0, 0.3, 675)

    def silu(x):
        return x / (1 + np.exp(-x))

    def mlp(name, x, last):
        for i in range(3):
            x = t[f"{name}.{i}.weight"] @ x + t[f"{name}.{i}.bias"]
            x = silu(x) if last or i < 2 else x
        return x

    f = reflectance(weights, t["probes"])
    seen = [(np.log(f[:, c] * t["probe_cosine"] + 1e-3) + 3.5) / 2 for c in range(3)]
    mean = sum(seen) / 3
    deviation = sum(abs(x - mean) for x in seen) / 3
    own = [mlp("encoder.body", np.concatenate((x, mean, deviation)), True) for x in seen]
    middle = sum(own) / 3
    shared = t["encoder.shared.weight"] @ middle + t["encoder.shared.bias"]
    channels = [t["encoder.channel.weight"] @ np.concatenate((e, middle)) + t["encoder.channel.bias"] for e in own]
    code = np.concatenate((shared, *channels))
    assert np.allclose(encode(jnp.asarray(weights)), code, atol=1e-12)

    delta = np.zeros(675)
    common = np.concatenate((shared, sum(channels) / 3))
    delta[:609] = mlp("decoder.trunk", common, False)
    for c in range(3):
        head = mlp("decoder.head", np.concatenate((common, channels[c])), False)
        delta[609 + c : 672 : 3], delta[672 + c] = head[:21], head[21]
    assert np.allclose(decode(jnp.asarray(code)), t["start"] + t["spread"] * delta, atol=1e-12)


def test_a_foreign_or_broken_checkpoint_is_named(tensors, tmp_path):
    path = tmp_path / "broken.safetensors"
    with pytest.raises(InvalidFile, match="no such file"):
        autoencoder.read(path)
    path.write_bytes(b"not a tensor file")
    with pytest.raises(InvalidFile, match="checkpoint"):
        autoencoder.read(path)
    save_file(tensors, path, metadata={"model": "other"})
    with pytest.raises(InvalidFile, match="'other'"):
        autoencoder.read(path)
    save_file({k: v for k, v in tensors.items() if k != "probes"}, path, metadata={"model": "znbrdf"})
    with pytest.raises(InvalidFile, match="probes"):
        autoencoder.read(path)
    save_file(tensors | {"decoder.head.0.weight": np.zeros((9, 4), np.float32)}, path, metadata={"model": "znbrdf"})
    with pytest.raises(InvalidFile, match="decoder.head.0.weight"):
        autoencoder.read(path)
