"""Two programs side by side: as text for the terminal, and as a page with pictures."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from . import page, plots
from .agreement import Check
from .claims import Claim, Status, of_status
from .compared import Compared
from .page import Section
from .tally import Reason, Tally, by_row, reasons_of_checks, reasons_of_claims, recomputed, tallies, tally

PAGE = "docs/results.md"
Rows = list[tuple[str, ...]]


def table(checks: Sequence[Check], tolerance: float) -> Rows:
    """The checks as rows of text, the heading first."""
    rows: Rows = [("row", "key", "found here", "report", "relative difference", "", "material that differs most")]
    return rows + [(check.label, check.key, f"{check.ours:.6g}", f"{check.claimed:.6g}", share(check.difference), check.verdict(tolerance), check.worst) for check in checks]


def counts(found: Sequence[Tally], heading: str, tolerance: float) -> Rows:
    """Tallies as rows of text, the heading first."""
    rows: Rows = [(heading, "figures", f"within {tolerance:g}", "largest of these", "where", "further, for a reason", "largest of these", "where", "disagree")]
    for own in found:
        wider = (str(own.wider), share(own.widest), own.widest_where) if own.wider else ("–", "–", "–")
        rows.append((own.name, str(own.figures), str(own.close), share(own.largest), own.where if own.largest else "–", *wider, str(own.apart) if own.apart else "–"))
    return rows


def reasons(found: Sequence[Reason], heading: str) -> Rows:
    """Reasons as rows of text, the heading first."""
    return [(heading, "figures", "largest relative difference", "where"), *((own.reason, str(own.figures), share(own.largest), own.where) for own in found)]


def share(difference: float) -> str:
    """A relative difference."""
    return f"{difference:.1e}" if difference else "0"


def finding(found: Compared, tolerance: float) -> str:
    """How many figures agree, in a sentence."""
    return agreed(tally("all", recomputed(found.checks), tolerance), tolerance)


def agreed(own: Tally, tolerance: float) -> str:
    """A tally in a sentence."""
    return f"{own.close} of {own.figures} figures agree within {tolerance:g}, {own.wider} are further apart for a stated reason, {own.apart or 'none'} disagree"


def claimed(claims: Sequence[Claim]) -> str:
    """What became of the page's figures, in a sentence."""
    return told({status.value: len(of_status(claims, status)) for status in Status})


def told(found: dict[str, int]) -> str:
    """Counts of claims by status, in a sentence."""
    holds, allowed, fails, unchecked = (found[status.value] for status in Status)
    return f"{PAGE}: {holds} printed figures hold, {allowed} hold within a stated allowance, {fails} do not hold, {unchecked} were not recomputed"


def aligned(rows: Rows) -> str:
    """Rows as text in columns."""
    widths = [max(len(row[column]) for row in rows) for column in range(len(rows[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows)


def printed(found: Compared, claims: Sequence[Claim], tolerance: float) -> str:
    """Counts of every row and what is wrong: the report has all figures."""
    wrong = [check for check in found.checks if not check.agrees(tolerance)]
    parts = [aligned([row[:4] + row[5:7] + row[8:] for row in counts(by_row(found.checks, tolerance), "row", tolerance)])]
    parts += [f"{found.row.label}: largest difference of a code number, of the largest {found.code_difference:.1e}" for found in found.rows if found.code_difference is not None]
    parts += [aligned(table(wrong, tolerance))] if wrong else []
    parts += [f"DOES NOT HOLD  {claim.where}: {claim.finding}" for claim in of_status(claims, Status.FAILS)]
    if claims:
        parts.append(claimed(claims))
        parts += [f"  {own.figures:5} within an allowance: {own.reason}" for own in reasons_of_claims(claims, Status.ALLOWED)]
        parts += [f"  {own.figures:5} not recomputed: {own.reason}" for own in reasons_of_claims(claims, Status.UNCHECKED)]
    return "\n".join([*parts, finding(found, tolerance)])


def written(folder: Path, found: Compared, claims: Sequence[Claim], tolerance: float) -> Path:
    """The report with pictures; the path of its page of HTML."""
    checks = found.checks
    sections = [Section(finding(found, tolerance), picture=plots.differences(checks, tolerance), rows=counts(tallies(checks, lambda check: check.kind, tolerance), "kind of figure", tolerance))]
    if why := reasons_of_checks(checks, tolerance):
        sections.append(Section("Why figures are further apart", rows=reasons(why, "reason")))
    if claims:
        sections.append(Section(claimed(claims), rows=[("", "figures"), *((status.value, str(len(of_status(claims, status)))) for status in Status)]))
    if broken := of_status(claims, Status.FAILS):
        sections.append(Section("Claims that do not hold", rows=[("claim", "finding"), *((claim.where, claim.finding) for claim in broken)]))
    if allowed := reasons_of_claims(claims, Status.ALLOWED):
        sections.append(Section("Claims that hold within a stated allowance", rows=reasons(allowed, "reason")))
    pictures = (plots.materials(found.rows), plots.methods(found.walks) if found.walks else None)
    sections += [Section(title, picture=picture) for title, picture in zip(("Held-out materials", "Walks"), pictures) if picture]
    unchecked = Counter((claim.where.partition(":")[0], claim.reason) for claim in of_status(claims, Status.UNCHECKED))
    if unchecked:
        rows: Rows = [("where on the page", "why", "figures"), *((where, reason, str(count)) for (where, reason), count in unchecked.items())]
        sections.append(Section("What was not recomputed", rows=rows))
    sections.append(Section("All figures", rows=table(checks, tolerance)))
    return page.write(folder, "Two implementations, side by side", sections)[1]
