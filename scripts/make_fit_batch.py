"""Writes docs/fit_batch.md and its picture of docs/fit_batch.json: how good `fit_batch.py` is, and how it scales.

    python scripts/make_fit_batch.py

The record is made by scripts/scale_fit.py.
"""

import json
import sys
from collections import Counter

from matplotlib.figure import Figure

from nbrdf_jax import plots
from nbrdf_jax.two_samples import CONFIDENCE, SIGMAS
from results_table import ROOT, number, table, thousands, wrapped

DOCS = ROOT / "docs"
PICTURE = DOCS / "images" / "fit_batch.svg"
MARGIN = 0.1  # errors that differ by less are called equal
BUSY = 0.2  # cores taken by others, above which times by the clock are said to be worth little
VERDICTS = {"same": "no difference", "first": "`fit_batch.py` is better", "second": "`nbrdf fit` is better"}


def spread(found: dict, digits: int) -> str:
    return f"{found['mean']:.{digits}f} ± {found['sd']:.{digits}f}"


def ratio(found: dict) -> tuple[float, float]:
    """Of a figure's means, and its standard error."""
    second = found["second"]["mean"]
    return found["first"]["mean"] / second, found["standard_error"] / second


def percent(share: float) -> str:
    """With its sign; what rounds to nothing has none."""
    return f"{100 * share:+.1f} %".replace("-0.0 %", "0.0 %").replace("+0.0 %", "0.0 %")


def qualities(quality: dict) -> str:
    """A row for every material."""
    rows = []
    for row in quality["materials"]:
        error, psnr = row["log_error"], row["studio_psnr"]
        apart = f"{percent(ratio(error)[0] - 1)} ± {100 * ratio(error)[1]:.1f} %"
        rows.append([
            row["material"] + (" (held out)" if row["held_out"] else ""), spread(error["first"], 5), spread(error["second"], 5), apart, VERDICTS[error["verdict"]],
            spread(psnr["first"], 2), spread(psnr["second"], 2), VERDICTS[psnr["verdict"]],
        ])  # fmt: skip
    head = ["material", "log_error, `fit_batch.py`", "`nbrdf fit`", "apart", "verdict", "studio PSNR [dB], `fit_batch.py`", "`nbrdf fit`", "verdict"]
    return table(head, rows)


def interval(found: dict) -> str:
    """A ratio over all materials, as a difference."""
    return f"{percent(found['mean'] - 1)} ({percent(found['low'] - 1)} to {percent(found['high'] - 1)})"


def finding(quality: dict) -> str:
    """Of all materials together."""
    found = quality["overall"]["log_error"]
    if 1 / (1 + MARGIN) <= found["low"] and found["high"] <= 1 + MARGIN:
        return f"over all its log_error is that of `nbrdf fit` within {100 * MARGIN:.0f} %"
    if found["low"] <= 1 <= found["high"]:
        return f"not told apart from `nbrdf fit`, whose errors may be {100 * (1 - 1 / found['high']):.0f} % smaller or {100 * (1 / found['low'] - 1):.0f} % larger"
    return f"its errors are {abs(100 * (found['mean'] - 1)):.1f} % {'larger' if found['mean'] > 1 else 'smaller'} than those of `nbrdf fit`"


def counted(quality: dict, key: str) -> str:
    """How many materials have which verdict."""
    seen = Counter(row[key]["verdict"] for row in quality["materials"])
    return ", ".join(f"{VERDICTS[verdict]} on {seen[verdict]}" for verdict in VERDICTS if seen[verdict])


def scales(scaling: dict) -> str:
    """A row for every number of devices and materials."""
    rows, first = [], {row["devices"]: row["peak_mb"] for row in scaling["rows"] if row["materials"] == 1}
    for row in scaling["rows"]:
        count = row["materials"]
        more = number((row["peak_mb"] - first[row["devices"]]) / (count - 1) if count > 1 else None, 2)
        rows.append([
            str(row["devices"]), thousands(count), f"{1e6 * row['step_of_material_s']:.0f}", f"{1e6 * row['slowest_block_s']:.0f}", f"{1e6 * row['processor_s']:.0f}", str(row["blocks"]), number(row["compile_s"], 1),
            number(row["targets_per_material_s"], 3), number(row["judge_per_material_s"], 3), f"{row['peak_mb']:.0f}", more, number(row["load_before"], 1), number(row["others_cores"], 2),
        ])  # fmt: skip
    head = ["devices", "materials", "µs per step and material, median of blocks", "slowest block", "processor time, median", "blocks", "compiling [s]", "targets [s per material]", "judging [s per material]", "peak memory [MB]", "more per material [MB]", "load before", "cores taken by others"]
    return table(head, rows)


def cost(scaling: dict) -> str:
    """Processor time of a step where every device has materials of its own."""
    filled = [row for row in scaling["rows"] if row["materials"] > max(other["devices"] for other in scaling["rows"])]
    microseconds = [1e6 * row["processor_s"] for row in filled]
    return f"{min(microseconds):.0f} to {max(microseconds):.0f} µs of processor time per step and material from {min(row['materials'] for row in filled)} materials on"


def by_the_clock(scaling: dict) -> str:
    """What more devices bring to most materials, and what that is worth."""
    most = max(row["materials"] for row in scaling["rows"])
    alone, *more = sorted((row for row in scaling["rows"] if row["materials"] == most), key=lambda row: row["devices"])
    gains = [f"{alone['step_of_material_s'] / row['step_of_material_s']:.1f} × as fast on {row['devices']}" for row in more]
    others = max(row["others_cores"] or 0 for row in scaling["rows"])
    said = f" Others took up to {others:.1f} of the {scaling['cores']} cores meanwhile, so that the clock says little and processor time is what counts." if others > BUSY else ""
    return f"By the clock a step of {thousands(most)} materials is {' and '.join(gains)} devices than on one.{said}"


