"""Recomputes the autoencoder's figures of an `nbrdf evaluate` report, and says where they disagree.

    nbrdf evaluate --per-material --json > evaluate.json
    python scripts/evaluate.py --report evaluate.json --checkpoint znbrdf.safetensors

feed_forward: the held-out reference networks are encoded and decoded here. unrolled, refined: the steps that made the
report's codes are not repeated; the codes are decoded here.
Exit codes: 0 all means agree, 1 some disagree, 2 usage, 3 a file is missing or invalid.
"""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np

from nbrdf_jax import autoencoder, data, library, report, split
from nbrdf_jax.autoencoder import Autoencoder
from nbrdf_jax.invalid import InvalidFile
from nbrdf_jax.judge import judge
from nbrdf_jax.library import Library


@dataclass(frozen=True)
class Check:
    """One mean of one row: recomputed, claimed, and the material whose own figures differ most."""

    label: str
    key: str
    ours: float
    claimed: float
    worst: str

    @property
    def difference(self) -> float:
        """Relative to the claim. NaN where either is not a number, which no tolerance admits."""
        return abs(self.ours - self.claimed) / max(abs(self.claimed), 1e-12)


def check_row(row: report.Row, model: Autoencoder, networks: Library, where: Path) -> list[Check]:
    """Every figure of one row."""
    names = [_qualified(material.name, row.database) for material in row.materials]
    expected = split.held_out(networks, row.database)
    if sorted(names) != expected:
        odd = sorted(set(names) ^ set(expected))
        raise InvalidFile(where, f"the {len(expected)} held-out {row.database} materials", f"{len(names)}; differing: {', '.join(odd)}")
    reference = jnp.asarray(np.stack([networks[name] for name in names]))
    codes = _codes(row, model, where)
    if row.variant == "feed_forward":
        ours = jax.vmap(model.encode)(reference)
        print(f"{row.database} feed_forward: largest difference of a code number {float(jnp.max(jnp.abs(ours - codes))):.1e}", file=sys.stderr)
        codes = ours
    figures = judge(reference, jax.vmap(model.decode)(codes), model.widths)
    checks = []
    for key in report.KEYS:
        ours, claimed = getattr(figures, key), np.array([material.figures[key] for material in row.materials])
        apart = np.abs(ours - claimed) / np.maximum(np.abs(claimed), 1e-12)
        worst = f"{names[int(np.argmax(apart))]} {np.max(apart):.1e}"
        label = f"{row.database} {row.variant}"
        checks.append(Check(label, key, float(np.mean(ours)), row.means[key], worst))
        # The claim is also checked against its own materials: a mean over something else would show here.
        checks.append(Check(f"{label} (its own materials)", key, float(np.mean(claimed)), row.means[key], "-"))
    return checks


def _codes(row: report.Row, model: Autoencoder, where: Path) -> jax.Array:
    for material in row.materials:
        if len(material.code) != model.code_size:
            raise InvalidFile(where, f"{model.code_size} numbers in the code of {material.name}", str(len(material.code)))
    return jnp.asarray([material.code for material in row.materials], dtype=jnp.float64)


def _qualified(name: str, database: str) -> str:
    return name if database == "merl" or "/" in name else f"{database}/{name}"


def _networks(given: list[Path], reference: str, databases: set[str], where: Path) -> Library:
    if not given and reference != "published":
        raise InvalidFile(where, 'reference "published"', repr(reference), "give the library it used: --networks PATH")
    for database in databases - set(data.ARCHIVES):
        raise InvalidFile(where, f"a database of {', '.join(data.ARCHIVES)}", database)
    merged: Library = {}
    for path in given or [data.archive(database) for database in sorted(databases)]:
        merged |= library.read(path)
    return merged


def table(checks: list[Check], tolerance: float) -> str:
    """The checks as aligned text."""
    lines = [("row", "key", "ours", "report", "relative", "", "material that differs most")]
    for check in checks:
        verdict = "ok" if check.difference <= tolerance else "DISAGREES"
        lines.append((check.label, check.key, f"{check.ours:.6g}", f"{check.claimed:.6g}", f"{check.difference:.1e}", verdict, check.worst))
    widths = [max(len(line[column]) for line in lines) for column in range(len(lines[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines)


def run(arguments: argparse.Namespace) -> int:
    """Exit code; the table goes to stdout."""
    claims = report.read(arguments.report)
    model = autoencoder.read(arguments.checkpoint)
    networks = _networks(arguments.networks, claims.reference, {row.database for row in claims.rows}, arguments.report)
    checks = [check for row in claims.rows for check in check_row(row, model, networks, arguments.report)]
    print(table(checks, arguments.tolerance))
    return 0 if all(check.difference <= arguments.tolerance for check in checks) else 1


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--report", type=Path, required=True, metavar="JSON")
    parser.add_argument("--checkpoint", type=Path, required=True, metavar="SAFETENSORS")
    parser.add_argument("--networks", type=Path, nargs="+", default=[], metavar="ZIP|SAFETENSORS", help="reference networks (default: the published ones)")
    parser.add_argument("--tolerance", type=float, default=1e-3, help="largest relative difference of a mean (default: %(default)s)")
    try:
        return run(parser.parse_args(argv))
    except InvalidFile as error:
        print(f"error: {error}", file=sys.stderr)
        return 3


if __name__ == "__main__":
    sys.exit(main())
