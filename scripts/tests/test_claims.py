import numpy as np
import pytest

from nbrdf_jax.allowance import Allowance
from nbrdf_jax.claims import Claim, Status, numbers, of_status, section, tables
from nbrdf_jax.families import Family
from nbrdf_jax.held_out import Recomputed
from nbrdf_jax.report import Material, Row
from nbrdf_jax.results_claims import of_page

PAGE = """# Results

## In short

- ZNBRDF as `encode` does it (encoder and three unrolled steps) against PCA-32's projection: log_error 0.50 ×, studio
  PSNR +2.0 dB, SSIM +0.0010, worst material +1.0 dB.
- The encoder alone against it: log_error 1.28 ×, studio PSNR +0.1 dB.
- Refined ZNBRDF against PCA-32's *refined* codes: log_error 0.98 ×, studio PSNR +1.2 dB.
- Closest to the linear mix in the middle (median PSNR): `linear_mix` 100.0, `charting` 27.7.

## Representations, 20 held-out MERL materials

| representation | log_error | studio PSNR |
| --- | ---: | ---: |
| `znbrdf` unrolled | 0.0020 (0.0030) | 43.0 (41.0) |
| `pca_tables` projection | 0.0040 (0.0050) | 41.0 (40.0) |
| `charting_15` projection | 0.0041 (0.0099) | 42.1 (36.6) |

| representation | log_error median | p90 | worst | studio PSNR median | p90 | worst | encode ms |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
| `znbrdf` unrolled | 0.0020 | 0.0028 | b, a | 43.0 | 41.4 | a, b | 6.69 |

## Families with a known middle, `log_error` of the middle

| method | ggx | beckmann (kept out) |
| --- | ---: | ---: |
| `latent` | **0.0100** 0.0050 0.0150 | **0.0030** 0.0030 0.0030 |

## Speed

| model | ns |
| --- | ---: |
| `reference_loop` | 401 |
"""


def recomputed(name, variant, errors, decibels, ssim):
    row = Row(name, variant, "merl", {}, (Material("a", (), {}), Material("b", (), {})))
    return Recomputed(row, ("a", "b"), {"log_error": np.array(errors), "studio_psnr": np.array(decibels), "studio_ssim": np.array(ssim)}, None)


ROWS = [recomputed("znbrdf", "unrolled", [0.001, 0.003], [41.0, 45.0], [0.996, 0.998]), recomputed("pca_tables", "projection", [0.003, 0.005], [40.0, 42.0], [0.995, 0.997])]


def test_everything_that_was_recomputed_is_compared_and_the_rest_is_counted():
    claims = list(of_page(PAGE, ROWS, [], 2, {}))
    assert not of_status(claims, Status.FAILS) and not of_status(claims, Status.ALLOWED)
    assert len(of_status(claims, Status.HOLDS)) == 4 + 8 + 8
    assert {claim.reason for claim in of_status(claims, Status.UNCHECKED)} >= {"not in the report that was read", "a time or a size, not a figure of quality"}


def test_a_figure_that_has_changed_does_not_hold():
    for before, after in (("0.0020 (0.0030)", "0.0020 (0.0031)"), ("43.0 (41.0)", "43.1 (41.0)"), ("+2.0 dB", "+2.1 dB"), ("| b, a |", "| a, b |"), ("0.50 ×", "0.49 ×")):
        assert of_status(of_page(PAGE.replace(before, after), ROWS, [], 2, {}), Status.FAILS), before


@pytest.mark.parametrize(("before", "after"), [("`pca_tables` projection |", "`pca` projection |"), ("| studio PSNR |", "| brilliance |"), ("The encoder alone", "Alone the encoder"), ("| b, a |", "| b, c |")])
def test_a_page_that_no_longer_prints_what_is_looked_for_does_not_hold(before, after):
    assert any(claim.finding.startswith("the page") for claim in of_status(of_page(PAGE.replace(before, after), ROWS, [], 2, {}), Status.FAILS))


def test_the_last_digit_counts_however_it_is_printed():
    assert Claim("", "1.20e-05", 1.202e-5).status is Status.HOLDS and Claim("", "1.20e-05", 1.3e-5).status is Status.FAILS
    assert Claim("", "1 816", 1816.4).status is Status.HOLDS and Claim("", "1 816", 1818.0).status is Status.FAILS


def test_middles_of_families_hold_within_what_two_fits_differ_by_and_are_counted_apart():
    def counts(error):
        families = {"latent": {Family("colour", lobe): error * (1 if lobe == "ggx" else 0.3) for lobe in ("ggx", "beckmann")}}
        claims = list(of_page(PAGE, ROWS, [], 2, families))
        return [len(of_status(claims, status)) - (20 if status is Status.HOLDS else 0) for status in (Status.HOLDS, Status.ALLOWED, Status.FAILS)]

    assert counts(0.01) == [2, 0, 0] and counts(0.0105) == [0, 2, 0] and counts(0.02) == [0, 0, 2]


def test_a_claim_holds_where_the_figure_rounds_to_it():
    def holds(printed, found=None):
        return Claim("", printed, found).status is Status.HOLDS

    assert holds("46.8", 46.849) and not holds("46.8", 46.87)
    assert holds("0.9970", 0.99696) and not holds("0.9970", 0.9962)
    assert not holds("1.0", float("nan")) and not holds("1.0")
    assert holds("+3.1", 3.13) and holds("-3.1", -3.13)


@pytest.mark.parametrize("allowance", [Allowance("", relative=0.1), Allowance("", absolute=0.1), Allowance("", between=(0.95, 1.05))])
def test_every_allowance_admits_what_is_near_and_nothing_else(allowance):
    statuses = [Claim("", "1.00", found, "", allowance).status for found in (1.001, 1.04, 1.5, float("nan"))]
    assert statuses == [Status.HOLDS, Status.ALLOWED, Status.FAILS, Status.FAILS]
    assert not any(allowance.admits(*pair) for pair in ((1.0, 1.5), (1.5, 1.0), (1.0, float("nan")), (float("nan"), 1.0)))


def test_pages_are_taken_apart():
    found = list(tables(PAGE))
    assert [table.heading for table in found] == ["Representations, 20 held-out MERL materials"] * 2 + ["Families with a known middle, `log_error` of the middle", "Speed"]
    assert numbers("**0.0025** 0.0021") == ["0.0025", "0.0021"] and numbers("1 816") == ["1 816"]
    assert section(PAGE, "In short").startswith("- ZNBRDF as") and section(PAGE, "Nothing") == ""
