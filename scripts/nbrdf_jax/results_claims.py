"""Finds, for every figure that docs/results.md prints and that was recomputed, the figure that it must round to."""

from collections.abc import Iterator

from .agreement import mean_of_lobe, of_count, of_part
from .allowance import of_family
from .claims import Claim, Table, absent, numbers, section, tables
from .families import Family
from .held_out import Recomputed
from .interpolation import LEFT_OUT, Walked
from .summary_claims import ABSENT, TOO_FEW, Rows, of_summary

COLUMNS = {f"{light} {title}": f"{light}_{key}" for light in ("point", "studio") for title, key in (("PSNR", "psnr"), ("SSIM", "ssim"), ("FLIP", "flip"), ("ΔE_ITP", "delta_e_itp"))}
COLUMNS |= {"log_error": "log_error", "relative_log": "relative_log"}
DATABASES = {"Representations, 20 held-out MERL": "merl", "Representations, 9 held-out materials of another": "rgl"}
HARDEST = "Where ZNBRDF's log_error is above PCA-32's"
INTERPOLATION = "Interpolation, 100 pairs"
FAMILIES = "Families with a known middle"
TIMES = ("encode ms", "ns per evaluation", "shared MB")
TIME = "a time or a size, not a figure of quality"
PARTS = {"mean": "mean", "median": "median", "p90": "p90", "worst": "max"}


def of_page(page: str, rows: list[Recomputed], walks: list[Walked], pairs: int, families: dict[str, dict[Family, float]]) -> Iterator[Claim]:
    """All claims of the page's tables and summary, recomputed or not."""
    known = {(found.row.database, found.row.name, found.row.variant): found for found in rows}
    methods = {found.name: found for found in walks} if pairs >= 100 else {}
    yield from of_summary(section(page, "In short"), known, methods)
    yield from _missing(page, known, methods, families)
    for table in tables(page):
        database = next((database for start, database in DATABASES.items() if table.heading.startswith(start)), None)
        if database:
            yield from _held_out(table, database, known)
        elif table.heading == HARDEST and "material" in table.columns[0]:
            yield from _hardest(table, known)
        elif table.heading.startswith(INTERPOLATION) and table.columns[0] == "method":
            yield from _interpolation(table, methods)
        elif table.heading.startswith(FAMILIES):
            yield from _families(table, families)
        else:
            for row in table.rows:
                for cell in row[1:]:
                    yield from (Claim(table.heading, printed, reason="no second implementation of what this table measures") for printed in numbers(cell))


def _missing(page: str, known: Rows, methods: dict[str, Walked], families: dict[str, dict[Family, float]]) -> Iterator[Claim]:
    """What was recomputed and has no row on the page."""
    printed = {(table.heading, row[0]) for table in tables(page) for row in table.rows}
    wanted = [(start, f"`{name}` {variant.replace('_', '-')}") for start, of in DATABASES.items() for database, name, variant in known if of == database]
    wanted += [(start, f"`{name}`") for start, names in ((INTERPOLATION, methods), (FAMILIES, families)) for name in names]
    for start, row in wanted:
        if not any(heading.startswith(start) and row == found for heading, found in printed):
            yield absent(f"{start}…: {row}")


def _held_out(table: Table, database: str, known: Rows) -> Iterator[Claim]:
    for row in table.rows:
        name, _, variant = row[0].replace("`", "").partition(" ")
        found = known.get((database, name, variant.replace("-", "_")))
        where, key = f"{table.heading[:45]}…: {row[0]}", ""
        for column, cell in zip(table.columns[1:], row[1:]):
            title, _, part = column.rpartition(" ")
            key = COLUMNS.get(column) or COLUMNS.get(title) or (key if column in ("p90", "worst") else "")
            label = f"{where}, {column}"
            if column in TIMES:
                yield from (Claim(label, printed, reason=TIME) for printed in numbers(cell))
            elif not key:
                yield absent(label)
            elif found is None:
                yield from (Claim(label, printed, reason=ABSENT) for printed in numbers(cell)[:2])
            elif column == "worst":
                yield from _names(label, cell.split(", "), dict(zip(found.names, found.figures[key])), found.spread(key).worst)
            else:
                spread = found.spread(key)
                parts = ("mean", "max") if column in COLUMNS else ("p90" if column == "p90" else part,)
                yield from (Claim(f"{label} {part}", printed, getattr(spread, part), "", of_part(found, key, part)) for part, printed in zip(parts, numbers(cell)))


def _names(label: str, printed: list[str], figures: dict[str, float], worst: tuple[str, ...]) -> Iterator[Claim]:
    """Names in the order of their figures: a name is right where its figure is that of its rank, in three digits or nine decimals."""
    for place, (name, expected) in enumerate(zip(printed, worst)):
        if name in figures:
            yield Claim(f"{label}, place {place + 1}: {name}", f"{round(figures[expected], 9):.2e}", round(figures[name], 9))
        else:
            yield absent(f"{label}, place {place + 1}: {name}")


def _hardest(table: Table, known: Rows) -> Iterator[Claim]:
    columns = [known.get(("merl", name, variant)) for name, variant in (("znbrdf", "unrolled"), ("znbrdf", "refined"), ("pca_tables", "projection"), ("pca_tables", "refined"))]
    for row in table.rows:
        for column, found, cell in zip(table.columns[1:], columns, row[1:]):
            label = f"{table.heading}: {row[0]}, {column}"
            value = float(found.figures["log_error"][found.names.index(row[0])]) if found and row[0] in found.names else None
            yield from (Claim(label, printed, value, "" if value is not None else ABSENT) for printed in numbers(cell))


def _interpolation(table: Table, methods: dict[str, Walked]) -> Iterator[Claim]:
    for row in table.rows:
        method, key = row[0].strip("`"), ""
        found = methods.get(method)
        for column, cell in zip(table.columns[1:], row[1:]):
            label = f"{table.heading[:25]}…: {method}, {column}"
            key, _, part = f"{key} {column}".rpartition(" ") if column in PARTS else column.rpartition(" ")
            if column.startswith("worst by "):
                if found:
                    key = column.removeprefix("worst by ")
                    yield from _names(label, cell.split("; "), dict(zip(found.pairs, found.figures[key])), found.spread(key).worst)
            elif found is None:
                yield from (Claim(label, printed, reason=LEFT_OUT.get(method, TOO_FEW)) for printed in numbers(cell))
            elif column in ("energy_violations", "_beyond"):
                key = "energy_violations" + column.removeprefix("energy_violations")
                yield Claim(label, cell, float(found.violations(key.replace("energy_violations", "albedo_max"))), "", of_count(found, key))
            elif part in PARTS and key in found.figures:
                yield Claim(label, cell, getattr(found.spread(key), PARTS[part]), "", of_part(found, key, PARTS[part]))
            else:
                yield absent(label)


def _families(table: Table, families: dict[str, dict[Family, float]]) -> Iterator[Claim]:
    """The mean of every lobe, in bold, beside that of walks between ends that are fitted here."""
    for row in table.rows:
        method = row[0].strip("`")
        for column, cell in zip(table.columns[1:], row[1:]):
            label, (mean, *others) = f"{table.heading[:28]}: {method}, {column}", numbers(cell)
            errors = families.get(method)
            if errors is None:
                yield Claim(label, mean, reason=LEFT_OUT.get(method, "families were not walked"))
            else:
                yield Claim(label, mean, mean_of_lobe(errors, column.split()[0]), "", of_family(method))
            yield from (Claim(label, printed, reason="of one family, which depends on its fits") for printed in others)
