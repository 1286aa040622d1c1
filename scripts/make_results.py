"""Writes docs/results.md, docs/pruning.md and the checkpoints' manifest from reports, so that no figure is typed by hand.

    scripts/make_reports.sh                 (makes all reports, in target/reports; half an hour on two cores)
    scripts/make_stress.sh                  (where methods fail; an hour)
    python3 scripts/make_results.py target/reports
"""

import json
import sys
from pathlib import Path

from results_learning import ablation, hardest, seeds
from results_stress import stress_section
from results_table import EVALUATE, ROOT, label, number, table, thousands, wrapped

COMPARE = [
    ("end_error", "mean", "end_error mean", 4), ("mix_psnr", "median", "mix_psnr median", 1),
    ("mix_psnr", "max", "mix_psnr worst", 1), ("mix_ssim", "mean", "mix_ssim mean", 3),
    ("mix_rmse", "mean", "mix_rmse mean", 4), ("length_ratio", "median", "length_ratio median", 2),
    ("length_ratio", "p90", "p90", 2), ("step_ratio", "median", "step_ratio median", 2),
    ("hue_excursion", "median", "hue_excursion median", 4), ("hue_excursion", "max", "worst", 4),
    ("negative_share", "max", "negative_share worst", 4), ("energy_violations", None, "energy_violations", 0),
    ("energy_violations_beyond", None, "_beyond", 0),
]
FAMILIES = ["roughness", "colour", "ior", "metal"]
# Representations of this page.
OF_32_NUMBERS = ("znbrdf", "published_autoencoder", "pca_tables", "pca_weights")


def evaluation(report: dict, database: str) -> str:
    rows = [row for row in report["rows"] if row["database"] == database]
    head = ["representation"] + [title for _, title, _ in EVALUATE]
    body = []
    for row in rows:
        cells = [f"{number(row[key]['mean'], d)} ({number(row[key]['max'], d)})" for key, _, d in EVALUATE]
        body.append([label(row), *cells])
    return table(head, body)


def spread(report: dict, database: str) -> str:
    """Median and 90th percentile beside the means above, and who is worst."""
    body = []
    for row in (r for r in report["rows"] if r["database"] == database):
        error, psnr = row["log_error"], row["studio_psnr"]
        body.append([
            label(row), number(error["median"], 4), number(error["p90"], 4),
            ", ".join(error["worst"]), number(psnr["median"], 1), number(psnr["p90"], 1), ", ".join(psnr["worst"]),
            number(row["encode_s"]["median"] * 1e3, 2), number(row["ns"], 1), f"{row['shared_bytes'] / 1e6:.1f}",
        ])
    head = ["representation", "log_error median", "p90", "worst", "studio PSNR median", "p90", "worst", "encode ms", "ns per evaluation", "shared MB"]
    return table(head, body)


def worst_pairs(report: dict) -> str:
    body = [[f"`{r['name']}`", "; ".join(r["mix_psnr"]["worst"][:3]), "; ".join(r["hue_excursion"]["worst"][:3])] for r in report["methods"]]
    return table(["method", "worst by mix_psnr", "worst by hue_excursion"], body)


def comparison(report: dict) -> str:
    body = []
    for row in report["methods"]:
        cells = [number(row[key] if part is None else row[key][part], d) for key, part, _, d in COMPARE]
        body.append([f"`{row['name']}`", *cells])
    return table(["method"] + [title for _, _, title, _ in COMPARE], body)


def families(report: dict) -> str:
    """Per lobe the mean of the four middles, then each of them."""
    lobes = list(dict.fromkeys(family["lobe"] for family in report["methods"][0]["families"]))
    trained = {family["lobe"]: family["trained"] for family in report["methods"][0]["families"]}
    body = []
    for row in report["methods"]:
        cells = []
        for lobe in lobes:
            errors = {family["family"]: family["middle"] for family in row["families"] if family["lobe"] == lobe}
            cells.append(f"**{sum(errors.values()) / len(errors):.4f}** " + " ".join(f"{errors[name]:.4f}" for name in FAMILIES))
        body.append([f"`{row['name']}`", *cells])
    return table(["method", *(lobe if trained[lobe] else f"{lobe} (kept out)" for lobe in lobes)], body)


