"""Recomputes the figures of `nbrdf evaluate` and `nbrdf compare` by the second implementation, and says where they disagree.

    python scripts/evaluate.py            everything: all held-out materials, all 100 pairs, a quarter of an hour; writes target/evaluation/report.html
    python scripts/evaluate.py --quick    a minute: the autoencoder's rows and the first pairs
    python scripts/evaluate.py --record docs/agreement.json    everything, and counts of what agrees, for scripts/make_agreement.py

Reports are made by the program itself unless they are given (--report, --compare). Codes that were refined are taken from
the report and decoded here, and in a full run made here once more by another optimizer; all other codes, bases, values,
pictures and metrics are made here. What docs/results.md prints must be what comes out. What is done is kept beside the
report, so that a run that was stopped goes on, and is used as long as program, inputs and these scripts stay the same.
Exit codes: 0 all agrees, 1 some figures disagree or some claims do not hold, 2 usage, 3 a file is missing or invalid.
"""

import argparse
import json
import shutil
import sys
from pathlib import Path

from nbrdf_jax import allowance, autoencoder, data, library, program
from nbrdf_jax.asked import Asked
from nbrdf_jax.claims import Status
from nbrdf_jax.compared import Inputs, compare
from nbrdf_jax.fitted_library import whole
from nbrdf_jax.interpolation import METHODS
from nbrdf_jax.invalid import InvalidFile, exit_code
from nbrdf_jax.kept import Kept
from nbrdf_jax.learned import Learned
from nbrdf_jax.library import Library
from nbrdf_jax.report import VARIANTS, Comparison, Report, read, read_comparison
from nbrdf_jax.results_claims import of_page
from nbrdf_jax.side_by_side import printed, written
from nbrdf_jax.tally import recorded
from nbrdf_jax.workers import bar

CHECKPOINT = data.REPOSITORY / "autoencoder" / "assets" / "znbrdf.safetensors"
SHARED = data.REPOSITORY / "nbrdf-core" / "assets" / "shared" / "library.safetensors"
OUTPUT = data.REPOSITORY / "target" / "evaluation"
RESULTS = data.REPOSITORY / "docs" / "results.md"
QUICK_PAIRS = 2


def networks_of(given: list[Path], reference: str, databases: set[str], where: Path) -> Library:
    """The reference networks of a report, checked to be what it measured against."""
    if not given and reference != "published":
        raise InvalidFile(where, 'reference "published"', repr(reference), "give the library it used: --networks PATH")
    for database in databases - set(data.ARCHIVES):
        raise InvalidFile(where, f"a database of {', '.join(data.ARCHIVES)}", database)
    merged: Library = {}
    for path in given or [data.archive(database) for database in sorted(databases | {"merl"})]:
        merged |= library.read(path)
    return merged


def reports(arguments: argparse.Namespace, asked: Asked) -> tuple[Report, Comparison | None]:
    """Those given; the program is asked for others. With --report alone nothing else is compared."""
    if arguments.report is None:
        names = [part for name in (["znbrdf"] if arguments.quick else VARIANTS) for part in ("--with", name)]
        arguments.report = asked.report(["evaluate", *names, "--per-material"], arguments.output / "evaluate.json")
        if arguments.compare is None:
            methods = [part for name in METHODS for part in ("--method", name)]
            count = ["--no-families", "--pairs", str(QUICK_PAIRS)] if arguments.quick else []
            arguments.compare = asked.report(["compare", *methods, *count], arguments.output / "compare.json")
    claimed, comparison = read(arguments.report), read_comparison(arguments.compare) if arguments.compare else None
    if comparison and comparison.reference != claimed.reference:
        raise InvalidFile(arguments.compare, f"reference {claimed.reference!r}, as the other report", repr(comparison.reference))
    return claimed, comparison


