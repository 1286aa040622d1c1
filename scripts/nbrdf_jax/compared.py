"""Everything that is recomputed of two reports, beside what they claim."""

from dataclasses import dataclass, field
from pathlib import Path

from . import agreement, data, held_out, interpolation, library
from .agreement import Check
from .asked import Asked
from .families import Family
from .family_ends import FamilyEnds
from .fitted_library import Entry, Provenance, write
from .held_out import Recomputed
from .interpolation import METHODS, Walked, standard_pairs
from .learned import Learned
from .report import Comparison, Report


@dataclass(frozen=True)
class Inputs:
    """What is compared: the reports, what is learned or given, and the files that these came from. Files are written to `output`."""

    report: Report
    comparison: Comparison | None
    learned: Learned
    report_file: Path
    shared_file: Path
    network_files: list[Path]
    output: Path


@dataclass(frozen=True)
class Compared:
    """What was found."""

    rows: list[Recomputed]
    checks: list[Check] = field(default_factory=list)
    walks: list[Walked] = field(default_factory=list)
    families: dict[str, dict[Family, float]] = field(default_factory=dict)


def compare(inputs: Inputs, asked: Asked, is_refined_anew: bool) -> Compared:
    """Held-out rows, codes refined anew where that is asked for, walks and families of a comparison."""
    run = asked.kept.each
    rows = held_out.recompute(inputs.report, inputs.learned, inputs.report_file, run)
    checks = [check for found in rows for check in agreement.of_row(found)]
    if is_refined_anew:
        anew = held_out.refined_anew(inputs.report, inputs.learned, inputs.report_file, run)
        checks += [check for found in anew for check in agreement.of_refined_anew(found)]
    if inputs.comparison is None:
        return Compared(rows, checks)
    methods = {method.name: method for method in inputs.comparison.methods if method.name in METHODS}
    walks = _walked(inputs, list(methods), inputs.comparison.pairs, asked)
    checks += [check for found in walks for check in agreement.of_method(found, methods[found.name])]
    families = _families(inputs, list(methods), asked) if any(method.families for method in methods.values()) else {}
    checks += agreement.of_families(families, methods)
    return Compared(rows, checks, walks, families)


def _walked(inputs: Inputs, methods: list[str], count: int, asked: Asked) -> list[Walked]:
    pairs = standard_pairs(list(inputs.learned.networks), count)
    source = inputs.network_files[0] if inputs.network_files else data.archive("merl")
    codes = asked.codes(methods, sorted({name for pair in pairs for name in pair}), source)
    return interpolation.recompute(inputs.learned, methods, codes, count, asked.kept.each)


def _families(inputs: Inputs, methods: list[str], asked: Asked) -> dict[str, dict[Family, float]]:
    """The middles of families between ends that are fitted here; the program reads these ends to encode them."""
    start = library.shared_start(inputs.shared_file)
    ends = FamilyEnds.fitted(start, asked.kept.each)
    folder = inputs.output / "families"
    entries = [Entry(name, "", weights, {}) for name, weights in ends.networks.items()]
    write(folder, start, entries, Provenance("Ends of families", "scripts/evaluate.py", 0, []), list(inputs.learned.networks))
    codes = asked.codes(methods, list(ends.networks), folder / "library.safetensors")
    return ends.errors(inputs.learned, methods, codes, asked.kept.each)
