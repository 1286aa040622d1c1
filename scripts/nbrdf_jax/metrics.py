"""Metrics of directions (f, g [n, 3], cosine [n]) and of pictures (linear radiance of covered pixels [pixels, 3]).

All take the reference first. `display` is what MAE, RMSE, PSNR and SSIM look at.
"""

from .arrays import Array, Numbers, Pixels, Scalar, Vectors

PSNR_CAP = 100.0


def log_error(f: Vectors, g: Vectors, cosine: Numbers) -> Scalar | float:
    """Mean |ln(1 + f c) − ln(1 + g c)|: the loss of the NBRDF paper (eq. 2)."""
    xp = f.__array_namespace__()
    c = cosine[:, None]
    return xp.mean(xp.abs(xp.log1p(f * c) - xp.log1p(g * c)))


def relative_log(f: Vectors, g: Vectors, cosine: Numbers) -> Scalar | float:
    """Mean |ln(f c + 10⁻³) − ln(g c + 10⁻³)|: weighs dark materials."""
    xp = f.__array_namespace__()
    c = cosine[:, None]
    return xp.mean(xp.abs(xp.log(f * c + 1e-3) - xp.log(g * c + 1e-3)))


def display(radiance: Array) -> Array:
    """Linear radiance → displayed value in [0, 1], any shape."""
    return radiance.__array_namespace__().clip(radiance, 0.0, 1.0) ** (1 / 2.2)


def mae(reference: Pixels, other: Pixels) -> Scalar | float:
    """Mean absolute difference of displayed pixels."""
    xp = reference.__array_namespace__()
    return xp.mean(xp.abs(display(reference) - display(other)))


def rmse(reference: Pixels, other: Pixels) -> Scalar | float:
    """Root of the mean squared difference of displayed pixels, over pixels and channels."""
    xp = reference.__array_namespace__()
    return xp.sqrt(xp.mean((display(reference) - display(other)) ** 2))


def psnr(reference: Pixels, other: Pixels) -> Scalar | float:
    """Decibels of displayed pixels, at most 100 (equal pictures would be infinite)."""
    xp = reference.__array_namespace__()
    floor = 10 ** (-PSNR_CAP / 20)
    return -20 * xp.log10(xp.maximum(rmse(reference, other), floor))
