"""Two programs side by side: as text for the terminal, and as a page with pictures."""

from collections import Counter
from pathlib import Path

from . import page, plots
from .agreement import Check
from .claims import Claim
from .held_out import Recomputed
from .interpolation import Walked
from .page import Section


def table(checks: list[Check], tolerance: float) -> list[tuple[str, ...]]:
    """The checks as rows of text, the heading first."""
    rows = [("row", "key", "ours", "report", "relative", "", "material that differs most")]
    return rows + [(check.label, check.key, f"{check.ours:.6g}", f"{check.claimed:.6g}", f"{check.difference:.1e}", check.verdict(tolerance), check.worst) for check in checks]


def summary(checks: list[Check], tolerance: float) -> list[tuple[str, ...]]:
    """One row of text for every representation or method, the heading first: the report has all figures."""
    rows = [("row", "figures", "agree", "largest difference without a reason", "for a reason")]
    for label in dict.fromkeys(check.label for check in checks):
        mine = [check for check in checks if check.label == label]
        plain, excused = ([check for check in mine if (check.difference > tolerance and check.agrees(tolerance)) == is_excused] for is_excused in (False, True))
        worst = max(plain, key=lambda check: check.difference, default=None)
        keys = sorted({check.key.split()[0] for check in excused})
        rows.append((label, str(len(mine)), str(sum(check.agrees(tolerance) for check in mine)), f"{worst.difference:.1e} {worst.key}" if worst else "-", ", ".join(keys) or "-"))
    return rows


def aligned(rows: list[tuple[str, ...]]) -> str:
    """Rows as text in columns."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows)


def written(folder: Path, rows: list[Recomputed], walks: list[Walked], checks: list[Check], claims: list[Claim], tolerance: float) -> Path:
    """The report with pictures."""
    wrong, broken = [check for check in checks if not check.agrees(tolerance)], [claim for claim in claims if claim.found is not None and not claim.holds]
    unchecked = Counter((claim.where.partition(":")[0], claim.reason) for claim in claims if claim.found is None)
    summary = f"{len(checks) - len(wrong)} of {len(checks)} figures agree. Of what docs/results.md prints, {sum(claim.holds for claim in claims)} figures hold, {len(broken)} do not, {unchecked.total()} were not recomputed."
    sections = [Section("Agreement", summary, plots.differences(checks, tolerance), table(checks, tolerance))]
    pictures = (("Held-out materials", plots.materials(rows)), ("Walks", plots.methods(walks) if walks else None))
    sections += [Section(title, picture=picture) for title, picture in pictures if picture]
    if broken:
        sections.append(Section("Claims that do not hold", rows=[("claim", "printed", "found"), *((claim.where, claim.printed, f"{claim.found:.6g}") for claim in broken)]))
    if unchecked:
        sections.append(Section("What was not recomputed", rows=[("section of docs/results.md", "why", "figures"), *((where, reason, str(count)) for (where, reason), count in unchecked.items())]))
    return page.write(folder, "Two implementations, side by side", sections)[1]
