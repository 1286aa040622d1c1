"""LDR-FLIP (Andersson et al. 2020, doi 10.1145/3406183) at 67 pixels per degree, of displayed pictures.

Sections in brackets below are the paper's.
"""

from functools import cache

import numpy as np
from jaxtyping import Float

from .arrays import Picture
from .metrics import display
from .smoothness import XYZ_FROM_BT709

PIXELS_PER_DEGREE = 67.0
COLOUR, FEATURE = 0.7, 0.5  # exponents q_c [4.1.3] and q_f [4.2]
P_C, P_T = 0.4, 0.95  # [4.1.3]
EDGE_WIDTH = 0.082  # degrees [4.2]
# Contrast sensitivity [4.1.1, table 1]: (a₁, b₁, a₂, b₂) of the channels Y, C_x, C_z.
SENSITIVITY = ((1.0, 0.0047, 0.0, 1e-5), (1.0, 0.0053, 0.0, 1e-5), (34.1, 0.04, 13.5, 0.025))
WHITE = XYZ_FROM_BT709 @ np.ones(3)


def flip(reference: Picture, other: Picture) -> float:
    """Linear pictures → mean over all pixels, 0..1."""
    return float(flip_of_displayed(display(reference), display(other)).mean())


def flip_of_displayed(reference: Picture, other: Picture) -> Float[np.ndarray, "height width"]:
    """Displayed pictures, read as sRGB → FLIP of every pixel, 0..1."""
    a, b = (_opponent(_linear(picture)) for picture in (reference, other))
    colour = _stretched(_hyab(_filtered(a), _filtered(b)) ** COLOUR)
    lightness = [(picture[..., 0] + 16) / 116 for picture in (a, b)]
    edge, point = (np.abs(np.hypot(*_detected(lightness[0], order)) - np.hypot(*_detected(lightness[1], order))) for order in (1, 2))
    feature = (np.maximum(edge, point) / np.sqrt(2)) ** FEATURE
    return colour ** (1 - feature)


def _linear(displayed: Picture) -> Picture:
    return np.where(displayed <= 0.04045, displayed / 12.92, ((displayed + 0.055) / 1.055) ** 2.4)


def _opponent(linear: Picture) -> Picture:
    """Linear BT.709 → Y C_x C_z [4.1.1]."""
    x, y, z = np.moveaxis(linear @ XYZ_FROM_BT709.T / WHITE, -1, 0)
    return np.stack((116 * y - 16, 500 * (x - y), 200 * (y - z)), axis=-1)


def _from_opponent(opponent: Picture) -> Picture:
    y = (opponent[..., 0] + 16) / 116
    xyz = np.stack((y + opponent[..., 1] / 500, y, y - opponent[..., 2] / 200), axis=-1) * WHITE
    return xyz @ np.linalg.inv(XYZ_FROM_BT709).T


def _filtered(opponent: Picture) -> Picture:
    """What the eye keeps of colours, as L*a*b* with Hunt's adjustment [4.1.1, 4.1.2]."""
    blurred = np.stack([_convolved(opponent[..., channel], kernel) for channel, kernel in enumerate(_eye())], axis=-1)
    return _hunt(np.clip(_from_opponent(blurred), 0, 1))


@cache
def _eye() -> tuple[np.ndarray, ...]:
    """The kernel of every opponent channel, of sum 1."""
    widest = max(b for _, b1, _, b2 in SENSITIVITY for b in (b1, b2))
    radius = int(np.ceil(3 * np.sqrt(widest / (2 * np.pi**2)) * PIXELS_PER_DEGREE))
    squared = ((np.arange(-radius, radius + 1) / PIXELS_PER_DEGREE) ** 2)[:, None] + ((np.arange(-radius, radius + 1) / PIXELS_PER_DEGREE) ** 2)[None, :]
    kernels = []
    for a1, b1, a2, b2 in SENSITIVITY:
        kernel = a1 * np.sqrt(np.pi / b1) * np.exp(-(np.pi**2) / b1 * squared) + a2 * np.sqrt(np.pi / b2) * np.exp(-(np.pi**2) / b2 * squared)
        kernels.append(kernel / kernel.sum())
    return tuple(kernels)


def _hunt(linear: Picture) -> Picture:
    scaled = linear @ XYZ_FROM_BT709.T / WHITE
    small = 6 / 29
    root = np.where(scaled > small**3, np.cbrt(scaled), scaled / (3 * small**2) + 4 / 29)
    lightness = 116 * root[..., 1] - 16
    red_green, blue_yellow = 500 * (root[..., 0] - root[..., 1]), 200 * (root[..., 1] - root[..., 2])
    return np.stack((lightness, 0.01 * lightness * red_green, 0.01 * lightness * blue_yellow), axis=-1)


def _hyab(a: Picture, b: Picture) -> np.ndarray:
    difference = a - b
    return np.abs(difference[..., 0]) + np.hypot(difference[..., 1], difference[..., 2])


def _stretched(powered: np.ndarray) -> np.ndarray:
    """To 0..1: differences up to P_C of the largest take P_T of it [4.1.3]."""
    green, blue = (_hunt(np.array([[colour]])) for colour in ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]))
    largest = float(_hyab(green, blue).item()) ** COLOUR
    low = P_C * largest
    return np.where(powered < low, P_T / low * powered, P_T + (powered - low) / (largest - low) * (1 - P_T))


def _detected(lightness: np.ndarray, order: int) -> tuple[np.ndarray, np.ndarray]:
    """Edges (first derivative of a Gaussian) or points (second), along x and along y [4.2]."""
    deviation = 0.5 * EDGE_WIDTH * PIXELS_PER_DEGREE
    radius = int(np.ceil(3 * deviation))
    x = np.arange(-radius, radius + 1.0)
    gauss = np.exp(-(x**2) / (2 * deviation**2))
    slope = -x * gauss if order == 1 else (x**2 / deviation**2 - 1) * gauss
    kernel = gauss[:, None] * slope[None, :]
    # Both signs of the kernel are normalised to sum 1.
    kernel = np.where(kernel > 0, kernel / kernel[kernel > 0].sum(), kernel / -kernel[kernel < 0].sum())
    return _convolved(lightness, kernel), _convolved(lightness, kernel.T)


def _convolved(plane: np.ndarray, kernel: np.ndarray) -> np.ndarray:
    """Correlation [height, width]; beyond the edge the nearest pixel counts."""
    radius = len(kernel) // 2
    padded = np.pad(plane, radius, mode="edge")
    shape = [extent + len(kernel) for extent in padded.shape]
    spectrum = np.fft.rfft2(padded, shape) * np.fft.rfft2(kernel[::-1, ::-1], shape)
    return np.fft.irfft2(spectrum, shape)[2 * radius : 2 * radius + plane.shape[0], 2 * radius : 2 * radius + plane.shape[1]]
