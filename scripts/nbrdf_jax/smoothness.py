"""How a walk from one material to another looks: `length_ratio`, `step_ratio`, `hue_excursion`."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from .delta_e_itp import distance, itp

# Linear BT.709 → XYZ: IEC 61966-2-1, from the primaries and D65 of BT.709.
_PRIMARIES = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
_WHITE = np.array([0.3127, 0.3290])


@dataclass(frozen=True)
class Smoothness:
    """The three figures of one walk."""

    length_ratio: float
    step_ratio: float
    hue_excursion: float

    @classmethod
    def of(cls, pictures: Float[np.ndarray, "t p 3"]) -> "Smoothness":
        """Linear radiance of the covered pixels, t = 0 to 1 in even steps."""
        seen = [itp(picture) for picture in pictures]
        steps = np.array([float(distance(a, b)) for a, b in zip(seen, seen[1:])])
        length = steps.sum()
        if length == 0:
            return cls(1.0, 1.0, hue_excursion(pictures))
        ends = float(distance(seen[0], seen[-1]))
        return cls(float(length / ends) if ends > 0 else float("inf"), float(steps.max() / steps.mean()), hue_excursion(pictures))


def hue_excursion(pictures: Float[np.ndarray, "t p 3"]) -> float:
    """Largest distance in u′v′ of the pictures' mean colours from the segment between those of the ends."""
    colours = np.stack([chromaticity(np.clip(picture, 0, 1).mean(axis=0)) for picture in pictures])
    along, offset = colours[-1] - colours[0], colours - colours[0]
    length2 = along @ along
    share = np.clip(offset @ along / length2, 0, 1) if length2 > 0 else np.zeros(len(colours))
    return float(np.linalg.norm(offset - share[:, None] * along, axis=1).max())


def chromaticity(linear: Float[np.ndarray, "3"]) -> Float[np.ndarray, "2"]:
    """Linear BT.709 → CIE 1976 u′v′; black counts as white light."""
    x, y, z = XYZ_FROM_BT709 @ (linear if linear.any() else np.ones(3))
    return np.array([4 * x, 9 * y]) / (x + 15 * y + 3 * z)


def _xyz_from_primaries() -> np.ndarray:
    xyz = [np.array([x / y, 1, (1 - x - y) / y]) for x, y in (*_PRIMARIES, _WHITE)]
    matrix = np.stack(xyz[:3], axis=1)
    return matrix * np.linalg.solve(matrix, xyz[3])


XYZ_FROM_BT709 = _xyz_from_primaries()
