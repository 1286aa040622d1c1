"""Principal components of few long vectors, from the eigenvectors of their products (Turk and Pentland 1991, section 2)."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float


@dataclass(frozen=True, eq=False)
class Pca:
    """Mean and orthonormal components, largest variance first; of a component the largest number is positive."""

    mean: Float[np.ndarray, "length"]  # noqa: F821
    components: Float[np.ndarray, "k length"]

    @classmethod
    def learn(cls, rows: Float[np.ndarray, "m length"], count: int) -> "Pca":
        """`count` components of m rows, m > count."""
        if len(rows) <= count:
            raise ValueError(f"{count} components need more than {count} rows, found {len(rows)}")
        mean = rows.mean(axis=0)
        centred = rows - mean
        variances, vectors = np.linalg.eigh(centred @ centred.T)
        best = np.argsort(-variances)[:count]
        components = (vectors[:, best] / np.sqrt(np.maximum(variances[best], 1e-30))).T @ centred
        largest = components[np.arange(count), np.abs(components).argmax(axis=1)]
        return cls(mean, components * np.where(largest < 0, -1.0, 1.0)[:, None])

    def project(self, row: Float[np.ndarray, "length"]) -> Float[np.ndarray, "k"]:  # noqa: F821
        """Coordinates of the nearest point of what was learned."""
        return self.components @ (row - self.mean)

    def reconstruct(self, code: Float[np.ndarray, "k"]) -> Float[np.ndarray, "length"]:  # noqa: F821
        """The row with these coordinates."""
        return self.mean + code @ self.components