def kept_of(arguments: argparse.Namespace) -> Kept:
    """What earlier runs left, of the same files and scripts."""
    files = [arguments.checkpoint, arguments.shared, *arguments.networks, *map(data.archive, data.ARCHIVES)]
    kept = Kept.of(arguments.output / "kept", [path for path in files if path.is_file()], ("held_out", "interpolation", "family_ends", "program"), bar)
    if arguments.anew:
        shutil.rmtree(kept.folder, ignore_errors=True)
    return kept


def run(arguments: argparse.Namespace) -> int:
    """Exit code; the summary goes to stdout."""
    kept = kept_of(arguments)
    asked = Asked(arguments.binary, arguments.checkpoint, kept)
    claimed, comparison = reports(arguments, asked)
    model = autoencoder.read(arguments.checkpoint)
    networks = networks_of(arguments.networks, claimed.reference, {row.database for row in claimed.rows}, arguments.report)
    learned = Learned(networks, library.read(arguments.shared), model, bar)
    found = compare(Inputs(claimed, comparison, learned, arguments.report, arguments.shared, arguments.networks, arguments.output), asked, arguments.refine)
    pairs = comparison.pairs if comparison else 0
    page = arguments.results.read_text(encoding="utf-8") if arguments.results else None
    claims = [] if page is None else list(of_page(page, found.rows, found.walks, pairs, found.families))
    print(printed(found, claims, arguments.tolerance))
    print(f"report: {written(arguments.output, found, claims, arguments.tolerance)}")
    if arguments.record:
        whole(arguments.record, (json.dumps(recorded(found, claims, pairs, arguments.tolerance), indent=1, ensure_ascii=False) + "\n").encode())
    is_wrong = any(not check.agrees(arguments.tolerance) for check in found.checks) or any(claim.status is Status.FAILS for claim in claims)
    return 1 if is_wrong else 0


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="the autoencoder's rows and the first pairs alone")
    parser.add_argument("--report", type=Path, metavar="JSON", help="of `nbrdf evaluate --per-material --json` (default: made now)")
    parser.add_argument("--compare", type=Path, metavar="JSON", help="of `nbrdf compare --json` (default: made now, if --report is not given either)")
    parser.add_argument("--checkpoint", type=Path, default=CHECKPOINT, metavar="SAFETENSORS")
    parser.add_argument("--networks", type=Path, nargs="+", default=[], metavar="ZIP|SAFETENSORS", help="reference networks (default: the published ones)")
    parser.add_argument("--shared", type=Path, default=SHARED, metavar="SAFETENSORS", help="library of networks from one shared start")
    parser.add_argument("--binary", type=Path, default=program.BUILT, help="the program (default: %(default)s)")
    parser.add_argument("--results", type=Path, metavar="MD", help="page whose figures are checked too (default: docs/results.md, where the reports are made now)")
    parser.add_argument("--tolerance", type=float, default=allowance.TOLERANCE, help="largest relative difference without a reason (default: %(default)s)")
    parser.add_argument("-o", "--output", type=Path, default=OUTPUT, metavar="FOLDER", help="where the report goes (default: target/evaluation)")
    parser.add_argument("--refine", action="store_true", help="refine the autoencoder's codes here too (default: where everything is recomputed)")
    parser.add_argument("--record", type=Path, metavar="JSON", help="where counts of what agrees go; not with --quick or given reports")
    parser.add_argument("--anew", action="store_true", help="forget what earlier runs left in the output's folder")
    arguments = parser.parse_args(argv)
    if arguments.record and (arguments.quick or arguments.report or arguments.compare):
        parser.error("--record is of everything: without --quick, --report and --compare")
    others = ("networks", "shared", "checkpoint", "results", "tolerance")
    if arguments.record and any(getattr(arguments, name) != parser.get_default(name) for name in others):
        parser.error(f"--record is of what is published: without {', '.join(f'--{name}' for name in others)}")
    arguments.refine |= not arguments.quick and arguments.report is None
    if arguments.results is None and arguments.report is None and RESULTS.is_file():
        arguments.results = RESULTS
    return exit_code(lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())
