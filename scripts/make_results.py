"""Writes docs/results.md and the checkpoints' manifest from reports, so that no figure is typed by hand.

    target/release/nbrdf evaluate --json > target/evaluate.json
    target/release/nbrdf compare --json > target/compare.json
    python3 scripts/make_results.py target/evaluate.json target/compare.json
"""

import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

EVALUATE = [
    ("log_error", "log_error", 4), ("relative_log", "relative_log", 3),
    ("point_psnr", "point PSNR", 1), ("point_ssim", "point SSIM", 4), ("point_flip", "point FLIP", 3),
    ("point_delta_e_itp", "point ΔE_ITP", 2),
    ("studio_psnr", "studio PSNR", 1), ("studio_ssim", "studio SSIM", 4), ("studio_flip", "studio FLIP", 3),
    ("studio_delta_e_itp", "studio ΔE_ITP", 2),
]
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


def number(value: float | None, digits: int) -> str:
    """A figure, or a dash where there is none (infinite or undefined)."""
    return "–" if value is None else f"{value:.{digits}f}"


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def evaluation(report: dict, database: str) -> str:
    rows = [row for row in report["rows"] if row["database"] == database]
    head = ["representation"] + [title for _, title, _ in EVALUATE]
    body = []
    for row in rows:
        cells = [f"{number(row[key]['mean'], d)} ({number(row[key]['max'], d)})" for key, _, d in EVALUATE]
        body.append([f"`{row['name']}` {row['variant'].replace('_', '-')}", *cells])
    return table(head, body)


def spread(report: dict, database: str) -> str:
    """Median and 90th percentile beside the means above, and who is worst."""
    body = []
    for row in (r for r in report["rows"] if r["database"] == database):
        error, psnr = row["log_error"], row["studio_psnr"]
        body.append([
            f"`{row['name']}` {row['variant'].replace('_', '-')}", number(error["median"], 4), number(error["p90"], 4),
            ", ".join(error["worst"]), number(psnr["median"], 1), number(psnr["p90"], 1), ", ".join(psnr["worst"]),
            number(row["encode_s"]["median"] * 1e3, 1),
        ])
    head = ["representation", "log_error median", "p90", "worst", "studio PSNR median", "p90", "worst", "encode ms"]
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
    body = []
    for row in report["methods"]:
        errors = [row[f"family_{name}"] for name in FAMILIES]
        body.append([f"`{row['name']}`", *(f"{e['middle']:.4f} ({e['best']:.4f})" for e in errors)])
    return table(["method", *FAMILIES], body)


def conclusions(evaluate: dict, compare: dict) -> str:
    """Sentences that follow from the figures, whichever way they fall."""
    rows = {(r["name"], r["variant"]): r for r in evaluate["rows"] if r["database"] == "merl"}
    forward, refined = rows["znbrdf", "feed_forward"], rows["znbrdf", "refined"]
    projection, pca = rows["pca_tables", "projection"], rows["pca_tables", "refined"]

    def against(own: dict, other: dict, key: str, digits: int) -> str:
        difference = own[key]["mean"] - other[key]["mean"]
        return f"{difference:+.{digits}f}"

    out = [
        f"- Feed-forward ZNBRDF against PCA-32's projection: log_error {against(forward, projection, 'log_error', 4)}, "
        f"studio PSNR {against(forward, projection, 'studio_psnr', 1)} dB, SSIM {against(forward, projection, 'studio_ssim', 4)}.",
        f"- Refined ZNBRDF against PCA-32's projection: log_error {against(refined, projection, 'log_error', 4)}, "
        f"studio PSNR {against(refined, projection, 'studio_psnr', 1)} dB; against PCA-32's *refined* codes: "
        f"log_error {against(refined, pca, 'log_error', 4)}, studio PSNR {against(refined, pca, 'studio_psnr', 1)} dB.",
    ]
    order = sorted(compare["methods"], key=lambda r: -r["mix_psnr"]["median"])
    out.append("- Closest to the linear mix in the middle (median PSNR): " + ", ".join(f"`{r['name']}` {r['mix_psnr']['median']:.1f}" for r in order) + ".")
    nothing = next(r for r in order if r["name"] == "nearest_end")["mix_psnr"]["median"]
    losers = [f"`{r['name']}`" for r in order if r["mix_psnr"]["median"] < nothing]
    out.append(f"- Worse than doing nothing (`nearest_end`) by that figure: {', '.join(losers) or 'none'}.")
    return "\n".join(out)


def main() -> int:
    if len(sys.argv) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    evaluate, compare = (json.loads(Path(name).read_text()) for name in sys.argv[1:])
    text = f"""# Results

Written by `scripts/make_results.py` from two reports; run them to get every figure on this page again:

    target/release/nbrdf evaluate --json > target/evaluate.json
    target/release/nbrdf compare --json > target/compare.json
    python3 scripts/make_results.py target/evaluate.json target/compare.json

Definitions: mean (worst) over materials; PSNR in dB; errors are against the {evaluate['reference']} networks, which stand
for the measured tables (not at hand), so the network representation itself is the reference and no contestant.
Codes of all representations here are 32 numbers, 128 bytes; what is shared, and evaluation speed, are not measured yet.
One seed each: differences of a few percent are noise.

## In short

{conclusions(evaluate, compare)}

## Representations, 20 held-out MERL materials

{evaluation(evaluate, "merl")}

{spread(evaluate, "merl")}

## Representations, 9 held-out materials of another database (RGL; nothing was learned from RGL)

{evaluation(evaluate, "rgl")}

{spread(evaluate, "rgl")}

## Interpolation, {compare['pairs']} pairs of MERL materials, light `studio`

Held-out and training materials together, as the pairs of the protocol prescribe. `mix_*` compare the middle with the
linear mix, so `linear_mix` is perfect there by definition; `energy_violations` counts pairs with an albedo above 1
anywhere on the way ({compare['pairs']} at most), `_beyond` for t from −½ to 1½.

{comparison(compare)}

{worst_pairs(compare)}

## Families with a known middle, `log_error` of the middle (of the best-matching member)

Lambert + GGX only so far. ZNBRDF's training batches hold 15 % random Lambert + GGX materials, so the latent rows are *in
distribution* here; the lobes that were never trained on are still to be measured.

{families(compare)}
"""
    (ROOT / "docs/results.md").write_text(text)
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
