"""Half and difference vectors (Rusinkiewicz 1998, "A New Change of Variables", section 3), both ways.

Vectors are in the surface frame: +z is the normal, `light` is ω_i, `view` is ω_o. Angles are in radians.
Inputs are never folded or mirrored: φ_diff runs over the whole circle.
"""

from .arrays import Array, Inputs, Numbers, Vectors


def vectors_from_angles(theta_half: Numbers, phi_half: Numbers, theta_diff: Numbers, phi_diff: Numbers) -> tuple[Vectors, Vectors]:
    """Angles [n] each → light [n, 3], view [n, 3]."""
    xp = theta_half.__array_namespace__()
    sin_h, cos_h = xp.sin(theta_half), xp.cos(theta_half)
    d_x = xp.sin(theta_diff) * xp.cos(phi_diff)
    d_y = xp.sin(theta_diff) * xp.sin(phi_diff)
    d_z = xp.cos(theta_diff)
    # The difference vector is the light seen from the half vector: tilt by θ_half about y, then turn by φ_half about z.
    # The view is its mirror image about the half vector: d.x and d.y change sign.
    light = _turn(cos_h * d_x + sin_h * d_z, d_y, phi_half), cos_h * d_z - sin_h * d_x
    view = _turn(sin_h * d_z - cos_h * d_x, -d_y, phi_half), cos_h * d_z + sin_h * d_x
    return xp.stack((*light[0], light[1]), axis=-1), xp.stack((*view[0], view[1]), axis=-1)


def half_difference(light: Vectors, view: Vectors) -> tuple[Vectors, Vectors]:
    """light [n, 3], view [n, 3] → half [n, 3], difference [n, 3], with φ_half rotated away.

    half = (sin θ_half, 0, cos θ_half). Vectors are taken as given: the light is not normalised again.
    """
    half, difference, _ = _frame(light, view)
    return half, difference


def angles_from_vectors(light: Vectors, view: Vectors) -> tuple[Numbers, Numbers, Numbers, Numbers]:
    """light [n, 3], view [n, 3] → θ_half, φ_half, θ_diff, φ_diff, each [n]; the φ in (−π, π]."""
    xp = light.__array_namespace__()
    half, difference, phi_half = _frame(light, view)
    theta_half = xp.arctan2(half[..., 0], half[..., 2])
    theta_diff = xp.arctan2(xp.hypot(difference[..., 0], difference[..., 1]), difference[..., 2])
    return theta_half, phi_half, theta_diff, xp.arctan2(difference[..., 1], difference[..., 0])


def network_inputs(light: Vectors, view: Vectors) -> Inputs:
    """light [n, 3], view [n, 3] → [n, 6] in the order h.x h.y h.z d.x d.y d.z."""
    return light.__array_namespace__().concatenate(half_difference(light, view), axis=-1)


def _frame(light: Array, view: Array) -> tuple[Array, Array, Array]:
    xp = light.__array_namespace__()
    total = light + view
    half = total / xp.sqrt(xp.sum(total * total, axis=-1, keepdims=True))
    # hypot, not sqrt(1 − h.z²): the latter has lost half its digits where glossy materials need them.
    sin_h, cos_h = xp.hypot(half[..., 0], half[..., 1]), half[..., 2]
    phi_half = xp.arctan2(half[..., 1], half[..., 0])  # 0 where half is the normal
    along, across = _turn(light[..., 0], light[..., 1], -phi_half)
    difference = (cos_h * along - sin_h * light[..., 2], across, sin_h * along + cos_h * light[..., 2])
    upright = xp.stack((sin_h, xp.zeros_like(sin_h), cos_h), axis=-1)
    return upright, xp.stack(difference, axis=-1), phi_half


def _turn(x: Array, y: Array, phi: Array) -> tuple[Array, Array]:
    xp = x.__array_namespace__()
    cos, sin = xp.cos(phi), xp.sin(phi)
    return cos * x - sin * y, sin * x + cos * y
