"""The part of docs/results.md on where methods fail, from `nbrdf stress --json`."""

from results_table import ROOT, table

# What stands before a value: holds, refuses, degrades, fails; and fails with a warning.
SIGNS = {"holds": "", "degrades": "~ ", "fails": "**✗** "}
NAMED = 5


def figure(value: float | None) -> str:
    if value is None:
        return "NaN"
    if value == 0 or value >= 1e4 or value < 1e-4:
        return "0" if value == 0 else f"{value:.0e}"
    return f"{value:.3g}"


def title(cell: dict) -> str:
    variant = cell.get("variant")
    return f"`{cell['method']}`" + (f" {variant.replace('_', '-')}" if variant else "")


def shown(cell: dict | None) -> str:
    if cell is None:
        return ""
    if cell["verdict"] == "refuses":
        return "refuses"
    told = " (told)" if cell["verdict"] == "fails" and cell["warnings"] else ""
    return SIGNS[cell["verdict"]] + figure(cell["value"]) + told


def matrix(report: dict, group: str) -> str:
    """Methods down, hazards of a group across."""
    hazards = [hazard["name"] for hazard in report["hazards"] if hazard["group"] == group]
    cells = {(title(cell), cell["hazard"]): cell for cell in report["cells"] if cell["group"] == group}
    methods = list(dict.fromkeys(name for name, _ in cells))
    rows = [[method, *(shown(cells.get((method, hazard))) for hazard in hazards)] for method in methods]
    return table(["method", *hazards], rows)


def sentence(hazard: dict, cells: list[dict]) -> str:
    """Who fails, by how much, where; or who comes nearest to it."""
    badness = lambda cell: float("inf") if cell["value"] is None else cell["value"]
    failing = sorted((cell for cell in cells if cell["verdict"] == "fails"), key=badness, reverse=True)
    what = f"**{hazard['title']}** (`{hazard['name']}`): "
    if failing:
        names = ", ".join(f"{title(cell)} ({figure(cell['value'])})" for cell in failing[:NAMED])
        more = f" and {len(failing) - NAMED} more" if len(failing) > NAMED else ""
        return f"{what}{len(failing)} of {len(cells)} fail, {names}{more}; worst at {failing[0]['worst'][0]}."
    worse = sorted((cell for cell in cells if cell["verdict"] == "degrades"), key=badness, reverse=True)
    if worse:
        return f"{what}none of {len(cells)} fails, {title(worse[0])} is worst ({figure(worse[0]['value'])})."
    return f"{what}all {len(cells)} hold or refuse."


def sentences(report: dict) -> str:
    lines = []
    for hazard in report["hazards"]:
        cells = [cell for cell in report["cells"] if cell["hazard"] == hazard["name"]]
        picture = ROOT / f"docs/images/stress/{hazard['name']}.png"
        failing = any(cell["verdict"] == "fails" for cell in cells)
        lines.append([f"![{hazard['name']}](images/stress/{picture.name})" if failing and picture.exists() else "", sentence(hazard, cells)])
    return table(["worst example", "finding"], lines, "---")


def thresholds(report: dict) -> str:
    rows = [[f"`{h['name']}`", h["measure"], f"{h['threshold']['holds']:g}", f"{h['threshold']['fails']:g}"] for h in report["hazards"]]
    return table(["hazard", "value", "holds up to", "fails above"], rows)


def stress_section(report: dict) -> str:
    verdicts, cells, extent = report["verdicts"], report["cells"], report["counted"]
    silent = [cell for cell in cells if cell["verdict"] == "fails" and not cell["warnings"]]
    own = [cell for cell in cells if cell["method"].startswith(("znbrdf", "latent"))]
    own_fails = [cell for cell in own if cell["verdict"] == "fails"]
    own_silent = [cell for cell in own_fails if not cell["warnings"]]
    groups = list(dict.fromkeys(hazard["group"] for hazard in report["hazards"]))
    parts = "\n\n".join(f"### {group.capitalize()}\n\n{matrix(report, group)}" for group in groups)
    return f"""## Where methods fail

    scripts/make_stress.sh

{len(report['hazards'])} hazards, {extent['materials']} held-out MERL materials ({extent['few']} of them where each is encoded many times), all pairs of
{extent['ends']} MERL materials, trainings of {extent['steps']} steps, seed {report['seed']}, {report['reference']} reference. {len(cells)} cells: {verdicts['holds']} hold,
{verdicts['degrades']} degrade, {verdicts['refuses']} refuse with an error, {verdicts['fails']} fail, {len(silent)} of these without a warning. Of ZNBRDF and the latent
paths {len(own_fails)} of {len(own)} fail, {len(own_silent)} without a warning.

![Heat map of all verdicts](images/stress.svg)

A cell's value is that of its worst example. Pictures: what should be, what is, FLIP of the two (white is 0.3); or the ends
of a walk and what is between. A method may be exposed to a hazard that no method can bear (a sample that leans cannot be
told from another material): then the verdict is about what comes out, and the warning about whether somebody is told.

{sentences(report)}

Values by method; ~ degrades, ✗ fails, *told* where a warning goes with the worst example.

{parts}

What is measured, and from where on it counts:

{thresholds(report)}
"""
