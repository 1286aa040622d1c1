"""What docs/results.md claims in tables and in its summary, each cell beside the figure that was recomputed for it."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from decimal import Decimal
from enum import Enum

from .allowance import TOLERANCE, Allowance

NUMBER = re.compile(r"[-+]?\d[\d ]*\.?\d*(?:e[-+]?\d+)?")


class Status(Enum):
    """What became of a printed figure; the value says it in a table."""

    HOLDS = "holds"
    ALLOWED = "holds within its stated allowance"
    FAILS = "does not hold"
    UNCHECKED = "not recomputed"


@dataclass(frozen=True)
class Table:
    """A table of a page, under the heading that it stands below."""

    heading: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Claim:
    """One printed figure: where, what is printed, what was found; nothing, and the reason, where it cannot be recomputed."""

    where: str
    printed: str
    found: float | None = None
    reason: str = ""
    allowance: Allowance | None = None

    @property
    def is_exact(self) -> bool:
        """Whether the figure found rounds to what is printed, give or take a ten-thousandth."""
        if self.found is None:
            return False
        return bool(abs(self.found - self._number) <= self._half * (1 + 1e-9) + TOLERANCE * abs(self.found))

    @property
    def status(self) -> Status:
        """Where a figure has a reason to be further off, any number that is printed alike must lie within what that admits."""
        if self.found is None:
            return Status.UNCHECKED
        if self.is_exact:
            return Status.HOLDS
        nearest = (self._number, self._number - self._half, self._number + self._half)
        is_admitted = self.allowance is not None and any(self.allowance.admits(self.found, number) for number in nearest)
        return Status.ALLOWED if is_admitted else Status.FAILS

    @property
    def difference(self) -> float:
        """Of the figure found from what is printed, relative to that."""
        return abs((self.found or 0.0) - self._number) / max(abs(self._number), 1e-12)

    @property
    def finding(self) -> str:
        """What is wrong with a figure that does not hold."""
        return self.reason or f"printed {self.printed}, found {self.found:.6g}"

    @property
    def _number(self) -> float:
        return float(self.printed.replace(" ", ""))

    @property
    def _half(self) -> float:
        """Half of the last digit that is printed."""
        last = Decimal(self.printed.replace(" ", "")).as_tuple().exponent
        return 0.5 * 10.0**last if isinstance(last, int) else 0.0


def absent(where: str) -> Claim:
    """What the page should print and does not, or not as it is looked for: it does not hold, else it would pass unseen."""
    return Claim(where, "nan", float("nan"), "the page prints nothing of the kind")


def of_status(claims: Iterable[Claim], status: Status) -> list[Claim]:
    """Those of one status."""
    return [claim for claim in claims if claim.status is status]


def tables(page: str) -> Iterator[Table]:
    """All tables of a Markdown page."""
    heading, block = "", []
    for line in [*page.splitlines(), ""]:
        if line.startswith("|"):
            block.append(tuple(cell.strip() for cell in line.strip().strip("|").split("|")))
            continue
        if len(block) > 2:
            yield Table(heading, block[0], tuple(block[2:]))
        block = []
        if line.startswith("## "):
            heading = line.removeprefix("## ").strip()


def section(page: str, heading: str) -> str:
    """The text below a heading, its lines joined."""
    _, _, rest = page.partition(f"## {heading}\n")
    return " ".join(rest.partition("\n## ")[0].split())


def numbers(cell: str) -> list[str]:
    """The numbers printed in a cell: `46.2 (40.0)` has two."""
    return [found.strip() for found in NUMBER.findall(cell.replace("*", ""))]
