"""Counts of figures that agree: of every kind, of every row, and for every reason to be further apart."""

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass

from .agreement import OF_MEANS, Check
from .claims import Claim, Status, of_status
from .compared import Compared


@dataclass(frozen=True)
class Tally:
    """Figures of one kind or row. `largest` and `where`: of those within the tolerance; `wider`: those that a reason admits."""

    name: str
    figures: int
    close: int
    largest: float
    where: str
    wider: int
    widest: float
    widest_where: str
    apart: int


@dataclass(frozen=True)
class Reason:
    """How many figures a reason admits, and the furthest apart of them."""

    reason: str
    figures: int
    largest: float = 0.0
    where: str = ""


def tallies(checks: Sequence[Check], of: Callable[[Check], str], tolerance: float) -> list[Tally]:
    """One for every name that `of` gives, in the order of the checks."""
    return [tally(name, [check for check in checks if of(check) == name], tolerance) for name in dict.fromkeys(map(of, checks))]


def recomputed(checks: Sequence[Check]) -> list[Check]:
    """Without the report's means over its own figures, which ask nothing of this implementation but a sum."""
    return [check for check in checks if check.kind != OF_MEANS]


def by_row(checks: Sequence[Check], tolerance: float) -> list[Tally]:
    """One for every row of a report and every method, of what is recomputed."""
    return tallies(recomputed(checks), lambda check: check.label, tolerance)


def tally(name: str, checks: Sequence[Check], tolerance: float) -> Tally:
    """Of at least one check."""
    close = [check for check in checks if check.is_close(tolerance)]
    wider = [check for check in checks if check.agrees(tolerance) and not check.is_close(tolerance)]
    (largest, where), (widest, widest_where) = _furthest(close), _furthest(wider)
    where, widest_where = (place.removeprefix(f"{name}, ") for place in (where, widest_where))
    return Tally(name, len(checks), len(close), largest, where, len(wider), widest, widest_where, len(checks) - len(close) - len(wider))


def reasons_of_checks(checks: Sequence[Check], tolerance: float) -> list[Reason]:
    """Why figures are further apart than the tolerance."""
    wider = [check for check in checks if check.agrees(tolerance) and not check.is_close(tolerance)]
    names = dict.fromkeys(check.allowance.reason for check in wider if check.allowance)
    groups = {reason: [check for check in wider if check.allowance and check.allowance.reason == reason] for reason in names}
    return [Reason(reason, len(group), *_furthest(group)) for reason, group in groups.items()]


def reasons_of_claims(claims: Sequence[Claim], status: Status) -> list[Reason]:
    """Why printed figures hold in a wider sense, or were not recomputed; the most frequent first."""
    groups: dict[str, list[Claim]] = {}
    for claim in of_status(claims, status):
        groups.setdefault(claim.allowance.reason if claim.found is not None and claim.allowance else claim.reason, []).append(claim)
    found = []
    for reason, group in sorted(groups.items(), key=lambda item: -len(item[1])):
        furthest = max(group, key=lambda claim: claim.difference)
        found.append(Reason(reason, len(group), furthest.difference, furthest.where) if status is Status.ALLOWED else Reason(reason, len(group)))
    return found


def recorded(found: Compared, claims: Sequence[Claim], pairs: int, tolerance: float) -> dict:
    """What docs/agreement.json holds; scripts/make_agreement.py makes a page of it."""
    checks = found.checks
    return {
        "schema": 1,
        "command": "python scripts/evaluate.py --record docs/agreement.json",
        "tolerance": tolerance,
        "pairs": pairs,
        "all": asdict(tally("all", recomputed(checks), tolerance)),
        "without_reason": dict(zip(("largest", "where"), _furthest([check for check in recomputed(checks) if check.allowance is None]))),
        "kinds": [asdict(own) for own in tallies(checks, lambda check: check.kind, tolerance)],
        "rows": [asdict(own) for own in by_row(checks, tolerance)],
        "reasons": [asdict(own) for own in reasons_of_checks(checks, tolerance)],
        "codes": [{"row": own.row.label, "difference": own.code_difference} for own in found.rows if own.code_difference is not None],
        "claims": {status.value: len(of_status(claims, status)) for status in Status},
        "claims_allowed": [asdict(own) for own in reasons_of_claims(claims, Status.ALLOWED)],
        "claims_not_recomputed": [asdict(own) for own in reasons_of_claims(claims, Status.UNCHECKED)],
    }


def _furthest(checks: Sequence[Check]) -> tuple[float, str]:
    worst = max(checks, key=lambda check: check.difference, default=None)
    return (worst.difference, f"{worst.label}, {worst.key}") if worst else (0.0, "–")