def calibration(report: dict) -> str:
    body = [
        [
            label(row), str(row["count"]), number(row["spearman_expected"], 2),
            number(row["spearman_distance"], 2), number(row["ratio"]["median"], 2), number(row["ratio"]["p90"], 2), number(row["ratio"]["max"], 2),
        ]
        for row in report["calibration"]
    ]
    head = ["representation", "materials", "Spearman, expected error", "Spearman, distance", "true / expected, median", "p90", "worst"]
    return table(head, body)


def axes(report: dict) -> str:
    names = [row["axis"] for row in report["axes"]]
    body = [
        [row["axis"], f"{row['monotone']} of {row['count']}", number(row["reached"]["mean"], 2), number(row["reached"]["max"], 2)]
        + [number(row["moved"][name], 2) for name in names]
        for row in report["axes"]
    ]
    return table(["axis", "one way only", "reached, mean", "worst", *names], body)


def conclusions(evaluate: dict, compare: dict) -> str:
    """Sentences that follow from the figures, whichever way they fall."""
    rows = {(r["name"], r["variant"]): r for r in evaluate["rows"] if r["database"] == "merl"}
    alone, forward, refined = (rows["znbrdf", variant] for variant in ("feed_forward", "unrolled", "refined"))
    projection, pca = rows["pca_tables", "projection"], rows["pca_tables", "refined"]

    def against(own: dict, other: dict, key: str, digits: int) -> str:
        difference = own[key]["mean"] - other[key]["mean"]
        return f"{difference:+.{digits}f}"

    def ratio(own: dict, other: dict) -> str:
        return f"{own['log_error']['mean'] / other['log_error']['mean']:.2f}"

    def worst(own: dict, other: dict) -> str:
        return f"{own['studio_psnr']['max'] - other['studio_psnr']['max']:+.1f}"

    out = [
        f"- ZNBRDF as `encode` does it (encoder and three unrolled steps) against PCA-32's projection: log_error "
        f"{ratio(forward, projection)} ×, studio PSNR {against(forward, projection, 'studio_psnr', 1)} dB, SSIM "
        f"{against(forward, projection, 'studio_ssim', 4)}, worst material {worst(forward, projection)} dB.",
        f"- The encoder alone against it: log_error {ratio(alone, projection)} ×, studio PSNR {against(alone, projection, 'studio_psnr', 1)} dB.",
        f"- Refined ZNBRDF against PCA-32's *refined* codes: log_error {ratio(refined, pca)} ×, studio PSNR "
        f"{against(refined, pca, 'studio_psnr', 1)} dB, SSIM {against(refined, pca, 'studio_ssim', 4)}, worst material {worst(refined, pca)} dB.",
    ]
    order = sorted(compare["methods"], key=lambda r: -r["mix_psnr"]["median"])
    out.append("- Closest to the linear mix in the middle (median PSNR): " + ", ".join(f"`{r['name']}` {r['mix_psnr']['median']:.1f}" for r in order) + ".")
    nothing = next(r for r in order if r["name"] == "nearest_end")["mix_psnr"]["median"]
    losers = [f"`{r['name']}`" for r in order if r["mix_psnr"]["median"] < nothing]
    out.append(f"- Worse than doing nothing (`nearest_end`) by that figure: {', '.join(losers) or 'none'}.")
    return "\n".join(out)


def evaluation_speed(speed: dict) -> str:
    rows = []
    for row in speed["evaluation"]:
        efficiency = "–" if row["efficiency"] is None else f"{row['efficiency']:.2f}"
        rows.append([
            f"`{row['name']}`", row["given"], number(row["ns"], 2), number(row["ratio_to_reference_loop"], 1), efficiency,
            thousands(row['bytes']),
        ])
    return table(["model", "given", "ns", "× `reference_loop`", "efficiency", "bytes"], rows)


