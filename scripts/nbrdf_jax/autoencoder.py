"""ZNBRDF: 675 weights → 32 numbers → 675 weights, the three colour channels treated alike.

Code = [shared S, channel r C, channel g C, channel b C]. The encoder looks at what the network *does* at fixed probes, so
neuron order and scale cannot matter. The decoder's trunk gives layers 1–2, its head one column of layer 3 per channel.
Permuting RGB permutes the code exactly. All sizes are read from the tensors.
"""

from dataclasses import dataclass
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float
from safetensors import SafetensorError, safe_open

from .arrays import Array, Code, Weights
from .invalid import InvalidFile
from .network import reflectance, size

CHANNELS = 3
ENCODER = ("encoder.body.0", "encoder.body.1", "encoder.body.2")
TRUNK = ("decoder.trunk.0", "decoder.trunk.1", "decoder.trunk.2")
HEAD = ("decoder.head.0", "decoder.head.1", "decoder.head.2")
LINEAR = (*ENCODER, "encoder.shared", "encoder.channel", *TRUNK, *HEAD)
VECTORS = ("probes", "probe_cosine", "start", "spread")


@dataclass(frozen=True)
class Autoencoder:
    """A checkpoint's tensors by name, float64."""

    tensors: dict[str, Array]

    @property
    def shared_size(self) -> int:
        """S, numbers of the code that all channels share."""
        return self.tensors["encoder.shared.weight"].shape[0]

    @property
    def channel_size(self) -> int:
        """C, numbers of the code of one channel."""
        return self.tensors["encoder.channel.weight"].shape[0]

    @property
    def code_size(self) -> int:
        """S + 3 C."""
        return self.shared_size + CHANNELS * self.channel_size

    @property
    def widths(self) -> tuple[int, int, int, int]:
        """Widths of the decoded network: trunk = 7 a + (a + 1) b weights, head = b + 1."""
        b = self.tensors["decoder.head.2.bias"].shape[0] - 1
        a = (self.tensors["decoder.trunk.2.bias"].shape[0] - b) // (7 + b)
        return (6, a, b, CHANNELS)

    def encode(self, weights: Weights) -> Code:
        """weights [675] of any network → code [S + 3 C]."""
        t = self._features(reflectance(weights, self.tensors["probes"]))
        mean = _mean_channel(t)
        seen = jnp.concatenate((t, mean, _mean_channel(jnp.abs(t - mean))), axis=1)
        own = self._mlp(ENCODER, seen, last_active=True)
        mean_own = _mean_channel(own)
        shared = self._linear("encoder.shared", mean_own[:1])[0]
        channels = self._linear("encoder.channel", jnp.concatenate((own, mean_own), axis=1))
        return jnp.concatenate((shared, channels.reshape(-1)))

    def decode(self, code: Code) -> Weights:
        """code [S + 3 C] → weights [675]."""
        shared, own = code[: self.shared_size], code[self.shared_size :].reshape(CHANNELS, self.channel_size)
        common = jnp.concatenate((shared, jnp.mean(own, axis=0)))[None, :]
        trunk = self._mlp(TRUNK, common)[0]
        seen = jnp.concatenate((jnp.broadcast_to(common, (CHANNELS, common.shape[1])), own), axis=1)
        columns = self._mlp(HEAD, seen).T  # [b + 1, 3]: the layer-3 kernel row by row, then its bias
        return self.tensors["start"] + self.tensors["spread"] * jnp.concatenate((trunk, columns.reshape(-1)))

    def _features(self, f: Float[Array, "probes 3"]) -> Float[Array, "3 probes"]:
        """f at the probes [probes, 3] → t [3, probes]."""
        return (jnp.log(f * self.tensors["probe_cosine"][:, None] + 1e-3).T + 3.5) / 2

    def _linear(self, name: str, x: Float[Array, "n inputs"]) -> Float[Array, "n outputs"]:
        """x [n, in] → [n, out]; the stored weight is [out, in]."""
        return x @ self.tensors[f"{name}.weight"].T + self.tensors[f"{name}.bias"][None, :]

    def _mlp(self, names: tuple[str, ...], x: Float[Array, "n inputs"], last_active: bool = False) -> Float[Array, "n outputs"]:
        for index, name in enumerate(names):
            x = self._linear(name, x)
            if last_active or index + 1 < len(names):
                x = jax.nn.silu(x)
        return x


def _mean_channel(x: Float[Array, "3 n"]) -> Float[Array, "3 n"]:
    """x [3, n] → the mean over channels, repeated for each channel [3, n]."""
    return jnp.broadcast_to(jnp.mean(x, axis=0, keepdims=True), x.shape)


def read(path: Path | str) -> Autoencoder:
    """A .safetensors checkpoint, every size checked against every other."""
    path = Path(path)
    if not path.is_file():
        raise InvalidFile(path, "a ZNBRDF checkpoint", "no such file", "nbrdf train -o " + str(path))
    try:
        with safe_open(path, framework="numpy") as file:
            model = (file.metadata() or {}).get("model")
            tensors = {name: file.get_tensor(name) for name in file.keys()}
    except (SafetensorError, OSError) as error:
        raise InvalidFile(path, "a ZNBRDF checkpoint (.safetensors)", str(error)) from error
    if model != "znbrdf":
        raise InvalidFile(path, 'metadata "model" = "znbrdf"', repr(model))
    wanted = VECTORS + tuple(f"{name}.{part}" for name in LINEAR for part in ("weight", "bias"))
    missing = [name for name in wanted if name not in tensors]
    if missing:
        raise InvalidFile(path, f"tensors {', '.join(missing)}", "none of these names")
    for name in wanted:
        if tensors[name].dtype != np.float32:
            raise InvalidFile(path, f"F32 for {name}", str(tensors[name].dtype))
    _check_sizes(path, {name: tensors[name].shape for name in wanted})
    return Autoencoder({name: jnp.asarray(tensors[name], dtype=jnp.float64) for name in wanted})


def _check_sizes(path: Path, shapes: dict[str, tuple[int, ...]]) -> None:
    probes = shapes["probes"][0]
    hidden = shapes["encoder.body.2.weight"][0]
    shared, channel = shapes["encoder.shared.weight"][0], shapes["encoder.channel.weight"][0]
    b = shapes["decoder.head.2.weight"][0] - 1
    a = (shapes["decoder.trunk.2.weight"][0] - b) // (7 + b)
    inputs = {"encoder.body.0": 3 * probes, "encoder.shared": hidden, "encoder.channel": 2 * hidden}
    inputs |= {"decoder.trunk.0": shared + channel, "decoder.head.0": shared + 2 * channel}
    for chain in (ENCODER, TRUNK, HEAD):
        inputs |= {later: shapes[f"{earlier}.weight"][0] for earlier, later in zip(chain, chain[1:])}
    total = (size((6, a, b, CHANNELS)),)
    expected = {"probes": (probes, 6), "probe_cosine": (probes,), "start": total, "spread": total}
    expected |= {"decoder.trunk.2.bias": (7 * a + (a + 1) * b,)}
    for name, columns in inputs.items():
        expected |= {f"{name}.weight": (shapes[f"{name}.weight"][0], columns)}
        expected.setdefault(f"{name}.bias", shapes[f"{name}.weight"][:1])
    for name, shape in expected.items():
        if shapes[name] != shape:
            raise InvalidFile(path, f"{name} of shape {list(shape)}", str(list(shapes[name])))
