"""Results of slow pieces of work on disk: a run that was stopped goes on where it was, and a second one of the same is quick.

A result is used again only where nothing that it depends on has changed: the files given, the modules that made it and what
they import, the item itself. What presents results is no part of that.
"""

import ast
import hashlib
import json
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

import jax
import numpy as np

from .fitted_library import whole
from .workers import each, silent

Item = TypeVar("Item")
HERE = Path(__file__).parent


@dataclass(frozen=True)
class Kept:
    """Results below a folder; `fingerprint` is of all that every one of them depends on."""

    folder: Path
    fingerprint: str
    progress: Callable = silent  # a bar around the items as they are done

    @classmethod
    def of(cls, folder: Path, files: Sequence[Path], modules: Sequence[str], progress: Callable = silent) -> "Kept":
        """Of results that these files and modules decide."""
        versions = f"{jax.__version__} {np.__version__}"
        return cls(folder, digest(versions, *(path.read_bytes() for path in files), *(source for module in modules for source in sources(module))), progress)

    def each(self, what: str, work: Callable[[Item], Any], items: Sequence[Item], before: Callable[[], object] = lambda: None, of: object = None) -> list[Any]:
        """Results, which JSON can hold, in the order of the items. `before` is called once, before anything is worked on;
        `of` is what else the results depend on."""
        paths = [self.folder / f"{digest(self.fingerprint, what, repr(of), repr(item))}.json" for item in items]
        missing = [place for place, path in enumerate(paths) if not path.is_file()]
        print(f"{what}: {len(missing)} of {len(items)} to do" + (", the others are kept from an earlier run" if len(missing) < len(items) else ""), file=sys.stderr)
        if missing:
            self.folder.mkdir(parents=True, exist_ok=True)
            before()
        for place, result in zip(missing, self.progress(each(work, [items[place] for place in missing]), what, len(missing))):
            whole(paths[place], json.dumps(result).encode())
        return [json.loads(path.read_bytes()) for path in paths]


def digest(*parts: str | bytes) -> str:
    """SHA-256 of parts, which cannot be taken for other parts joined alike."""
    found = hashlib.sha256()
    for part in parts:
        content = part.encode() if isinstance(part, str) else part
        found.update(len(content).to_bytes(8, "little") + content)
    return found.hexdigest()


@cache
def sources(module: str) -> tuple[bytes, ...]:
    """The text of a module of this package and of all that it imports from it, by name."""
    found: dict[str, bytes] = {}
    waiting = [module]
    while waiting:
        name = waiting.pop()
        path = HERE / f"{name}.py"
        if name in found or not path.is_file():
            continue
        found[name] = path.read_bytes()
        for node in ast.walk(ast.parse(found[name])):
            if isinstance(node, ast.ImportFrom) and node.level == 1:
                waiting += [node.module] if node.module else [alias.name for alias in node.names]
    return tuple(found[name] for name in sorted(found))