def other_machines() -> str:
    """Earlier runs elsewhere, as recorded in docs/machines.json."""
    head = ["processor", "set", "ns", "prepared ns", "× `reference_loop`", "efficiency, prepared", "four of 256², ms", "one of 1024², ms", "encoder, decode µs", "refine ms", "commit"]
    rows = []
    for row in json.loads((ROOT / "docs/machines.json").read_text())["rows"]:
        shown = lambda key: "–" if key not in row else f"{row[key]:g}"
        codes = f"{shown('encode_us')}, {shown('decode_us')}"
        rows.append([row["processor"], row["set"], f"{row['ns']:.2f}", f"{row['prepared_ns']:.2f}", f"{row['ratio']:.1f}", f"{row['efficiency']:.2f}", shown("four_of_256_ms"), shown("one_of_1024_ms"), codes, shown("refine_ms"), row["commit"]])
    return table(head, rows)


def speed_section(speed: dict, accuracy: dict, fit: dict, instructions: dict, training: dict) -> str:
    pruning, codes, spheres = speed["pruning"], speed["codes"], speed["spheres"]
    saved = pruning["materials"]
    merl = [row for row in saved if "/" not in row["name"]]

    def faster(rows: list, key: str) -> float:
        return sum(row[key][0] / row[key][1] for row in rows) / len(rows)

    peaks = ", ".join(f"{peak['name']} {peak['gflops']:.0f}" for peak in speed["peaks"] if peak["name"] != "portable")
    return f"""## Speed

One thread, batches of 4096 random valid directions, RGB out; `prepared` means that half and difference vectors are
given (the network alone). Machines differ: the ratio to `reference_loop`, the loop over `Vec<Vec<f32>>` that makes its
half vectors without trigonometry, counts. Efficiency is 1350 flop / ns / the measured multiply-add peak of that instruction
set (here, on {speed['processor']}: {peaks} GFLOP/s; `{speed['instruction_set']}` measured fastest and is used).

    target/release/nbrdf speed --json

{evaluation_speed(speed)}

- **Accuracy**: largest error of a published network relative to (f + 10⁻³) against float64, over 1000 directions:
  {"; ".join(f"{row['name']} {row['median']:.1e} in the median network, {row['worst']:.1e} in the worst" for row in accuracy["rows"])}:
  `cargo test --release --workspace --test golden_networks -- --nocapture`.
- **Pruned**: over the {len(pruning['materials'])} published networks {pruning['live'][0]:.1f} + {pruning['live'][1]:.1f} of 21 + 21 units are proved to be able to fire;
  {pruning['multiply_adds']['mean']:.0f} of 630 multiply-adds are left on average ({pruning['multiply_adds']['max']:.0f} at most), {faster(saved, 'ns'):.2f} × faster from directions and {faster(saved, 'prepared_ns'):.2f} × alone
  (the 100 of MERL: {faster(merl, 'ns'):.2f} and {faster(merl, 'prepared_ns'):.2f}), bit for bit the same. Every material: [pruning.md](pruning.md).
- **Codes** on one core: encode {codes['encode_s'] * 1e3:.0f} ms (the encoder alone {codes['encoder_s'] * 1e6:.0f} µs), decode {codes['decode_s'] * 1e6:.0f} µs, refine {codes['refine_s'] * 1e3:.0f} ms.
- **Pictures** under three directional lights on {spheres['threads']} threads: four spheres of 256² in {spheres['four_of_256_s'] * 1e3:.1f} ms ({spheres['four_of_256_displayed_s'] * 1e3:.1f} ms with
  display bytes), one of 1024² in {spheres['one_of_1024_s'] * 1e3:.1f} ms ({1 / spheres['one_of_1024_s']:.0f} per second). From the slider to the bytes a frame of scrubbing
  allocates nothing, the app's threads no picture (`cargo test --release --test allocation`).
- **Fitting** one network: {fit['nbrdf_step_s'] * 1e6:.0f} µs per step of 512 directions, {fit['times_faster']:.1f} × faster than the same steps in jitted JAX on one
  thread ({fit['jax_step_s'] * 1e6:.0f} µs): `python scripts/bench_fit.py`.
- **Training**: {training['own'] * 1e3:.1f} ms for a step of 32 materials and 8 colour walks × 512 directions (48 encoded, 40 decoded). Plain candle
  operations need {training['plain'] * 1e3:.0f} ms for the 32 materials alone, {training['plain'] / training['own']:.1f} × as long for less, in the same run: `cargo bench --workspace --bench speed --
  "training step"`. The built-in checkpoint's {training['steps']} steps, with 6 analytic walks each, took {training['seconds'] / 60:.1f} minutes: {training['seconds'] / training['steps'] * 1e3:.1f} ms a step.
- **Instructions** of one frame, a code decoded and its 128² sphere under light `studio` (AVX2, one thread): {instructions['instructions_per_frame'] / 1e6:.2f} million:
  `scripts/count_instructions.sh`. A trend line without noise.

The same command on other machines (recorded in `docs/machines.json`); this page's own one is a guest whose neighbours
make it up to 1.7 × slower from one minute to the next, so that its quietest run of five is shown:

{other_machines()}
"""


