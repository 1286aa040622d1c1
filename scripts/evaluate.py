"""Recomputes the figures of `nbrdf evaluate` and `nbrdf compare` by the second implementation, and says where they disagree.

    python scripts/evaluate.py            everything: all held-out materials, all 100 pairs, a quarter of an hour; writes target/evaluation/report.html
    python scripts/evaluate.py --quick    a minute: the autoencoder's rows and the first pairs

Reports are made by the program itself unless they are given (--report, --compare). Codes that were refined are taken from
the report and decoded here, and in a full run made here once more by another optimizer; all other codes, bases, values,
pictures and metrics are made here. What docs/results.md prints must be what comes out.
Exit codes: 0 all agrees, 1 some figures disagree or some claims do not hold, 2 usage, 3 a file is missing or invalid.
"""

import argparse
import sys
from collections import Counter
from functools import partial
from pathlib import Path

from tqdm import tqdm

from nbrdf_jax import agreement, autoencoder, data, family_ends, fitted_library, held_out, interpolation, library, program, report, results_claims
from nbrdf_jax.families import Family
from nbrdf_jax.family_ends import FamilyEnds
from nbrdf_jax.fitted_library import Entry, Provenance
from nbrdf_jax.interpolation import Codes, Walked, standard_pairs
from nbrdf_jax.invalid import InvalidFile, exit_code
from nbrdf_jax.learned import Learned
from nbrdf_jax.library import Library
from nbrdf_jax.side_by_side import aligned, summary, table, written
from nbrdf_jax.workers import each

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


def codes_for(walks: list[str], names: list[str], source: Path, arguments: argparse.Namespace) -> Codes:
    """The codes between which latent walks go, as the program makes them of a library's networks."""

    def one(wanted: tuple[str, str]):
        return program.code(arguments.binary, wanted[1], source, arguments.checkpoint, wanted[0] == "refined")

    variants = [interpolation.CODED[walk] for walk in walks if walk in interpolation.CODED]
    wanted = [(variant, name) for variant in variants for name in names]
    made = list(bar(each(one, wanted), "codes of the ends", len(wanted)))
    return {variant: {name: code for (kind, name), code in zip(wanted, made) if kind == variant} for variant in variants}


def bar(items, label: str, total: int | None = None):
    """A progress bar on stderr, gone when done."""
    return tqdm(items, desc=label, total=total, leave=False, file=sys.stderr, disable=None)


def walked(claims: report.Comparison, learned: Learned, arguments: argparse.Namespace) -> list[Walked]:
    """Every method of a comparison that can be walked here."""
    methods = [method.name for method in claims.methods if method.name in interpolation.METHODS]
    pairs = standard_pairs(list(learned.networks), claims.pairs)
    source = arguments.networks[0] if arguments.networks else data.archive("merl")
    codes = codes_for(methods, sorted({name for pair in pairs for name in pair}), source, arguments)
    return interpolation.recompute(learned, methods, codes, claims.pairs, partial(bar, label="walks", total=claims.pairs))


def families_walked(learned: Learned, methods: list[str], arguments: argparse.Namespace) -> dict[str, dict[Family, float]]:
    """The middles of families between ends that are fitted here."""
    start = library.shared_start(arguments.shared)
    with tqdm(total=family_ends.STEPS + family_ends.SHARED_STEPS, desc="ends of families", leave=False, file=sys.stderr, disable=None) as steps:
        ends = FamilyEnds.fitted(start, steps.update)
    folder = arguments.output / "families"
    entries = [Entry(name, "", weights, {}) for name, weights in ends.networks.items()]
    fitted_library.write(folder, start, entries, Provenance("Ends of families", "scripts/evaluate.py", 0, []), list(learned.networks))
    return ends.errors(learned, methods, codes_for(methods, list(ends.networks), folder, arguments))


