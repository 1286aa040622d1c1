"""Writes docs/representations.md from the reports of scripts/make_representations.sh, so that no figure is typed by hand."""

import json
import sys
from pathlib import Path

from results_table import ROOT, label, number, table, thousands, wrapped

RGL = ("cc_ibiza_sunset", "cg_sunflower", "colodur_napoli_4f", "paper_white")
CORNELL = ("cayman", "garnet_red", "krylon_blue")
ERRORS = [
    ("log_error", "log_error", 4), ("relative_log", "relative_log", 3), ("studio_psnr", "studio PSNR", 1),
    ("studio_ssim", "SSIM", 3), ("studio_flip", "FLIP", 3), ("studio_delta_e_itp", "ΔE_ITP", 1),
]


def errors(rows: list[dict]) -> str:
    body = [[label(row), *(f"{number(row[key]['mean'], d)} ({number(row[key]['max'], d)})" for key, _, d in ERRORS)] for row in rows]
    return table(["representation", *(title for _, title, _ in ERRORS)], body)


def costs(rows: list[dict]) -> str:
    body = [
        [
            label(row), thousands(row["bytes"]), number(row["shared_bytes"] / 1e6, 1), number(row["encode_s"]["median"] * 1e3, 1),
            number(row["ns"], 1), number(row["ratio_to_reference_loop"], 2),
            number(row["negative_share"]["max"], 4), number(row["albedo_max"]["max"], 3), number(row["reciprocity"]["max"], 4),
        ]
        for row in rows
    ]
    head = ["representation", "bytes", "shared MB", "encode ms", "ns", "× `reference_loop`", "negative share, worst", "albedo_max, worst", "reciprocity, worst"]
    return table(head, body)


def measured(folder: Path) -> str:
    read = lambda stem: json.loads((folder / f"{stem}.json").read_text())
    body = []
    for stem in RGL:
        own, published = read(stem)["error"], read(f"{stem}-published")["against"]["figures"]
        ratio = own["log_error"] / published["log_error"]
        body.append([stem, number(own["log_error"], 4), number(published["log_error"], 4), number(ratio, 2), number(own["studio_psnr"], 1), number(published["studio_psnr"], 1)])
    head = ["RGL material", "log_error, our fit", "published network", "ratio", "studio PSNR, our fit", "published network"]
    paints = []
    for stem in CORNELL:
        error = read(stem)["error"]
        shares = (f"{100 * error[key][part]:.1f} %" for key in ("relative_error", "of_lambert_ggx", "of_lambert") for part in ("mean", "median", "p90"))
        paints.append([stem, str(error["samples"]), *shares])
    return f"""{table(head, body)}

Goniometer samples of three paints (Cornell), each judged by a fit that has seen neither it nor any other tenth sample (ten fits;
`nbrdf fit PAINT.brdf -o OUT.npz --leave-out 10`): relative error, mean, median and 90th percentile over samples and channels; beside it
a GGX lobe with free Fresnel term over a diffuse base, and the base alone, fitted to the same samples.

{table(["paint", "samples", "network, mean", "median", "90 %", "GGX, mean", "median", "90 %", "Lambert, mean", "median", "90 %"], paints)}"""


def title(point: dict) -> str:
    """As the chart calls it."""
    file = f" ({point['file']})" if "file" in point else ""
    return point["name"] + {"refined": " refined", "feed_forward": " feed-forward"}.get(point["variant"], "") + file


def stability(report: dict) -> str:
    """Whether every run found the same models; nothing where there was one."""
    fronts = report["fronts"]
    if len(fronts) < 2:
        return ""
    if report["stable"]:
        return f"Each of {len(fronts)} runs finds the same ones, near ties decided by the medians over runs."
    counts = {name: sum(name in found for found in fronts) for found in fronts for name in found}
    changing = ", ".join(f"`{name}` ({count})" for name, count in counts.items() if count < len(fronts))
    return f"Times are medians over {len(fronts)} runs, not each of which finds the same models: found in some are {changing}."


def front(folder: Path) -> str:
    """What the chart shows: the models that no other one beats."""
    report = json.loads((folder / "chart.json").read_text())
    points = {title(point): point for point in report["points"]}
    metric = report["metric"]
    body = [
        [f"`{name}`", number(points[name]["ns"], 1), str(points[name]["bytes"]), number(points[name]["error"][metric]["mean"], 3), number(points[name]["error"][metric]["p90"], 3)]
        for name in report["front"]
    ]
    return f"""![{len(body)} of {len(points)} models are worth their time](images/chart.svg)

Nothing else is both faster (by more than a tenth) and closer than these (`nbrdf chart --runs {report['runs']}`, {report['materials']} held-out materials). {stability(report)} Everything that decodes
to a network of 675 weights takes the same time; between them, bytes decide. Codes of 4, 8 and 16 numbers are of the checkpoints below.

{table(["model", "ns", "bytes", "FLIP under studio, mean", "90 %"], body)}"""