def memory(scaling: dict) -> str:
    """What materials beyond those of one chunk take."""
    peaks = {row["materials"]: row["peak_mb"] for row in scaling["rows"] if row["devices"] == 1}
    *_, some, most = sorted(peaks)
    return f"On one device {thousands(some)} materials take {peaks[some]:.0f} MB at most, and {thousands(most)}, fitted in chunks, {peaks[most]:.0f} MB"


def picture(record: dict) -> Figure:
    """Errors against `nbrdf fit`, and time over the number of materials."""
    quality, scaling = record["quality"], record["scaling"]
    figure = Figure(figsize=(9.5, 4.2), layout="constrained", facecolor="white")
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    rows = sorted(quality["materials"], key=lambda row: ratio(row["log_error"])[0])
    for place, row in enumerate(rows):
        middle, error = ratio(row["log_error"])
        left.errorbar(100 * (middle - 1), place, xerr=100 * SIGMAS * error, fmt="o", markersize=4, capsize=2, color="tab:blue" if row["log_error"]["verdict"] == "same" else "tab:red")
    found = quality["overall"]["log_error"]
    left.axvspan(100 * (found["low"] - 1), 100 * (found["high"] - 1), color="tab:blue", alpha=0.15, linewidth=0)
    left.axvline(0, color="black", linewidth=1)
    left.set(yticks=range(len(rows)), yticklabels=[row["material"] for row in rows], xlabel=f"log_error of fit_batch.py above nbrdf fit [%], ± {SIGMAS:.0f} standard errors; band: all")
    left.set_title(finding(quality).replace("`", "").capitalize())
    for devices, marker in zip(sorted({row["devices"] for row in scaling["rows"]}), "os^"):
        own = [row for row in scaling["rows"] if row["devices"] == devices]
        right.plot([row["materials"] for row in own], [1e6 * row["processor_s"] for row in own], f"{marker}-", markersize=5, label=f"{devices} device{'s' * (devices > 1)}")
    right.set(xscale="log", xlabel=f"materials, simulated devices on {scaling['cores']} cores", ylabel="processor time per step and material [µs]")
    right.set_ylim(bottom=0)
    right.set_title(cost(scaling).replace(" of processor time per step and material", ""))
    right.legend()
    return figure


def page(record: dict) -> str:
    quality, scaling = record["quality"], record["scaling"]
    return wrapped(f"""# Fitting many materials at once: {finding(quality)}

`scripts/fit_batch.py` fits many networks in one go, sharded over all devices that JAX finds, chunk by chunk; a run that was stopped goes on
where it was. It writes a library that `nbrdf` reads. It is written from the definitions, not from `nbrdf fit`, and draws its own directions.

![{finding(quality).replace("`", "")}](images/{PICTURE.name})

## Quality: {finding(quality)}

{len(quality["materials"])} materials, {quality["seeds"]} seeds by each program, {thousands(quality["steps"])} steps from the same start (`{quality["command"]}`;
[fit_batch.json](fit_batch.json)): measured tables, and tables that `nbrdf export` writes of published networks. `nbrdf info --against` judges both. Mean ± standard deviation over
seeds; *apart*: how much more `fit_batch.py` errs, ± standard error. A verdict asks for {SIGMAS:.0f} standard errors, which with so few seeds chance alone exceeds once in ten to
twenty times.

{qualities(quality)}

Over all materials, with the {100 * CONFIDENCE:.0f} % interval over them in brackets (Student's t), `fit_batch.py` is above `nbrdf fit` by {interval(quality["overall"]["log_error"])} in log_error, by
{interval(quality["overall"]["relative_log"])} in relative_log, by {interval(quality["overall"]["studio_flip"])} in studio FLIP, and by {quality["overall"]["studio_psnr"]["mean"]:+.2f} dB
({quality["overall"]["studio_psnr"]["low"]:+.2f} to {quality["overall"]["studio_psnr"]["high"]:+.2f}) in studio PSNR. Its log_error varies {quality["overall"]["log_error_spread"]["mean"]:.2f} times as much from seed to seed
({quality["overall"]["log_error_spread"]["low"]:.2f} to {quality["overall"]["log_error_spread"]["high"]:.2f}). Verdicts on log_error: {counted(quality, "log_error")}. On studio PSNR: {counted(quality, "studio_psnr")}.

## Scaling: {cost(scaling)}

Made-up materials on {scaling["cores"]} cores, {scaling["sets"]} sets of directions (`{scaling["command"]}`). Simulated devices share the cores: they show that the work is
split, not how fast it can be. {by_the_clock(scaling)} Every device takes as many materials: where there are fewer than devices, some are fitted again in vain. Compiling happens once for every size of chunk and is in no other column. The judging of few materials is mostly what is made once for all. *Load before*: processes
that wanted to run in the minute before, the run before among them; *cores taken by others*: meanwhile, on average; processor time hardly suffers from them, the clock does. {memory(scaling)}; what
every process needs before it has any is in its peak. No GPU was tried.

{scales(scaling)}
""")


def main() -> int:
    record = json.loads((DOCS / "fit_batch.json").read_text())
    (DOCS / "fit_batch.md").write_text(page(record))
    PICTURE.write_text(plots.svg(picture(record)) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
