"""What is learned or given once, and shared by all that is recomputed: networks, checkpoint, bases of PCA."""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from functools import cached_property

import jax
import jax.numpy as jnp
import numpy as np

from . import split
from .autoencoder import Autoencoder
from .evaluation import of_network
from .invalid import InvalidFile
from .library import Library, database
from .pca import Pca
from .pca_tables import COMPONENTS, PcaTables
from .places import Reflectance
from .workers import silent


@dataclass(eq=False)
class Learned:
    """Bases are learned when first asked for, from the training materials of MERL and nothing else."""

    networks: Library
    shared: Library  # the same materials, fitted from one shared start
    model: Autoencoder
    progress: Callable = silent

    @cached_property
    def training(self) -> list[str]:
        """MERL materials that are not held out."""
        held_out = set(split.held_out(self.networks, "merl"))
        return [name for name in self.networks if database(name) == "merl" and name not in held_out]

    @cached_property
    def tables(self) -> PcaTables:
        """PCA-32 over tables."""
        return PcaTables.learn(np.stack([self.networks[name] for name in self.training]), self.progress)

    @cached_property
    def weights(self) -> Pca:
        """PCA-32 over the weights of networks from one shared start."""
        return Pca.learn(np.stack([self.of_shared_start(name) for name in self.training]), COMPONENTS)

    def prepare(self, names: Collection[str]) -> None:
        """Learns the bases of these representations or walks now, so that it is not done twice where work is shared out."""
        for name in {"pca_tables", "pca_weights"}.intersection(names):
            _ = self.tables if name == "pca_tables" else self.weights

    def joined(self, networks: Library, shared: Library) -> "Learned":
        """With more materials, of which nothing is learned."""
        other = Learned(self.networks | networks, self.shared | shared, self.model, self.progress)
        other.training = self.training
        other.__dict__ |= {basis: self.__dict__[basis] for basis in ("tables", "weights") if basis in self.__dict__}
        return other

    def of_shared_start(self, name: str) -> np.ndarray:
        """The network of that name in the library of shared start."""
        if name not in self.shared:
            raise InvalidFile("library of shared start", f"a network {name}", f"{len(self.shared)} others", "give --shared PATH")
        return self.shared[name]

    @cached_property
    def encode(self) -> Callable:
        """weights [675] → code of the autoencoder."""
        compiled = jax.jit(self.model.encode)
        return lambda weights: np.asarray(compiled(jnp.asarray(weights)))

    @cached_property
    def decode(self) -> Callable:
        """Code of the autoencoder → weights."""
        compiled = jax.jit(self.model.decode)
        return lambda code: np.asarray(compiled(jnp.asarray(code)))

    def decoded(self, representation: str, code: np.ndarray) -> Reflectance:
        """The reflectance that a code stands for."""
        match representation:
            case "znbrdf":
                return of_network(self.decode(code), self.model.widths)
            case "pca_tables":
                return self.tables.decode(code)
            case "pca_weights":
                return of_network(self.weights.reconstruct(code))
            case _:
                raise ValueError(f"unknown representation {representation}")

    def own_code(self, representation: str, variant: str, name: str) -> np.ndarray | None:
        """The code made here; none where a code was refined, which is not repeated."""
        match representation, variant:
            case "znbrdf", "feed_forward":
                return self.encode(self.networks[name])
            case "pca_tables", "projection":
                return self.tables.encode(self.networks[name])
            case "pca_weights", "projection":
                return self.weights.project(self.of_shared_start(name))
            case _:
                return None

    def code_size(self, representation: str) -> int:
        """Numbers of a code."""
        return self.model.code_size if representation == "znbrdf" else COMPONENTS
