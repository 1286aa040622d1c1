"""The pictures of the report, as SVG. Titles say what was found; axes say their units."""

import io
from collections.abc import Sequence

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from .agreement import Check
from .held_out import Recomputed
from .interpolation import Walked

matplotlib.rcParams |= {"svg.hashsalt": "nbrdf", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.titlelocation": "left"}
ZERO = 1e-16  # where equal figures are drawn


def differences(checks: Sequence[Check], tolerance: float) -> Figure:
    """Relative difference of every figure, one row per key."""
    checks = [check for check in checks if "(its own" not in check.label]
    keys = sorted({check.key.split()[0] for check in checks}, reverse=True)
    figure = Figure(figsize=(8, 0.24 * len(keys) + 1.3), layout="constrained")
    axes = figure.subplots()
    for place, key in enumerate(keys):
        apart = [max(check.difference, ZERO) for check in checks if check.key.split()[0] == key]
        axes.plot(apart, [place] * len(apart), "o", markersize=4, alpha=0.5, color="tab:blue")
    axes.axvline(tolerance, color="tab:red", linewidth=1, label=f"tolerance {tolerance:g}")
    axes.set(xscale="log", xlabel="relative difference between the two programs [1]", yticks=range(len(keys)), yticklabels=keys)
    close, disagreeing = sum(check.difference <= tolerance for check in checks), sum(not check.agrees(tolerance) for check in checks)
    finding = f"{disagreeing} of {len(checks)} figures disagree" if disagreeing else f"{close} of {len(checks)} figures agree within {tolerance:g}, the others for a stated reason"
    axes.set_title(finding)
    axes.legend(loc="lower right")
    return figure


def materials(rows: Sequence[Recomputed]) -> Figure | None:
    """Studio PSNR of every held-out MERL material, ZNBRDF beside PCA-32."""
    mine = {f"{found.row.name} {found.row.variant}": found for found in rows if found.row.database == "merl" and found.row.name in ("znbrdf", "pca_tables")}
    ours, base = mine.get("znbrdf unrolled"), mine.get("pca_tables projection")
    if ours is None:
        return None
    order = np.argsort(ours.figures["studio_psnr"])
    figure = Figure(figsize=(8, 4.6), layout="constrained")
    axes = figure.subplots()
    for label, found in mine.items():
        axes.plot(np.array([found.figures["studio_psnr"][found.names.index(ours.names[i])] for i in order]), range(len(order)), "o", label=label, alpha=0.8)
    axes.set(yticks=range(len(order)), yticklabels=[ours.names[i] for i in order], xlabel="PSNR under studio [dB], higher is better")
    if base is not None:
        better = sum(a > base.figures["studio_psnr"][base.names.index(name)] for name, a in zip(ours.names, ours.figures["studio_psnr"]))
        title = f"ZNBRDF (unrolled) is closer than PCA-32's projection on {better} of {len(order)} held-out materials"
    else:
        title = f"ZNBRDF is furthest from {ours.names[order[0]]}, of {len(order)} held-out materials"
    axes.set_title(title)
    axes.legend(loc="lower right")
    return figure


def methods(walks: Sequence[Walked]) -> Figure:
    """Length and colour of every method's walks, one row per method."""
    order = sorted(walks, key=lambda found: -found.spread("hue_excursion").max)
    figure = Figure(figsize=(8, 0.3 * len(order) + 1.4), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    for axes, key in ((left, "length_ratio"), (right, "hue_excursion")):
        for label, marker, part in (("median", "o", "median"), ("worst pair", "x", "max")):
            axes.plot([max(getattr(found.spread(key), part), 1e-6) for found in order], range(len(order)), marker, label=label)
        axes.set_xscale("log")
    left.set(yticks=range(len(order)), yticklabels=[found.name for found in order], xlabel="length / distance of the ends, in ΔE_ITP [1]")
    right.set(xlabel="largest hue excursion [u′v′]")
    right.legend()
    figure.suptitle(f"{order[0].name} strays furthest in colour over {len(order[0].pairs)} pairs, {order[-1].name} least", x=0.01, ha="left", fontsize=11)
    return figure


def svg(figure: Figure) -> str:
    """The picture as text that can stand in a page."""
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    return out.getvalue()[out.getvalue().index("<svg") :]