def sampling_section(sampling: dict) -> str:
    names = {"uniform": "uniform", "cosine": "cosine", "blinn_phong": "Blinn-Phong, fitted", "lobe": "lobe, fitted", "predicted_lobe": "lobe, predicted from the code"}
    rows = [
        [names[r["name"]], number(r["mean"], 3), number(r["median"], 4), number(r["p90"], 3), number(r["max"], 3), ", ".join(r["worst"][:3]), number(r["held_out"]["mean"], 3), number(r["held_out"]["max"], 3)]
        for r in sampling["samplers"]
    ]
    head = ["sampler", "mean", "median", "p90", "worst", "worst materials", "20 held out: mean", "worst"]
    return f"""## Importance sampling

Variance of one sample of outgoing radiance under white light relative to the squared mean, averaged over viewers at 0, 10,
..., 80°: N samples have 1/N of it, so that ratios are ratios of samples. {sampling['materials']} MERL materials.

    target/release/nbrdf sampling -o docs/images/sampling.svg --json

{table(head, rows)}

![Variance of every material](images/sampling.svg)

The same 16 samples per pixel, drawn for chrome by the cosine and by its lobe (`nbrdf render chrome --environment softboxes
--samples 16 --sampler cosine`, `--sampler lobe`):

| cosine | lobe |
| --- | --- |
| ![fireflies](images/chrome-cosine.png) | ![clean](images/chrome-lobe.png) |
"""


def pruning_page(speed: dict) -> str:
    rows = [
        [row["name"], str(row["live"][0]), str(row["live"][1]), str(row["multiply_adds"]), f"{row['prepared_ns'][0] / row['prepared_ns'][1]:.2f}"]
        for row in speed["pruning"]["materials"]
    ]
    head = ["material", "layer 1", "layer 2", "multiply-adds", "times faster"]
    return f"""# What pruning saves, material by material

Units of 21 + 21 that are not proved to be silent, multiplications of 630 that are left, and how much faster the network
alone is. Written by `scripts/make_results.py` from `nbrdf speed --json`; reference: {speed['reference']} networks.

{table(head, rows)}
"""


def training_report(folder: Path, criterion: Path) -> dict:
    """Seconds per step of ours and of plain candle from criterion's estimates, and of the whole training."""
    def median(name: str) -> float:
        return json.loads((criterion / "training step" / name / "new/estimates.json").read_text())["median"]["point_estimate"] * 1e-9

    whole = json.loads((folder / "training.json").read_text())
    return {"own": median("znbrdf"), "plain": median("znbrdf in plain candle"), "steps": whole["steps"], "seconds": whole["seconds"]}


