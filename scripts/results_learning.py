"""Sections of docs/results.md on what training brings, and where it does not suffice."""

import json

from results_table import EVALUATE, ROOT, label, number, table, thousands


def seeds() -> str:
    """Mean ± standard deviation over seeds, as recorded in docs/seeds.json."""
    recorded = json.loads((ROOT / "docs/seeds.json").read_text())
    body = []
    for row in recorded["rows"]:
        cells = [f"{row[key]['mean']:.{d}f} ± {row[key]['sd']:.{d}f}" for key, _, d in EVALUATE if key in row]
        body.append([f"{label(row)}, {row['database']}", *cells])
    head = [f"{len(recorded['seeds'])} seeds"] + [title for key, title, _ in EVALUATE if key in recorded["rows"][0]]
    return f"""Mean ± standard deviation over trainings of {thousands(recorded['steps'])} steps that differ in nothing but the seed (`{recorded['command']}`,
recorded in `docs/seeds.json`); held-out materials.

{table(head, body)}"""


def ablation() -> str:
    """Validation figures by length of training, as recorded in docs/ablation.json."""
    recorded = json.loads((ROOT / "docs/ablation.json").read_text())["rows"]
    shown = [(key, title, digits) for key, title, digits in EVALUATE if key in recorded[0]]
    variants = [("znbrdf", "feed_forward"), ("znbrdf", "unrolled"), ("znbrdf", "refined"), ("pca_tables", "projection"), ("pca_tables", "refined")]
    body = []
    for name, variant in variants:
        for row in (r for r in recorded if (r["name"], r["variant"]) == (name, variant)):
            steps = thousands(row["steps"]) if "steps" in row else "–"
            body.append([label(row), steps, *(number(row[key], digits) for key, _, digits in shown)])
    return table(["representation", "steps", *(title for _, title, _ in shown)], body)


def hardest(report: dict) -> str:
    """Held-out materials that cost ZNBRDF most against PCA-32, beside a network with all its weights free."""
    rows = {(row["name"], row["variant"]): {m["name"]: m["log_error"] for m in row["materials"]} for row in report["rows"] if row["database"] == "merl"}
    refit = json.loads((ROOT / "nbrdf-core/assets/shared/manifest.json").read_text())["materials"]
    refit = {material["name"]: material["error"]["log_error"] for material in refit}
    columns = [rows["znbrdf", "unrolled"], rows["znbrdf", "refined"], rows["pca_tables", "projection"], rows["pca_tables", "refined"], refit]
    names = sorted(columns[0], key=lambda name: columns[3][name] - columns[1][name])
    body = [[name, *(number(column[name], 4) for column in columns)] for name in names[:6]]
    rest = [[f"mean of the other {len(names) - 6}", *(number(sum(column[name] for name in names[6:]) / len(names[6:]), 4) for column in columns)]]
    head = ["material", "ZNBRDF unrolled", "refined", "PCA-32 projection", "refined", "network fitted to it"]
    return table(head, body + rest)
