"""Asks the program itself for reports and codes, where none are given."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np

from .data import REPOSITORY, folder
from .invalid import InvalidFile

BUILT = Path(os.environ.get("CARGO_TARGET_DIR", REPOSITORY / "target")) / "release" / "nbrdf"


def report(binary: Path, arguments: list[str], output: Path) -> Path:
    """Runs `nbrdf … --json --quiet` and keeps what it prints."""
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_bytes(_run(binary, [*arguments, "--json", "--quiet"]))
    return output


def code(binary: Path, name: str, library: Path, checkpoint: Path, is_refined: bool) -> np.ndarray:
    """The code [k] that `nbrdf encode` makes of a material."""
    arguments = ["encode", name, "--library", str(library), "--checkpoint", str(checkpoint), "--json", "--quiet"]
    printed = _run(binary, arguments + ["--refine"] * is_refined)
    try:
        return np.array(json.loads(printed)["code"], float)
    except (ValueError, KeyError, TypeError) as error:
        raise InvalidFile(f"{binary} encode {name}", "a code as JSON", repr(printed[:60])) from error


def _run(binary: Path, arguments: list[str]) -> bytes:
    if not binary.is_file():
        raise InvalidFile(binary, "the program nbrdf", "no such file", "cargo build --release, or give --binary PATH")
    # Both look for the published networks in the same place.
    environment = os.environ | {"NBRDF_DATA": str(folder())}
    done = subprocess.run([str(binary), *arguments], capture_output=True, env=environment)
    if done.returncode:
        raise InvalidFile(f"{binary} {' '.join(arguments)}", "exit code 0", f"{done.returncode}: {done.stderr.decode(errors='replace').strip()}")
    return done.stdout
