"""The one error of everything that reads a file: which file, what was expected, what was found, what to do."""

import sys
from collections.abc import Callable
from pathlib import Path


class InvalidFile(Exception):
    """A file is missing or does not hold what it should. The scripts turn it into exit code 3."""

    def __init__(self, path: Path | str, expected: str, found: str, remedy: str = "") -> None:
        lines = [f"{path}: expected {expected}, found {found}"]
        super().__init__("\n".join(lines + ([f"  try: {remedy}"] if remedy else [])))


def exit_code(run: Callable[[], int]) -> int:
    """What `run` returns; 3, with the reason on standard error, where a file is missing or invalid."""
    try:
        return run()
    except InvalidFile as error:
        print(f"error: {error}", file=sys.stderr)
    except OSError as error:
        print(f"error: {error.filename}: {error.strerror}", file=sys.stderr)
    return 3
