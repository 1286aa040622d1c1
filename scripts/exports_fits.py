"""The section on fits of standard models, of docs/parametric.json."""

from results_table import number, table

FITS = {"gltf": "glTF", "open_pbr": "OpenPBR", "principled": "Principled"}
DATABASES = {"merl": "MERL", "rgl": "RGL"}


def models_table(record: dict) -> str:
    """How far standard shading models are, for every database and model."""
    rows = []
    for database, models in record["databases"].items():
        for model, row in models.items():
            error, relative, psnr, itp = (row[key] for key in ("log_error", "relative_log", "studio_psnr", "studio_delta_e_itp"))
            rows.append([
                f"{FITS[model]}, {DATABASES[database]}", str(row["materials"]), number(error["mean"], 4), number(error["max"], 4), number(relative["mean"], 3),
                number(psnr["mean"], 1), number(psnr["max"], 1), number(itp["mean"], 1), number(itp["max"], 1), ", ".join(psnr["worst"][:2]),
            ])  # fmt: skip
    head = ["model, database", "materials", "log_error, mean", "worst", "relative_log, mean", "studio PSNR, mean", "worst", "ΔE_ITP, mean", "worst", "worst two by PSNR"]
    return table(head, rows)


def parts(record: dict) -> str:
    """How many materials of MERL use which part of each model."""
    of = lambda row: ", ".join(f"{part} {count}" for part, count in sorted(row["parts"].items(), key=lambda item: -item[1]) if part)  # noqa: E731
    told = [f"{FITS[model]}: {of(row) or 'none'}" for model, row in record["databases"]["merl"].items()]
    return "; ".join(told)


def closest(record: dict) -> str:
    """The model that is closest in the mean, by pictures, for each database."""
    told = []
    for database, models in record["databases"].items():
        model, row = max(models.items(), key=lambda item: item[1]["studio_psnr"]["mean"])
        psnr = row["studio_psnr"]
        told.append(f"{FITS[model]} to {DATABASES[database]} ({psnr['mean']:.0f} dB in the mean, {psnr['max']:.0f} at worst)")
    return ", ".join(told)


def section(record: dict) -> str:
    """As it stands on the page."""
    return f"""## As parameters of standard models: closest is {closest(record)}

For tools that accept nothing else: every published network fitted by each model (`{record["command"]}`;
[parametric.json](parametric.json)), judged as the specification evaluates those numbers. Each export comes with its own error and a picture
of the difference. The fuzz of OpenPBR and the sheen of Principled are not fitted: tools take them from tables of their own, which nothing
here could be checked against; glTF's sheen is a formula, and is.

{models_table(record)}

Parts beyond base, metalness and roughness that MERL's materials use, by count: {parts(record)}.
"""
