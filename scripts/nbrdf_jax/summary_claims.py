"""Finds the figures that the summary of docs/results.md prints, and those that they must round to."""

import re
from collections.abc import Iterator

from .claims import Claim, absent
from .held_out import Recomputed
from .interpolation import LEFT_OUT, Walked

ABSENT = "not in the report that was read"
TOO_FEW = "not all 100 pairs were walked"
Rows = dict[tuple[str, str, str], Recomputed]


def of_summary(text: str, known: Rows, methods: dict[str, Walked]) -> Iterator[Claim]:
    """All claims of the text below "In short": ZNBRDF against PCA-32, and the middles of walks."""
    projection, refined = known.get(("merl", "pca_tables", "projection")), known.get(("merl", "pca_tables", "refined"))
    against = (
        ("unrolled", projection, r"against PCA-32's projection: ([^`]*?)\. -"),
        ("feed_forward", projection, r"The encoder alone against it: ([^`]*?)\. -"),
        ("refined", refined, r"against PCA-32's \*refined\* codes: ([^`]*?)\. -"),
    )
    for variant, base, pattern in against:
        ours, printed = known.get(("merl", "znbrdf", variant)), re.search(pattern, text)
        comparisons = list(_comparisons(printed[1])) if printed else []
        if not comparisons:
            yield absent(f"In short: ZNBRDF {variant} against PCA-32")
        for title, key, part, number in comparisons:
            label = f"In short: ZNBRDF {variant} against PCA-32, {title}"
            if ours is None or base is None:
                yield Claim(label, number, reason=ABSENT)
                continue
            a, b = (getattr(found.spread(key), part) for found in (ours, base))
            yield Claim(label, number, a / b if key == "log_error" else a - b)
    printed = re.findall(r"`(\w+)` ([\d.]+)", text.partition("median PSNR): ")[2].partition(". -")[0])
    yield from (absent(f"In short: median mix_psnr of {method}") for method in methods if method not in dict(printed))
    for method, number in printed:
        found = methods.get(method)
        reason = LEFT_OUT.get(method, TOO_FEW)
        yield Claim(f"In short: median mix_psnr of {method}", number.rstrip("."), found.spread("mix_psnr").median if found else None, "" if found else reason)
    worse = text.partition("Worse than doing nothing")[2].partition("by that figure:")[2]
    for method, found in methods.items():
        nothing = methods.get("nearest_end")
        is_worse = float(found.spread("mix_psnr").median < nothing.spread("mix_psnr").median) if nothing else None
        yield Claim(f"In short: {method} is worse than doing nothing (0 no, 1 yes)", str(int(f"`{method}`" in worse)), is_worse, "" if nothing else ABSENT)


def _comparisons(text: str) -> Iterator[tuple[str, str, str, str]]:
    """Title, key, part of the spread, printed number."""
    for title, key, part, pattern in (
        ("log_error", "log_error", "mean", r"log_error ([\d.]+) ×"),
        ("studio PSNR", "studio_psnr", "mean", r"studio PSNR ([-+][\d.]+) dB"),
        ("studio SSIM", "studio_ssim", "mean", r"SSIM ([-+][\d.]+\d)"),
        ("worst material", "studio_psnr", "max", r"worst material ([-+][\d.]+) dB"),
    ):
        found = re.search(pattern, text)
        if found:
            yield title, key, part, found[1]
