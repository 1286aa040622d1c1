import math

import pytest

from nbrdf_jax.kept import Kept, digest, sources


@pytest.fixture
def given(tmp_path):
    path = tmp_path / "given"
    path.write_text("one")
    return path


def kept(tmp_path, given):
    return Kept.of(tmp_path / "kept", [given], ["held_out"])


def test_what_was_made_is_read_again_until_something_that_it_depends_on_changes(tmp_path, given):
    made = []

    def work(item):
        made.append(item)
        return {"value": item * 0.1, "none": None, "infinite": math.inf}

    first = kept(tmp_path, given).each("tenths", work, [1, 2], of="a")
    assert kept(tmp_path, given).each("tenths", work, [1, 2, 3], of="a")[:2] == first and made == [1, 2, 3]
    kept(tmp_path, given).each("tenths", work, [1], of="b")
    kept(tmp_path, given).each("others", work, [1], of="a")
    given.write_text("two")
    kept(tmp_path, given).each("tenths", work, [1], of="a")
    assert made == [1, 2, 3, 1, 1, 1]


def test_a_run_that_was_stopped_goes_on_where_it_was(tmp_path, given):
    made, broken, begun = [], True, []

    def work(item):
        if broken and item == 2:
            raise RuntimeError("stopped")
        made.append(item)
        return item

    with pytest.raises(RuntimeError):
        kept(tmp_path, given).each("numbers", work, [0, 1, 2], lambda: begun.append(1))
    broken = False
    assert kept(tmp_path, given).each("numbers", work, [0, 1, 2], lambda: begun.append(1)) == [0, 1, 2]
    assert kept(tmp_path, given).each("numbers", work, [0, 1, 2], lambda: begun.append(1)) == [0, 1, 2]
    assert made.count(0) == made.count(1) == made.count(2) == 1 and len(begun) == 2


def test_results_depend_on_the_modules_that_made_them_and_not_on_those_that_show_them():
    text = b"".join(sources("held_out"))
    assert b"def ssim" in text and b"def unclamped" in text and b"class Status" not in text and b"svg" not in text


def test_a_digest_tells_where_parts_end():
    assert digest("ab", "c") != digest("a", "bc") and digest("a") == digest(b"a")
