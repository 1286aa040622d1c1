"""Asks the program itself for reports and codes, where none are given."""

import json
import os
import subprocess
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from .data import REPOSITORY, folder
from .invalid import InvalidFile

BUILT = Path(os.environ.get("CARGO_TARGET_DIR", REPOSITORY / "target")) / "release" / "nbrdf"


def required(binary: Path) -> Path:
    """The program itself, or what to do where it is not there."""
    if not binary.is_file():
        raise InvalidFile(binary, "the program nbrdf", "no such file", "cargo build --release, or give --binary PATH")
    return binary


def report(binary: Path, arguments: Sequence[str]) -> str:
    """What `nbrdf … --json --quiet` prints."""
    return _run(binary, [*arguments, "--json", "--quiet"]).decode()


def code(binary: Path, name: str, library: Path, checkpoint: Path, is_refined: bool) -> np.ndarray:
    """The code [k] that `nbrdf encode` makes of a material."""
    arguments = ["encode", name, "--library", str(library), "--checkpoint", str(checkpoint), "--json", "--quiet"]
    printed = _run(binary, arguments + ["--refine"] * is_refined)
    try:
        return np.array(json.loads(printed)["code"], float)
    except (ValueError, KeyError, TypeError) as error:
        raise InvalidFile(f"{binary} encode {name}", "a code as JSON", repr(printed[:60])) from error


def _run(binary: Path, arguments: list[str]) -> bytes:
    # Both look for the published networks in the same place.
    environment = os.environ | {"NBRDF_DATA": str(folder())}
    done = subprocess.run([str(required(binary)), *arguments], capture_output=True, env=environment)
    if done.returncode:
        raise InvalidFile(f"{binary} {' '.join(arguments)}", "exit code 0", f"{done.returncode}: {done.stderr.decode(errors='replace').strip()}")
    return done.stdout
