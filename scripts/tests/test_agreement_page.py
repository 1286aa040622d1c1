"""The page of agreement says what its records say."""

import make_agreement


def test_the_page_is_made_of_the_records_that_lie_beside_it():
    assert (make_agreement.DOCS / "agreement.md").read_text(encoding="utf-8") == make_agreement.page()


def test_programs_of_others_are_told_by_what_golden_files_say():
    programs = " ".join(cell for row in make_agreement.by_others() for cell in row)
    assert "scikit-image" in programs and "Mitsuba 3" in programs and "numpy" not in programs
    assert make_agreement.numbers({"a": [1, 2.5, "x", True], "b": {"c": 3}}) == 3
