"""What a run of `fit_batch.py` has done so far: a file for every chunk, and what makes the run the same as another."""

import json
import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from safetensors import safe_open
from safetensors.numpy import load_file, save

from .fitted_library import Entry, whole
from .invalid import InvalidFile
from .sources import Source


class FitParts:
    """Parts in a folder of their own within that of the library; they go when it is written."""

    def __init__(self, output: Path, job: dict[str, object]) -> None:
        """`job` is all that changes a result: parts of one are not taken for those of another."""
        self.folder = output / ".fit_batch"
        self.folder.mkdir(parents=True, exist_ok=True)
        known = self.folder / "job.json"
        if known.is_file() and _of_job(known) != job:
            raise InvalidFile(self.folder, "parts of this run", "those of another", f"finish that one, or remove {self.folder}")
        whole(known, json.dumps(job).encode())

    def path(self, place: int) -> Path:
        """File of a chunk."""
        return self.folder / f"chunk-{place:05}.safetensors"

    def written(self, place: int, entries: Sequence[Entry]) -> None:
        """Keeps the networks of a chunk, their errors beside them."""
        errors = json.dumps({entry.name: entry.error for entry in entries})
        whole(self.path(place), save({entry.name: entry.weights.astype(np.float32) for entry in entries}, metadata={"errors": errors}))

    def read(self, place: int, chunk: Sequence[Source]) -> list[Entry]:
        """What `written` kept."""
        path = self.path(place)
        with safe_open(path, framework="numpy") as file:
            errors = json.loads(file.metadata()["errors"])
        tensors = load_file(path)
        return [Entry(source.name, source.file, tensors[source.name].astype(np.float64), errors[source.name]) for source in chunk]

    def remove(self) -> None:
        """All of it."""
        shutil.rmtree(self.folder)


def _of_job(known: Path) -> object:
    """What is no JSON is another job."""
    try:
        return json.loads(known.read_text())
    except ValueError:
        return None
