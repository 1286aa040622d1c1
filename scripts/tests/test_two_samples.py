import pytest

from nbrdf_jax.two_samples import TwoSamples, overall_difference, overall_ratio, overall_spread


def test_the_standard_error_is_welchs():
    pair = TwoSamples([1.0, 3.0], [2.0, 4.0, 6.0])
    # Variances 2 and 4: √(2/2 + 4/3).
    assert pair.difference == -2 and pair.standard_error == pytest.approx((7 / 3) ** 0.5)


@pytest.mark.parametrize(("first", "is_higher_better", "verdict"), [(1.0, False, "second"), (1.0, True, "first"), (-1.0, False, "first"), (-1.0, True, "second"), (0.1, False, "same"), (-0.1, True, "same")])
def test_better_is_what_more_than_two_standard_errors_say(first, is_higher_better, verdict):
    # Standard error 0.141.
    assert TwoSamples([first - 0.1, first + 0.1], [-0.1, 0.1], is_higher_better).verdict == verdict


def test_over_all_materials_ratios_are_multiplied_and_differences_added():
    pairs = [TwoSamples([2.0, 2.0], [1.0, 1.0]), TwoSamples([1.0, 1.0], [2.0, 2.0])]
    found = overall_ratio(pairs)
    assert found["mean"] == pytest.approx(1) and found["low"] == pytest.approx(1 / found["high"]) and found["high"] > 2
    # Standard error 1; of two materials Student's t is 12.7.
    assert overall_difference(pairs) == pytest.approx({"mean": 0, "low": -12.706, "high": 12.706}, rel=1e-4)


def test_the_spread_of_the_first_is_told_in_those_of_the_second():
    pairs = [TwoSamples([0.0, 2.0], [0.0, 1.0]), TwoSamples([5.0, 9.0], [7.0, 9.0])]
    assert overall_spread(pairs) == pytest.approx({"mean": 2, "low": 2, "high": 2})
