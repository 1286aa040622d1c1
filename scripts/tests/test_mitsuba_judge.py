"""What the comparison with Mitsuba calls alike: nothing that is two percent off, and nothing that noise could hide."""

import numpy as np
import pytest

import mitsuba_judge as judge

SIZE, PASSES = 32, 16


@pytest.fixture
def picture() -> np.ndarray:
    """A slope, with a channel that has hardly any light."""
    across = np.linspace(0.2, 1.0, SIZE)
    return np.tile(across[:, np.newaxis], (SIZE, 1, 1)) * [1.0, 0.4, 0.002]


def noisy(picture: np.ndarray, share: float, seed: int) -> np.ndarray:
    """Passes of which the mean picture's mean has this share of noise, the same in all channels as that of lights that are drawn."""
    random = np.random.default_rng(seed)
    each = share * np.sqrt(PASSES) * SIZE
    return picture * (1 + each * random.normal(size=(PASSES, SIZE, SIZE, 1)))


def verdict(passes: np.ndarray, wanted: np.ndarray, tolerance: float = 0.001) -> str:
    return judge.noisy(passes, wanted, tolerance)["verdict"]


def test_a_picture_within_noise_agrees(picture):
    for seed in range(20):
        assert verdict(noisy(picture, 0.001, seed), noisy(picture, 0.0005, seed + 100)) == judge.AGREES


def test_a_picture_that_is_two_percent_off_is_apart_with_noise_and_without(picture):
    for sign in (-1, 1):
        off = picture * (1 + 0.02 * sign)
        assert verdict(noisy(off, 0.001, 1), noisy(picture, 0.0005, 2)) == judge.APART
        assert judge.exact(off, picture, 0.01)["verdict"] == judge.APART
        one = picture * [1, 1 + 0.02 * sign, 1]
        assert verdict(noisy(one, 0.001, 1), noisy(picture, 0.0005, 2)) == judge.APART
        assert judge.exact(one, picture, 0.01)["verdict"] == judge.APART


def test_a_noisy_picture_neither_agrees_nor_is_apart(picture):
    for off in (1.0, 1.02, 2.0):
        assert verdict(noisy(picture * off, 0.01, 3), noisy(picture, 0.0005, 4)) == judge.NOISY
        assert verdict(noisy(picture * off, 0.0005, 3), noisy(picture, 0.01, 4)) == judge.NOISY


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_single_value_that_is_not_finite_is_apart_on_either_side_with_noise_and_without(picture, value):
    passes, others = noisy(picture, 0.001, 11), noisy(picture, 0.0005, 12)
    broken = picture.copy()
    broken[3, 4, 1] = passes[2, 3, 4, 1] = value
    found = [judge.exact(broken, picture, 0.01), judge.exact(picture, broken, 0.01), judge.noisy(passes, others, 0.01), judge.noisy(others, passes, 0.01)]
    for row in found:
        assert row["verdict"] == judge.APART and row["not_finite"] == 1
        assert np.isfinite([figure for figure in row.values() if not isinstance(figure, str)]).all()


def test_a_picture_of_nothing_but_values_that_are_no_numbers_is_apart(picture):
    for nothing in (np.nan, np.inf):
        assert judge.exact(np.full_like(picture, nothing), picture, 1.0)["verdict"] == judge.APART
        assert verdict(np.full((PASSES, SIZE, SIZE, 3), nothing), noisy(picture, 0.0005, 13), 1.0) == judge.APART


@pytest.mark.parametrize("factor", [0, 0.5, 2])
def test_one_block_that_is_halved_or_doubled_is_apart(picture, factor):
    off = picture.copy()
    off[12:16, 20:24] *= factor
    found = judge.noisy(noisy(off, 0.0005, 14), noisy(picture, 0.0005, 15), 0.001)
    assert found["verdict"] == judge.APART and found["blocks_apart"] >= 1


def test_as_many_blocks_may_be_apart_as_student_explains(picture):
    assert (judge.by_chance(judge.LEAST_PASSES), judge.by_chance(4)) == (2, 8)
    blocks = [(4 * index, 4 * index) for index in range(8)]
    # Beyond four standard errors, of 0.5 % of a block each, but not beyond ten.
    for count, wanted in ((2, judge.AGREES), (6, judge.APART)):
        off = picture.copy()
        for row, column in blocks[:count]:
            off[row : row + 4, column : column + 4] *= 1.045
        off *= picture.mean(axis=(0, 1)) / off.mean(axis=(0, 1))
        found = judge.noisy(noisy(off, 0.0005, 16), noisy(picture, 0.0002, 17), 0.001)
        assert (found["verdict"], found["blocks_allowed"]) == (wanted, 2), found


def test_light_that_is_moved_is_apart_though_the_means_are_the_same(picture):
    moved = picture.copy()
    moved[:8, :8] *= 1.3
    moved[-8:, :8] *= 0.7
    found = judge.exact(moved, picture, 0.01)
    assert found["verdict"] == judge.APART and found["difference"] < 1e-9
    assert verdict(noisy(moved, 0.0005, 5), noisy(picture, 0.0005, 6)) == judge.APART


def test_what_is_allowed_is_never_more_than_the_tolerance_and_one_percent(picture):
    found = judge.noisy(noisy(picture, 0.0015, 7), noisy(picture, 0.0005, 8), 0.01)
    assert found["verdict"] == judge.AGREES and found["allowed"] == pytest.approx(0.01 + 4 * found["noise"], rel=1e-3)
    assert found["allowed"] <= 0.01 + judge.SIGMAS * judge.MOST_NOISE <= 0.02


def test_a_channel_without_light_is_judged_by_a_hundredth_of_the_brightest(picture):
    dark = picture * [1, 1, 0]
    found = judge.exact(dark + [0, 0, 0.01 * dark[..., 0].mean() * 0.5], dark, 0.4)
    assert found["elsewhere"] == pytest.approx(0.5) and found["verdict"] == judge.APART


def test_pictures_of_other_sizes_are_compared_block_by_block(picture):
    fine = picture.repeat(4, axis=0).repeat(4, axis=1)
    assert verdict(noisy(picture, 0.001, 9), np.stack([fine, fine])) == judge.AGREES
    assert verdict(noisy(picture, 0.001, 9), np.stack([fine, fine])[:, ::-1, ::-1]) == judge.APART


def test_noise_of_fewer_than_two_passes_is_not_known(picture):
    assert judge.relative_noise([picture]) == float("inf")
    assert judge.relative_noise(list(noisy(picture, 0.003, 10))) == pytest.approx(0.003, rel=0.6)


def test_noise_of_passes_that_are_not_finite_is_at_no_target(picture):
    passes = list(noisy(picture, 0.003, 10))
    passes[1] = passes[1] * np.nan
    assert not judge.relative_noise(passes) <= 1e9


def test_a_single_reference_is_one_without_noise(picture):
    assert verdict(noisy(picture, 0.001, 18), picture[np.newaxis]) == judge.AGREES
    assert verdict(noisy(picture * 1.02, 0.001, 18), picture[np.newaxis]) == judge.APART
