"""The pictures of the report, as SVG. Titles say what was found; axes say their units."""

import io
from collections.abc import Sequence

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from .agreement import Check
from .held_out import Recomputed
from .interpolation import Walked
from .tally import recomputed

matplotlib.rcParams |= {"svg.hashsalt": "nbrdf", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.titlelocation": "left"}
LEAST, MOST = 1e-12, 10.0  # smaller and larger differences are drawn here
# Colour and marker of what is shown of every held-out material.
SHOWN = {
    ("znbrdf", "unrolled"): ("tab:blue", "o"),
    ("znbrdf", "feed_forward"): ("tab:cyan", "v"),
    ("znbrdf", "refined"): ("navy", "^"),
    ("pca_tables", "projection"): ("tab:orange", "s"),
    ("pca_tables", "refined"): ("tab:brown", "D"),
}


def differences(checks: Sequence[Check], tolerance: float) -> Figure:
    """Relative difference of every figure that is recomputed, one row per key."""
    checks = recomputed(checks)
    keys = sorted({check.key.split()[0] for check in checks}, reverse=True)
    figure = Figure(figsize=(8, 0.24 * len(keys) + 1.6), layout="constrained")
    axes = figure.subplots()
    close, wider, apart = (
        ("tab:blue", f"within {tolerance:g}", [check for check in checks if check.is_close(tolerance)]),
        ("tab:orange", "further apart, for a stated reason", [check for check in checks if check.agrees(tolerance) and not check.is_close(tolerance)]),
        ("tab:red", "disagree", [check for check in checks if not check.agrees(tolerance)]),
    )
    for colour, label, own in (close, wider, apart):
        if own:
            places = [keys.index(check.key.split()[0]) for check in own]
            axes.plot(np.clip(np.nan_to_num([check.difference for check in own], nan=MOST), LEAST, MOST), places, "o", markersize=4, alpha=0.5, color=colour, label=f"{len(own)} {label}")
    axes.axvline(tolerance, color="gray", linewidth=1)
    decades = [1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1.0]
    axes.set(xscale="log", xlabel="relative difference between the two programs [1]", yticks=range(len(keys)), yticklabels=keys, ylim=(-0.7, len(keys) - 0.3))
    axes.set_xticks([LEAST, *decades], ["0", *(f"$10^{{{round(np.log10(decade))}}}$" for decade in decades)])
    axes.grid(axis="y", linewidth=0.3)
    agree = f"{len(close[2])} of {len(checks)} recomputed figures agree within {tolerance:g}, the others as far as a stated reason goes"
    figure.suptitle(f"{len(apart[2])} of {len(checks)} recomputed figures disagree" if apart[2] else agree, x=0.01, ha="left", fontsize=11)
    figure.legend(loc="outside lower center", ncols=3, frameon=False)
    return figure


def materials(rows: Sequence[Recomputed]) -> Figure | None:
    """Studio PSNR of every held-out MERL material, ZNBRDF beside PCA-32."""
    mine = {key: found for key in SHOWN for found in rows if (found.row.database, found.row.name, found.row.variant) == ("merl", *key)}
    ours, base = mine.get(("znbrdf", "unrolled")), mine.get(("pca_tables", "projection"))
    if ours is None:
        return None
    order = np.argsort(ours.figures["studio_psnr"])
    figure = Figure(figsize=(8, 0.22 * len(order) + 1.4), layout="constrained")
    axes = figure.subplots()
    values = np.array([[found.figures["studio_psnr"][found.names.index(ours.names[i])] for i in order] for found in mine.values()])
    axes.hlines(range(len(order)), values.min(axis=0), values.max(axis=0), color="lightgray", zorder=0)
    for key, own in zip(mine, values):
        colour, marker = SHOWN[key]
        axes.plot(own, range(len(order)), marker, color=colour, markersize=5, label=f"{key[0]} {key[1].replace('_', '-')}", alpha=0.9)
    axes.set(yticks=range(len(order)), yticklabels=[ours.names[i] for i in order], xlabel="PSNR under light studio [dB], higher is better", ylim=(-0.7, len(order) - 0.3))
    if base is not None:
        better = sum(a > base.figures["studio_psnr"][base.names.index(name)] for name, a in zip(ours.names, ours.figures["studio_psnr"]))
        title = f"ZNBRDF (unrolled) is closer than PCA-32's projection on {better} of {len(order)} held-out materials"
    else:
        title = f"ZNBRDF is furthest from {ours.names[order[0]]}, of {len(order)} held-out materials"
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    figure.legend(loc="outside lower center", ncols=3, frameon=False)
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
