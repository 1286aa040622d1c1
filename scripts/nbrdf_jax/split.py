"""Which materials nothing learned may see: names sorted, MERL i mod 5 = 2, RGL i mod 4 = 1."""

from collections.abc import Iterable

from .library import database

RULES = {"merl": (5, 2), "rgl": (4, 1)}


def held_out(names: Iterable[str], of: str) -> list[str]:
    """The held-out names of one database, in order. Sort names, not file names: `chrome` < `chrome-steel`,
    yet `chrome-steel.h5` < `chrome.h5`."""
    modulus, remainder = RULES[of]
    mine = sorted(name for name in names if database(name) == of)
    return [name for index, name in enumerate(mine) if index % modulus == remainder]
