"""The picture of `mitsuba_check.py`: some materials by nbrdf, as tables and as networks in Mitsuba, and where they differ."""

from io import BytesIO
from pathlib import Path

import matplotlib
import numpy as np
from PIL import Image

from mitsuba_comparison import Comparison
from mitsuba_judge import exact
from results_table import fine_percent

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402  after the backend is chosen
from matplotlib.colors import LinearSegmentedColormap  # noqa: E402

MATERIALS = ("gold-metallic-paint", "blue-acrylic", "chrome", "red-fabric")
SIZE = 192
HEADS = ("nbrdf render", "Mitsuba, measured:\nthe exported table", "Mitsuba, nbrdf:\nthe network", "table less nbrdf", "network less nbrdf")
CAPTION = f"Spheres of {SIZE} pixels under the eleven lamps of the light studio, rays through the middles of pixels.\nDifferences of luminance as shares of the picture's mean (paler: beyond):"
BACKGROUND, INK, QUIET = "#14161a", "#e8e8e8", "#a0a4ac"
# Of a pixel's difference to the mean of its picture; what is beyond has the last colour.
REACH = 0.1
SIGNED = LinearSegmentedColormap.from_list("signed", ("#a8d8ff", "#2f7fd0", "#000000", "#e06a1a", "#ffd9a8"))
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def draw(path: Path, comparison: Comparison) -> None:
    """Writes the picture, of those of its materials that are compared."""
    shown = comparison.shown([name for name in MATERIALS if name in comparison.names], SIZE)
    height = 2.05 * len(shown) + 1.25
    figure, axes = plt.subplots(len(shown), len(HEADS), figsize=(10, height), facecolor=BACKGROUND, squeeze=False)
    figure.subplots_adjust(left=0.035, right=0.995, top=1 - 0.52 / height, bottom=0.72 / height, wspace=0.03, hspace=0.12)
    for axis in axes.flat:
        axis.set(xticks=[], yticks=[])
        axis.spines[:].set_visible(False)
    for axis, head in zip(axes[0], HEADS):
        axis.set_title(head, color=INK, fontsize=9.5)
    for row, (name, (ours, *theirs)) in zip(axes, shown.items()):
        row[0].set_ylabel(name, color=INK, fontsize=10)
        for axis, pixels in zip(row, (ours, *theirs)):
            axis.imshow(displayed(pixels), interpolation="nearest")
        for axis, pixels in zip(row[3:], theirs):
            difference = (pixels - ours) @ LUMINANCE / (ours @ LUMINANCE).mean()
            axis.imshow(difference, cmap=SIGNED, vmin=-REACH, vmax=REACH, interpolation="nearest")
            elsewhere = exact(pixels, ours, 0)["elsewhere"]
            axis.set_xlabel(f"{fine_percent(elsewhere)} of the light elsewhere", color=QUIET, fontsize=8, labelpad=2)
    figure.text(0.6, 0.36 / height, CAPTION, color=QUIET, fontsize=8.5, ha="right", va="center")
    scale = figure.colorbar(axes[0, 3].images[0], cax=figure.add_axes((0.64, 0.37 / height, 0.33, 0.1 / height)), orientation="horizontal", ticks=[-REACH, 0, REACH])
    scale.ax.set_xticklabels([f"−{100 * REACH:.0f} %", "0", f"+{100 * REACH:.0f} %"], color=QUIET, fontsize=8.5)
    scale.outline.set_edgecolor(QUIET)
    path.parent.mkdir(parents=True, exist_ok=True)
    drawn = BytesIO()
    figure.savefig(drawn, dpi=100, facecolor=BACKGROUND)
    plt.close(figure)
    # Nothing is transparent.
    Image.open(drawn).convert("RGB").save(path, optimize=True)


def displayed(pixels: np.ndarray) -> np.ndarray:
    """Linear values as a display shows them (sRGB, IEC 61966-2-1)."""
    clipped = np.clip(pixels, 0, 1)
    return np.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)
