"""The page of exports says what its records say."""

import make_exports


def test_the_page_is_made_of_the_records_that_lie_beside_it():
    assert (make_exports.DOCS / "exports.md").read_text() == make_exports.page()


def test_bytes_and_shares_are_for_people():
    assert (make_exports.size(4024), make_exports.size(34992012), make_exports.percent(0.0082)) == ("4.0 kB", "35.0 MB", "0.82 %")
