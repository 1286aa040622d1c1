"""The page of agreement says what its records say."""

import make_agreement
import pytest

OLD = {"model": "bsdf", "light": "point", "material": "a", "relative_difference": 0.01, "noise": [0.002, 0.001], "mean": [0.1, 0.2], "verdict": "agrees"}
NEW = {"model": "bsdf", "against": "network", "light": "point", "material": "b", "difference": 0.03, "noise": 0.0, "verdict": "apart"}


def test_the_page_is_made_of_the_records_that_lie_beside_it():
    assert (make_agreement.DOCS / "agreement.md").read_text(encoding="utf-8") == make_agreement.page()


def test_pictures_are_counted_by_verdict_whatever_verdicts_there_are():
    heading, table = make_agreement.pictures([OLD, NEW, NEW | {"light": "map", "elsewhere": 0.5, "verdict": "too noisy to tell"}])
    assert heading == "1 of 3 comparisons agree, 1 apart, 1 too noisy to tell"
    assert [line.split(" | ")[3:] for line in table.splitlines()[2:]] == [["2", "1", "1", "0", "3.0e-02", "b", "2.0e-02 |"], ["1", "0", "0", "1", "5.0e-01", "b", "0 |"]]


def test_noise_is_relative_to_the_mean_of_its_channel():
    assert make_agreement.noise(OLD) == pytest.approx(0.02) and make_agreement.noise(NEW) == 0


def test_programs_of_others_are_told_by_what_golden_files_say():
    programs = " ".join(cell for row in make_agreement.by_others() for cell in row)
    assert "scikit-image" in programs and "Mitsuba 3" in programs and "numpy" not in programs
    assert make_agreement.numbers({"a": [1, 2.5, "x", True], "b": {"c": 3}}) == 3
