"""What the tables of docs/results.md are made of."""

import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Figures of a representation: key in reports, heading, digits.
EVALUATE = [
    ("log_error", "log_error", 4), ("relative_log", "relative_log", 3),
    ("point_psnr", "point PSNR", 1), ("point_ssim", "point SSIM", 4), ("point_flip", "point FLIP", 3),
    ("point_delta_e_itp", "point ΔE_ITP", 2),
    ("studio_psnr", "studio PSNR", 1), ("studio_ssim", "studio SSIM", 4), ("studio_flip", "studio FLIP", 3),
    ("studio_delta_e_itp", "studio ΔE_ITP", 2),
]


def number(value: float | None, digits: int) -> str:
    """A figure, or a dash where there is none (infinite or undefined)."""
    return "–" if value is None else f"{value:.{digits}f}"


def fine_percent(share: float) -> str:
    """With more decimals where two would say nothing."""
    return f"{100 * share:.{2 if share >= 1e-4 else 4}f} %"


def table(head: list[str], rows: list[list[str]], numbers: str = "---:") -> str:
    """The first column is text; the others are numbers, unless told otherwise."""
    lines = [head, ["---"] + [numbers] * (len(head) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def thousands(value: int) -> str:
    """A count with spaces between thousands."""
    return f"{value:,}".replace(",", " ")


def wrapped(page: str) -> str:
    """A page without lines of prose beyond 120 letters: paragraphs that have one are set anew; all else stays."""
    out, paragraph, fenced = [], [], False

    def flush() -> None:
        if any(len(line) > 120 for line in paragraph):
            indent = "  " if paragraph[0].startswith("- ") else ""
            text = " ".join(line.strip() for line in paragraph)
            paragraph[:] = textwrap.wrap(text, 120, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
        out.extend(paragraph)
        paragraph.clear()

    for line in page.split("\n"):
        fenced ^= line.startswith("```")
        if fenced or not line or line.startswith(("|", "    ", "#", "!", "```")):
            flush()
            out.append(line)
            continue
        if line.startswith("- "):
            flush()
        paragraph.append(line)
    flush()
    return "\n".join(out)


def label(row: dict) -> str:
    """A representation and how its codes are made."""
    return f"`{row['name']}` {row['variant'].replace('_', '-')}"