def reports_made(arguments: argparse.Namespace) -> None:
    """Asks the program for the reports that were not given; with --report alone nothing else is compared."""
    if arguments.report is None:
        representations = ["znbrdf"] if arguments.quick else list(report.VARIANTS)
        names = [part for name in representations for part in ("--with", name)]
        with tqdm(total=1, desc="nbrdf evaluate", leave=False, file=sys.stderr, disable=None):
            arguments.report = program.report(arguments.binary, ["evaluate", *names, "--per-material"], arguments.output / "evaluate.json")
        if arguments.compare is None:
            methods = [part for name in interpolation.METHODS for part in ("--method", name)]
            count = ["--no-families", "--pairs", str(QUICK_PAIRS)] if arguments.quick else []
            with tqdm(total=1, desc="nbrdf compare", leave=False, file=sys.stderr, disable=None):
                arguments.compare = program.report(arguments.binary, ["compare", *methods, *count], arguments.output / "compare.json")


def run(arguments: argparse.Namespace) -> int:
    """Exit code; the table goes to stdout."""
    reports_made(arguments)
    claimed = report.read(arguments.report)
    comparison = report.read_comparison(arguments.compare) if arguments.compare else None
    model = autoencoder.read(arguments.checkpoint)
    networks = networks_of(arguments.networks, claimed.reference, {row.database for row in claimed.rows}, arguments.report)
    if comparison and comparison.reference != claimed.reference:
        raise InvalidFile(arguments.compare, f"reference {claimed.reference!r}, as the other report", repr(comparison.reference))
    learned = Learned(networks, library.read(arguments.shared), model, partial(bar, label="tables of the training materials"))
    count = len({material.name for row in claimed.rows for material in row.materials})
    rows = held_out.recompute(claimed, learned, arguments.report, partial(bar, label="held-out materials", total=count))
    walks = walked(comparison, learned, arguments) if comparison else []
    checks = [check for found in rows for check in agreement.of_row(found)]
    if arguments.refine:
        number = sum(len(row.materials) for row in claimed.rows if (row.name, row.variant) == ("znbrdf", "refined"))
        anew = held_out.refined_anew(claimed, learned, arguments.report, partial(bar, label="refining", total=number))
        checks += [check for found in anew for check in agreement.of_refined_anew(found)]
    methods = {method.name: method for method in comparison.methods} if comparison else {}
    checks += [check for found in walks for check in agreement.of_method(found, methods[found.name])]
    families = families_walked(learned, [found.name for found in walks], arguments) if any(methods[found.name].families for found in walks) else {}
    checks += agreement.of_families(families, methods)
    claims = list(results_claims.of_page(arguments.results.read_text(encoding="utf-8"), rows, walks, comparison.pairs if comparison else 0, families)) if arguments.results else []
    print(aligned(summary(checks, arguments.tolerance)))
    wrong_checks = [check for check in checks if not check.agrees(arguments.tolerance)]
    if wrong_checks:
        print(aligned(table(wrong_checks, arguments.tolerance)))
    for found in rows:
        if found.code_difference is not None:
            print(f"{found.row.label}: largest difference of a code number, of the largest {found.code_difference:.1e}", file=sys.stderr)
    wrong = [claim for claim in claims if claim.found is not None and not claim.holds]
    for claim in wrong:
        print(f"DOES NOT HOLD  {claim.where}: printed {claim.printed}, found {claim.found:.6g}")
    if claims:
        unchecked = Counter(claim.reason for claim in claims if claim.found is None)
        print(f"{arguments.results.name}: {sum(claim.holds for claim in claims)} printed figures hold, {len(wrong)} do not, {unchecked.total()} not recomputed")
        for reason, number in unchecked.most_common():
            print(f"  {number:5} {reason}")
    print(f"{len(checks) - len(wrong_checks)} of {len(checks)} figures agree; report: {written(arguments.output, rows, walks, checks, claims, arguments.tolerance)}")
    return 1 if wrong_checks or wrong else 0


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
    parser.add_argument("--tolerance", type=float, default=agreement.TOLERANCE, help="largest relative difference without a reason (default: %(default)s)")
    parser.add_argument("-o", "--output", type=Path, default=OUTPUT, metavar="FOLDER", help="where the report goes (default: target/evaluation)")
    parser.add_argument("--refine", action="store_true", help="refine the autoencoder's codes here too (default: where everything is recomputed)")
    arguments = parser.parse_args(argv)
    arguments.refine |= not arguments.quick and arguments.report is None
    if arguments.results is None and arguments.report is None and RESULTS.is_file():
        arguments.results = RESULTS
    return exit_code(lambda: run(arguments))


if __name__ == "__main__":
    sys.exit(main())
