"""The vase of scenes/interior.toml: a profile turned about the vertical axis, as Wavefront OBJ on standard output."""

import math

# Radius and height of the profile, from the foot to the lip and a little way inside.
PROFILE = [(0.0, 0.0), (0.24, 0.0), (0.26, 0.03), (0.22, 0.08), (0.30, 0.25), (0.38, 0.45), (0.40, 0.62), (0.34, 0.80),
           (0.22, 0.97), (0.15, 1.10), (0.14, 1.20), (0.18, 1.29), (0.22, 1.32), (0.205, 1.33), (0.16, 1.29), (0.12, 1.2)]
AROUND = 48
BETWEEN = 3


def smooth(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Catmull-Rom through the points, with BETWEEN places from each to the next."""
    out = []
    for i in range(len(points) - 1):
        p = [points[max(i - 1, 0)], points[i], points[i + 1], points[min(i + 2, len(points) - 1)]]
        for step in range(BETWEEN):
            t = step / BETWEEN
            weights = (-0.5 * t + t**2 - 0.5 * t**3, 1 - 2.5 * t**2 + 1.5 * t**3,
                       0.5 * t + 2 * t**2 - 1.5 * t**3, -0.5 * t**2 + 0.5 * t**3)
            out.append(tuple(sum(w * q[axis] for w, q in zip(weights, p)) for axis in (0, 1)))
    return [*out, points[-1]]


def main() -> None:
    """Writes vertices, then quadrilaterals seen counter-clockwise from outside."""
    rings = smooth(PROFILE)
    print("# Made by scripts/make_vase.py")
    for radius, height in rings:
        for step in range(AROUND):
            angle = 2 * math.pi * step / AROUND
            print(f"v {max(radius, 0.0) * math.cos(angle):.4f} {height:.4f} {max(radius, 0.0) * math.sin(angle):.4f}")
    for ring in range(len(rings) - 1):
        for step in range(AROUND):
            a, b = ring * AROUND + step + 1, ring * AROUND + (step + 1) % AROUND + 1
            print(f"f {a} {a + AROUND} {b + AROUND} {b}")


if __name__ == "__main__":
    main()
