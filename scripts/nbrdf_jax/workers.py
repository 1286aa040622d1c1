"""Pieces of work on all cores. NumPy and JAX let other threads run while they compute."""

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from tqdm import tqdm

Item, Result = TypeVar("Item"), TypeVar("Result")


def all_of(what: str, work: Callable[[Item], Result], items: Sequence[Item], before: Callable[[], object] = lambda: None, of: object = None) -> list[Result]:
    """Results in the order of the items, made now; `before` is called first. `Kept.each` keeps them, by `what` they are and `of` what."""
    before()
    return list(each(work, items))


def silent(items: Iterable[Item], label: str, total: int) -> Iterable[Item]:
    """A progress bar that shows nothing: of `total` items, what is done is called `label`."""
    return items


def bar(items: Iterable[Item], label: str, total: int) -> Iterable[Item]:
    """A progress bar on stderr, gone when done; none where nobody looks."""
    return tqdm(items, desc=label, total=total, leave=False, file=sys.stderr, disable=None)


def each(work: Callable[[Item], Result], items: Sequence[Item]) -> Iterator[Result]:
    """Results in the order of the items, one after the other as they are done."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        yield from pool.map(work, items)
