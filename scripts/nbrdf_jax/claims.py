"""What docs/results.md claims in tables and in its summary, each cell beside the figure that was recomputed for it."""

import re
from collections.abc import Iterator
from dataclasses import dataclass

NUMBER = re.compile(r"[-+]?\d[\d ]*\.?\d*(?:e[-+]?\d+)?")


@dataclass(frozen=True)
class Table:
    """A table of a page, under the heading that it stands below."""

    heading: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Claim:
    """One printed figure: where, what is printed, what was found; nothing where it cannot be recomputed."""

    where: str
    printed: str
    found: float | None = None
    reason: str = ""

    @property
    def holds(self) -> bool:
        """Whether the figure found rounds to what is printed, give or take a ten-thousandth."""
        if self.found is None:
            return False
        number = float(self.printed.replace(" ", ""))
        decimals = len(self.printed.partition(".")[2])
        return bool(abs(self.found - number) <= 0.5 * 10.0**-decimals * (1 + 1e-9) + 1e-4 * abs(self.found))


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
