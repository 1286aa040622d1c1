import pytest

from nbrdf_jax.agreement import OF_MATERIALS, OF_WALKS, Check
from nbrdf_jax.allowance import Allowance
from nbrdf_jax.claims import Claim, Status
from nbrdf_jax.side_by_side import claimed, counts
from nbrdf_jax.tally import reasons_of_checks, reasons_of_claims, tallies, tally

WIDE = Allowance("two ways", relative=0.1)
CHECKS = [
    Check(OF_MATERIALS, "a", "x", 1.00001, 1.0),
    Check(OF_MATERIALS, "a", "y", 1.05, 1.0, allowance=WIDE),
    Check(OF_WALKS, "b", "x", 2.0, 1.0, allowance=WIDE),
    Check(OF_WALKS, "b", "y", 1.0, 1.0, allowance=WIDE),
    Check(OF_WALKS, "b", "z", float("nan"), 1.0),
]


def test_every_figure_is_close_or_further_for_a_reason_or_apart():
    everything = tally("all", CHECKS, 1e-4)
    assert (everything.figures, everything.close, everything.wider, everything.apart) == (5, 2, 1, 2)
    assert everything.largest == pytest.approx(1e-5, rel=1e-3) and everything.where == "a, x"
    assert everything.widest == pytest.approx(0.05) and everything.widest_where == "a, y"
    materials, walks = tallies(CHECKS, lambda check: check.kind, 1e-4)
    assert (materials.name, materials.apart, walks.close, walks.apart) == (OF_MATERIALS, 0, 1, 2)
    assert [row[0] for row in counts([materials, walks], "kind", 1e-4)] == ["kind", OF_MATERIALS, OF_WALKS]


def test_reasons_are_told_once_each_with_what_they_admit():
    assert [(own.reason, own.figures, own.where) for own in reasons_of_checks(CHECKS, 1e-4)] == [("two ways", 1, "a, y")]
    claims = [Claim("p", "1.00", 1.001), Claim("q", "1.00", 1.08, "", WIDE), Claim("r", "1.00", 1.06, "", WIDE), Claim("s", "1", reason="a time"), Claim("t", "1.0", 3.0, "", WIDE)]
    assert [(own.reason, own.figures, own.where) for own in reasons_of_claims(claims, Status.ALLOWED)] == [("two ways", 2, "q")]
    assert [(own.reason, own.figures) for own in reasons_of_claims(claims, Status.UNCHECKED)] == [("a time", 1)]
    assert "1 printed figures hold, 2 hold within a stated allowance, 1 do not hold, 1 were not recomputed" in claimed(claims)
