"""Finds, for every figure that docs/results.md prints and that was recomputed, the figure that it must round to."""

import re
from collections.abc import Iterator

from .agreement import TOLERANCE, mean_of_lobe, of_family
from .claims import Claim, Table, numbers, section, tables
from .families import Family
from .held_out import Recomputed
from .interpolation import LEFT_OUT, Walked

COLUMNS = {f"{light} {title}": f"{light}_{key}" for light in ("point", "studio") for title, key in (("PSNR", "psnr"), ("SSIM", "ssim"), ("FLIP", "flip"), ("ΔE_ITP", "delta_e_itp"))}
COLUMNS |= {"log_error": "log_error", "relative_log": "relative_log"}
DATABASES = {"Representations, 20 held-out MERL": "merl", "Representations, 9 held-out materials of another": "rgl"}
HARDEST = "Where ZNBRDF's log_error is above PCA-32's"
INTERPOLATION = "Interpolation, 100 pairs"
FAMILIES = "Families with a known middle"
ABSENT = "not in the report that was read"
TIME = "a time or a size, not a figure of quality"
PARTS = {"mean": "mean", "median": "median", "p90": "p90", "worst": "max"}

Rows = dict[tuple[str, str, str], Recomputed]


def of_page(page: str, rows: list[Recomputed], walks: list[Walked], pairs: int, families: dict[str, dict[Family, float]]) -> Iterator[Claim]:
    """All claims of the page's tables and summary, recomputed or not."""
    known = {(found.row.database, found.row.name, found.row.variant): found for found in rows}
    methods = {found.name: found for found in walks} if pairs >= 100 else {}
    yield from _summary(section(page, "In short"), known, methods)
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


def _held_out(table: Table, database: str, known: Rows) -> Iterator[Claim]:
    for row in table.rows:
        name, _, variant = row[0].replace("`", "").partition(" ")
        found = known.get((database, name, variant.replace("-", "_")))
        where, key = f"{table.heading[:45]}…: {row[0]}", ""
        for column, cell in zip(table.columns[1:], row[1:]):
            title, _, part = column.rpartition(" ")
            key = COLUMNS.get(column) or COLUMNS.get(title) or (key if column in ("p90", "worst") else "")
            label = f"{where}, {column}"
            if not key:
                yield from (Claim(label, printed, reason=TIME) for printed in numbers(cell))
            elif found is None:
                yield from (Claim(label, printed, reason=ABSENT) for printed in numbers(cell)[:2])
            elif column == "worst":
                yield from _names(label, cell.split(", "), dict(zip(found.names, found.figures[key])), found.spread(key).worst)
            else:
                spread = found.spread(key)
                parts = ("mean", "max") if column in COLUMNS else ("p90" if column == "p90" else part,)
                yield from (Claim(f"{label} {part}", printed, getattr(spread, part)) for part, printed in zip(parts, numbers(cell)))


def _names(label: str, printed: list[str], figures: dict[str, float], worst: tuple[str, ...]) -> Iterator[Claim]:
    """Names in the order of their figures: a name is right where its figure is that of its rank, in three digits."""
    for place, (name, expected) in enumerate(zip(printed, worst)):
        if name in figures:
            yield Claim(f"{label}, place {place + 1}: {name}", f"{figures[expected]:.3g}", figures[name])
        else:
            yield Claim(f"{label}, place {place + 1}", "0", float("nan"))


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
                yield from (Claim(label, printed, reason=LEFT_OUT.get(method, "not all 100 pairs were walked")) for printed in numbers(cell))
            elif column in ("energy_violations", "_beyond"):
                # Albedos of two quadratures: a pair may be counted by one alone.
                count = found.violations("albedo_max" + column.removeprefix("energy_violations"))
                yield Claim(label, cell, float(cell) if abs(count - float(cell)) <= 2 else float(count))
            elif method == "log_mix" and key == "negative_share":
                yield Claim(label, cell, reason="the sign of rounding, where both ends are 0")
            else:
                yield Claim(label, cell, getattr(found.spread(key), PARTS[part]))


def _families(table: Table, families: dict[str, dict[Family, float]]) -> Iterator[Claim]:
    """The mean of every lobe, in bold, holds where both programs' own fits agree as far as they can."""
    for row in table.rows:
        method = row[0].strip("`")
        for column, cell in zip(table.columns[1:], row[1:]):
            label, (mean, *others) = f"{table.heading[:28]}: {method}, {column}", numbers(cell)
            errors = families.get(method)
            if errors is None:
                yield Claim(label, mean, reason=LEFT_OUT.get(method, "families were not walked"))
            else:
                check = of_family(method, column.split()[0], mean_of_lobe(errors, column.split()[0]), float(mean))
                yield Claim(label, mean, check.claimed if check.agrees(TOLERANCE) else check.ours)
            yield from (Claim(label, printed, reason="of one family, which depends on its fits") for printed in others)


def _summary(text: str, known: Rows, methods: dict[str, Walked]) -> Iterator[Claim]:
    projection, refined = known.get(("merl", "pca_tables", "projection")), known.get(("merl", "pca_tables", "refined"))
    against = (
        ("unrolled", projection, r"against PCA-32's projection: ([^`]*?)\. -"),
        ("feed_forward", projection, r"The encoder alone against it: ([^`]*?)\. -"),
        ("refined", refined, r"against PCA-32's \*refined\* codes: ([^`]*?)\. -"),
    )
    for variant, base, pattern in against:
        ours, printed = known.get(("merl", "znbrdf", variant)), re.search(pattern, text)
        if printed is None:
            continue
        for title, key, part, number in _comparisons(printed[1]):
            label = f"In short: ZNBRDF {variant} against PCA-32, {title}"
            if ours is None or base is None:
                yield Claim(label, number, reason=ABSENT)
                continue
            a, b = (getattr(found.spread(key), part) for found in (ours, base))
            yield Claim(label, number, a / b if key == "log_error" else a - b)
    for method, number in re.findall(r"`(\w+)` ([\d.]+)", text.partition("median PSNR): ")[2].partition(". -")[0]):
        found = methods.get(method)
        reason = LEFT_OUT.get(method, "not all 100 pairs were walked")
        yield Claim(f"In short: median mix_psnr of {method}", number.rstrip("."), found.spread("mix_psnr").median if found else None, "" if found else reason)


def _comparisons(text: str) -> Iterator[tuple[str, str, str, str]]:
    """Title, key, part of the spread, printed number."""
    for title, key, part, pattern in (
        ("log_error", "log_error", "mean", r"log_error ([\d.]+) ×"),
        ("studio PSNR", "studio_psnr", "mean", r"studio PSNR ([-+][\d.]+) dB"),
        ("studio SSIM", "studio_ssim", "mean", r"SSIM ([-+][\d.]+\d)"),
        ("worst material", "studio_psnr", "max", r"worst material ([-+][\d.]+) dB"),
    ):
        found = re.search(pattern, text)
        if found:
            yield title, key, part, found[1]