def lengths() -> str:
    """Nothing where the record is not there."""
    path = ROOT / "docs/sizes.json"
    if not path.exists():
        return ""
    recorded = json.loads(path.read_text())
    variants = ("feed_forward", "unrolled", "refined")
    body = [
        [str(row["dim"]), *(number(row[v]["log_error"], 4) for v in variants), *(number(row[v]["studio_psnr"], 1) for v in variants)]
        for row in recorded["rows"]
    ]
    head = ["numbers", "log_error, encoder alone", "unrolled", "refined", "studio PSNR, encoder alone", "unrolled", "refined"]
    return f"""## ZNBRDF codes of other lengths

Separate checkpoints of {thousands(recorded['steps'])} steps each (the built-in one of 32 numbers has more), seed 0, means over the held-out MERL
materials: `{recorded['command']}`, recorded in `docs/sizes.json`. Codes of fewer than 4 numbers are grey: channels that are treated alike need a
number each.

{table(head, body)}

{ordered(recorded)}
"""


def ordered(recorded: dict) -> str:
    """What 32 numbers lose where a part of them serves alone."""
    plain, nested = (recorded["order"][name] for name in ("plain", "ordered"))
    rows = [("feed_forward", "encoder alone"), ("unrolled", "unrolled"), ("refined", "refined")]
    body = [
        [title, number(plain[v]["log_error"], 4), number(nested[v]["log_error"], 4), number(plain[v]["studio_psnr"], 1), number(nested[v]["studio_psnr"], 1)]
        for v, title in rows
    ]
    cost = 100 * (nested["unrolled"]["log_error"] / plain["unrolled"]["log_error"] - 1)
    return f"""One code for all lengths, of which a shorter one keeps a part of the shared numbers and of each channel's (`nbrdf train --ordered`,
nested dropout; {thousands(recorded['steps'])} steps; judged on the validation materials, which neither has seen): unrolled, its log_error at 32 numbers is
{cost:+.0f} % of the plain code's. The limit set beforehand was 5 %: lengths {"stay separate checkpoints" if cost > 5 else "could share one checkpoint"}.

{table(["32 numbers", "log_error, plain", "ordered", "studio PSNR, plain", "ordered"], body)}"""


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    folder = Path(sys.argv[1])
    report = json.loads((folder / "representations.json").read_text())
    text = {stem: (folder / f"{stem}.txt").read_text().rstrip() for stem in ("reconstruct", "linear", "manifold", "published_fits", "factored")}
    merl, rgl = ([row for row in report["rows"] if row["database"] == database] for database in ("merl", "rgl"))
    page = f"""# Every way to store a material, on the same bench

Written by `scripts/make_representations.py`; these commands make every figure on this page again:

    scripts/sizes.sh
    scripts/make_representations.sh

Errors are mean (worst) over held-out materials against the {report['reference']} networks, which stand for the measured tables;
definitions as in [results.md](results.md). Representations that learn have seen the 80 training materials of MERL; fits see
the material itself. `nbrdf` is the built-in library's network, fitted to the reference network for 30 000 steps from the shared start, so that
its rows tell what such a fit loses, and fewer bits on top; `nbrdf_pruned` is the same network without the units that can never
fire, which differ from material to material: its bytes are the median. `nbrdf_6`, `nbrdf_10` and `nbrdf_16` are fitted for
4 000 steps from the reference network, from which units were left out; `nbrdf_32` for 8 000 from random weights. Times to encode are of
finding the former in the library, and of fitting the latter ones. What is learned can be saved, of
other sizes and from other materials too: `nbrdf learn NAME -o FILE`, and `--checkpoint FILE` where codes are made or read.
On this page they are learned from the reference (`--library merl_nbrdf.zip`), on the command line from the built-in library.

## Speed against accuracy

{front(folder)}

## Errors, {merl[0]['count']} held-out MERL materials

{errors(merl)}

## What they cost, and whether they could exist

Bytes of one material, and what all share; time to encode one; time of one evaluation from a pair of directions on one thread
(`reference_loop` is the plain loop over the network's weights; above 1 is faster), as in `nbrdf speed`. Negative share before the clamp at zero, the
largest albedo, and how far from reciprocal: the worst of the materials.

{costs(merl)}

## Errors, {rgl[0]['count']} held-out RGL materials (nothing was learned from RGL)

{errors(rgl)}

## Networks against measured data

RGL tables, read here as Mitsuba reads them (`nbrdf fit TABLE.bsdf -o OUT.npz`, 30 000 steps; `nbrdf info rgl/NAME --library
rgl_nbrdf_subset.zip --against TABLE.bsdf`):

{measured(folder / "measured")}

## Formulas: published fits and ours

`cargo run --release -p nbrdf-core --example published_fits`: `log_error` against the published networks.

```text
{text['published_fits']}
```

Factored microfacet against the published SGD fit (`cargo test --release --workspace --test factored -- --nocapture`):

```text
{text['factored']}
```

## Few samples, few directions, few pictures

`nbrdf reconstruct --draws 20`

```text
{text['reconstruct']}
```

![Error over the number of measurements](images/reconstruct.svg)

## Where linear models turn unphysical, and why the half angle

`nbrdf linear`

```text
{text['linear']}
```

![Shares of what PCA spans that cannot exist](images/linear.svg)

![Singular values of tables in both frames](images/ranks.svg)

## Charting

`nbrdf manifold`

```text
{text['manifold']}
```

![A map of the materials](images/manifold.svg)

{lengths()}"""
    (ROOT / "docs/representations.md").write_text(wrapped(page).rstrip() + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
