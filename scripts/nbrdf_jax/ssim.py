"""SSIM (Wang et al. 2004, doi 10.1109/TIP.2003.819861): Gaussian 11 × 11, σ 1.5, K 0.01 and 0.03, population covariance."""

import numpy as np
from jaxtyping import Float

from .arrays import Picture
from .metrics import display

RADIUS = 5
SIGMA = 1.5
C1, C2 = 0.01**2, 0.03**2


def ssim(reference: Picture, other: Picture) -> float:
    """Linear pictures [size, size, 3] → mean over channels and all pixels but a border of 5."""
    a, b = display(reference), display(other)
    mean_a, mean_b = _blur(a), _blur(b)
    var_a, var_b = _blur(a * a) - mean_a**2, _blur(b * b) - mean_b**2
    covariance = _blur(a * b) - mean_a * mean_b
    luminance = (2 * mean_a * mean_b + C1) / (mean_a**2 + mean_b**2 + C1)
    structure = (2 * covariance + C2) / (var_a + var_b + C2)
    return float(np.mean(luminance * structure))


def _blur(picture: Picture) -> Float[np.ndarray, "rows columns 3"]:
    """[h, w, 3] → [h − 10, w − 10, 3]: only where the whole window fits, which leaves the border of 5 out."""
    offsets = np.arange(-RADIUS, RADIUS + 1)
    window = np.exp(-(offsets**2) / (2 * SIGMA**2))
    window /= window.sum()
    height, width = (extent - 2 * RADIUS for extent in picture.shape[:2])
    rows = sum(weight * picture[start : start + height] for start, weight in enumerate(window))
    return sum(weight * rows[:, start : start + width] for start, weight in enumerate(window))
