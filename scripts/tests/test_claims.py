import numpy as np

from nbrdf_jax.claims import Claim, numbers, section, tables
from nbrdf_jax.families import Family
from nbrdf_jax.held_out import Recomputed
from nbrdf_jax.report import Material, Row
from nbrdf_jax.results_claims import of_page

PAGE = """# Results

## In short

- ZNBRDF as `encode` does it (encoder and three unrolled steps) against PCA-32's projection: log_error 0.50 ×, studio
  PSNR +2.0 dB, SSIM +0.0010, worst material +1.0 dB.
- Closest to the linear mix in the middle (median PSNR): `linear_mix` 100.0, `charting` 27.7.

## Representations, 20 held-out MERL materials

| representation | log_error | studio PSNR |
| --- | ---: | ---: |
| `znbrdf` unrolled | 0.0020 (0.0030) | 43.0 (41.0) |
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
    checked = [claim for claim in claims if claim.found is not None]
    assert all(claim.holds for claim in checked), [claim for claim in checked if not claim.holds]
    assert len(checked) == 4 + 4 + 8
    assert {claim.reason for claim in claims if claim.found is None} >= {"not in the report that was read", "a time or a size, not a figure of quality"}


def test_a_figure_that_has_changed_does_not_hold():
    for before, after in (("0.0020 (0.0030)", "0.0020 (0.0031)"), ("43.0 (41.0)", "43.1 (41.0)"), ("+2.0 dB", "+2.1 dB"), ("| b, a |", "| a, b |"), ("0.50 ×", "0.49 ×")):
        broken = [claim for claim in of_page(PAGE.replace(before, after), ROWS, [], 2, {}) if claim.found is not None and not claim.holds]
        assert broken, before


def test_middles_of_families_hold_as_far_as_two_fits_agree():
    def broken(error):
        families = {"latent": {Family("colour", lobe): error * (1 if lobe == "ggx" else 0.3) for lobe in ("ggx", "beckmann")}}
        return [claim for claim in of_page(PAGE, ROWS, [], 2, families) if claim.found is not None and not claim.holds]

    assert not broken(0.0101) and len(broken(0.02)) == 2


def test_a_claim_holds_where_the_figure_rounds_to_it():
    assert Claim("", "46.8", 46.849).holds and not Claim("", "46.8", 46.87).holds
    assert Claim("", "0.9970", 0.99696).holds and not Claim("", "0.9970", 0.9962).holds
    assert not Claim("", "1.0", float("nan")).holds and not Claim("", "1.0").holds
    assert Claim("", "+3.1", 3.13).holds and Claim("", "-3.1", -3.13).holds


def test_pages_are_taken_apart():
    found = list(tables(PAGE))
    assert [table.heading for table in found] == ["Representations, 20 held-out MERL materials"] * 2 + ["Families with a known middle, `log_error` of the middle", "Speed"]
    assert numbers("**0.0025** 0.0021") == ["0.0025", "0.0021"] and numbers("1 816") == ["1 816"]
    assert section(PAGE, "In short").startswith("- ZNBRDF as") and section(PAGE, "Nothing") == ""
