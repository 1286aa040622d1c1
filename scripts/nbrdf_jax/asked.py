"""What the program itself is asked for, and kept: its reports, and codes of materials."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from . import program
from .fitted_library import whole
from .interpolation import CODED, Codes
from .kept import Kept, digest


@dataclass(eq=False)
class Asked:
    """The program, the checkpoint of its codes, and where answers are kept."""

    binary: Path
    checkpoint: Path
    kept: Kept

    def report(self, arguments: Sequence[str], output: Path) -> Path:
        """A report as JSON, written to a file."""
        content = self.kept.each(f"nbrdf {arguments[0]}", lambda own: program.report(self.binary, own), [tuple(arguments)], of=self._digest)
        output.parent.mkdir(parents=True, exist_ok=True)
        whole(output, content[0].encode())
        return output

    def codes(self, walks: Sequence[str], names: Sequence[str], source: Path) -> Codes:
        """The codes between which these latent walks go, of a library's networks."""

        def one(wanted: tuple[str, str]) -> list[float]:
            return program.code(self.binary, wanted[1], source, self.checkpoint, wanted[0] == "refined").tolist()

        wanted = [(CODED[walk], name) for walk in walks if walk in CODED for name in names]
        made = self.kept.each("codes of the ends", one, wanted, of=(self._digest, digest(source.read_bytes()))) if wanted else []
        return {kind: {name: np.array(code) for (own, name), code in zip(wanted, made) if own == kind} for kind in dict.fromkeys(kind for kind, _ in wanted)}

    @cached_property
    def _digest(self) -> str:
        return digest(program.required(self.binary).read_bytes())
