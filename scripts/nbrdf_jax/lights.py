"""The two lights of measurement: `point` and `studio`, as directional lamps. The viewer is at +z, y is up."""

import numpy as np

KEYS = (
    ((0.5, 0.6, 0.8), (0.75, 0.72, 0.68)),
    ((-0.7, 0.3, 0.6), (0.25, 0.28, 0.32)),
    ((0.1, -0.5, 0.9), (0.15, 0.15, 0.15)),
)
FILLS = 8
FILL = 0.03


def lamps(name: str) -> tuple[np.ndarray, np.ndarray]:
    """`point` or `studio` → directions [lamps, 3] of length 1, irradiance [lamps, 3] in units of π."""
    directions, irradiance = {"point": _point, "studio": _studio}[name]()
    return directions / np.linalg.norm(directions, axis=1, keepdims=True), irradiance


def _point() -> tuple[np.ndarray, np.ndarray]:
    return np.array([[1.0, 0.0, 1.0]]), np.ones((1, 3))


def _studio() -> tuple[np.ndarray, np.ndarray]:
    k = np.arange(FILLS)
    azimuth, polar = k * np.pi / 4, np.radians(np.where(k % 2 == 0, 75.0, 50.0))
    fills = np.stack((np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)), axis=1)
    directions = np.concatenate((np.array([direction for direction, _ in KEYS]), fills))
    return directions, np.concatenate((np.array([colour for _, colour in KEYS]), np.full((FILLS, 3), FILL)))
