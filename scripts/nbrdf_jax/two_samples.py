"""Whether two programs differ by more than their seeds do: means, spread, and the difference against its standard error."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import mean, stdev, variance

from scipy.stats import t

SIGMAS = 2.0  # standard errors that a difference must exceed: chance alone does so once in twenty times, with few seeds once in ten
CONFIDENCE = 0.95  # of intervals over materials


@dataclass(frozen=True)
class TwoSamples:
    """Figures of a first and a second program, at least two each; lower is better unless told otherwise."""

    first: Sequence[float]
    second: Sequence[float]
    is_higher_better: bool = False

    @property
    def difference(self) -> float:
        """Mean of the first less that of the second."""
        return mean(self.first) - mean(self.second)

    @property
    def standard_error(self) -> float:
        """Of the difference; variances are each program's own (Welch 1947)."""
        return math.sqrt(variance(self.first) / len(self.first) + variance(self.second) / len(self.second))

    @property
    def verdict(self) -> str:
        """`same`, `first` or `second`: which is better by more than `SIGMAS` standard errors."""
        if abs(self.difference) <= SIGMAS * self.standard_error:
            return "same"
        return "first" if (self.difference > 0) == self.is_higher_better else "second"

    def row(self) -> dict[str, object]:
        """For a record."""
        parts = {label: {"mean": mean(values), "sd": stdev(values)} for label, values in (("first", self.first), ("second", self.second))}
        return {**parts, "difference": self.difference, "standard_error": self.standard_error, "verdict": self.verdict}


def overall_ratio(samples: Sequence[TwoSamples]) -> dict[str, float]:
    """Geometric mean over materials of first / second, and its interval of `CONFIDENCE` over materials, of two or more."""
    logs = [math.log(mean(pair.first) / mean(pair.second)) for pair in samples]
    return {key: math.exp(value) for key, value in _interval(logs).items()}


def overall_difference(samples: Sequence[TwoSamples]) -> dict[str, float]:
    """The same of first − second."""
    return _interval([pair.difference for pair in samples])


def overall_spread(samples: Sequence[TwoSamples]) -> dict[str, float]:
    """The same of the standard deviations' ratio; both must be above 0."""
    logs = [math.log(stdev(pair.first) / stdev(pair.second)) for pair in samples]
    return {key: math.exp(value) for key, value in _interval(logs).items()}


def _interval(values: Sequence[float]) -> dict[str, float]:
    # Student's t: few materials say less than many.
    quantile = float(t.ppf((1 + CONFIDENCE) / 2, len(values) - 1))
    middle, half = mean(values), quantile * stdev(values) / math.sqrt(len(values))
    return {"mean": middle, "low": middle - half, "high": middle + half}