def main() -> int:
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    folder = Path(sys.argv[1])
    names = ("evaluate", "compare", "speed", "accuracy", "fit", "instructions", "sampling", "axes", "stress")
    evaluate, compare, speed, accuracy, fit, instructions, sampling, axes_report, stress = (json.loads((folder / f"{name}.json").read_text()) for name in names)
    for part in ("rows", "calibration"):
        evaluate[part] = [row for row in evaluate[part] if row["name"] in OF_32_NUMBERS]
    training = training_report(folder, ROOT / "target/criterion")
    validated = json.loads((ROOT / "docs/ablation.json").read_text())["rows"][0]["count"]
    text = f"""# Results

Written by `scripts/make_results.py`; these commands make every figure on this page again (the first two, of what seeds
and longer training change, take an hour and more, and what they record is kept in docs/):

    scripts/seeds.sh
    scripts/ablation.sh
    scripts/make_reports.sh
    scripts/make_stress.sh
    python3 scripts/make_results.py target/reports

Definitions: mean (worst) over materials; PSNR in dB; errors are against the {evaluate['reference']} networks, which stand
for the measured tables (not at hand), so the network representation itself is the reference and no contestant.
Codes of all representations here are 32 numbers, 128 bytes; [representations.md](representations.md) has all others. Of ZNBRDF the built-in checkpoint is shown, seed 0; what
other seeds do stands below.

## In short

{conclusions(evaluate, compare)}

{speed_section(speed, accuracy, fit, instructions, training)}
{sampling_section(sampling)}
## Representations, 20 held-out MERL materials

{evaluation(evaluate, "merl")}

{spread(evaluate, "merl")}

## Representations, 9 held-out materials of another database (RGL; nothing was learned from RGL)

{evaluation(evaluate, "rgl")}

{spread(evaluate, "rgl")}

## Other seeds

{seeds()}

## Where ZNBRDF's log_error is above PCA-32's

The six held-out materials on which the refined code loses most, by `log_error`. The last column is the built-in library's
network of the material: the same 675 weights, all free, fitted for 30 000 steps from the shared start, which is what the
decoder would have to match.

{hardest(evaluate)}

What longer training brings, on {validated} training materials set aside (`scripts/ablation.sh`, one seed, recorded in
`docs/ablation.json`; neither autoencoder nor PCA has seen them, the shared start has seen their mean):

{ablation()}

## Knowing what it does not know

`nbrdf encode` says which `log_error` to expect, from directions that the metric does not ask, and how far the code is
from those of the training materials (1: the median distance between neighbours among these). Held-out materials of MERL
and RGL together (`nbrdf evaluate`):

{calibration(evaluate)}

## Axes

`nbrdf edit` moves one quality and holds others; here every quality of the 20 held-out MERL materials is moved by
−{axes_report['amount']} to +{axes_report['amount']} (`nbrdf axes`). One way only: never back by more than 0.002. Reached: the share of what was
asked. Then the mean size of what moves, relative to what was asked of the axis. Gloss is the strength of the highlight and metalness its
share in all light, so that each has to move the other.

{axes(axes_report)}

## Interpolation, {compare['pairs']} pairs of MERL materials, light `studio`

Held-out and training materials together, as the pairs of the protocol prescribe. `mix_*` compare the middle with the
linear mix, so `linear_mix` is perfect there by definition; `energy_violations` counts pairs with an albedo above 1
anywhere on the way ({compare['pairs']} at most), `_beyond` for t from −½ to 1½.

{comparison(compare)}

{worst_pairs(compare)}

The ten pairs on which straight latent paths are furthest from the linear mix (`nbrdf compare --pictures FOLDER` draws them
for every method):

![Ten rows of seven spheres](images/worst-latent.png)

## Families with a known middle, `log_error` of the middle

Mean of the four families in bold, then roughness, colour, ior, metal. ZNBRDF's training sees random walks between
materials with GGX-like and Blinn–Phong lobes; Beckmann and GTR of γ = 1 are kept out.

{families(compare)}

{stress_section(stress)}"""
    (ROOT / "docs/results.md").write_text(wrapped(text))
    (ROOT / "docs/pruning.md").write_text(pruning_page(speed))
    keep = ("log_error", "studio_psnr", "studio_ssim", "studio_flip", "studio_delta_e_itp")
    names = ("znbrdf", "published_autoencoder")
    figures = [
        {k: row[k] for k in ("name", "variant", "database", "count", *keep)} for row in evaluate["rows"] if row["name"] in names
    ]
    manifest = ROOT / "autoencoder/assets/manifest.json"
    known = json.loads(manifest.read_text())
    known["figures"] = {"command": "nbrdf evaluate --json", "reference": evaluate["reference"], "rows": figures}
    manifest.write_text(json.dumps(known, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
