"""The report of `evaluate.py`: one page of Markdown with pictures beside it, and one of HTML that holds everything."""

import html
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

from .plots import svg


@dataclass(frozen=True)
class Section:
    """A heading and, in this order, text, a picture and a table of which the first row is the heading."""

    title: str
    text: str = ""
    picture: Figure | None = None
    rows: Sequence[Sequence[str]] = ()


def write(folder: Path, title: str, sections: Sequence[Section]) -> tuple[Path, Path]:
    """report.md and report.html; the pictures as report-1.svg, ..."""
    folder.mkdir(parents=True, exist_ok=True)
    pictures = [section.picture and svg(section.picture) for section in sections]
    markdown, body = [f"# {title}", ""], [f"<h1>{html.escape(title)}</h1>"]
    for place, (section, picture) in enumerate(zip(sections, pictures), 1):
        markdown += [f"## {section.title}", ""] + [section.text, ""] * bool(section.text)
        body += [f"<h2>{html.escape(section.title)}</h2>"] + [f"<p>{html.escape(section.text)}</p>"] * bool(section.text)
        if picture:
            (folder / f"report-{place}.svg").write_text(picture, encoding="utf-8")
            markdown += [f"![{section.title}](report-{place}.svg)", ""]
            body.append(f"<figure>{picture}</figure>")
        if section.rows:
            markdown += [*_markdown(section.rows), ""]
            body.append(_html(section.rows))
    page = folder / "report.md", folder / "report.html"
    page[0].write_text("\n".join(markdown), encoding="utf-8")
    page[1].write_text(_PAGE.format(title=html.escape(title), body="\n".join(body)), encoding="utf-8")
    return page


def _markdown(rows: Sequence[Sequence[str]]) -> list[str]:
    lines = ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
    return [lines[0], "| " + " | ".join("---" for _ in rows[0]) + " |", *lines[1:]]


def _html(rows: Sequence[Sequence[str]]) -> str:
    # Numbers stand to the right where a column holds nothing else.
    sides = [' class="number"' if all(map(_is_number, column)) else "" for column in zip(*rows[1:])] or [""] * len(rows[0])

    def line(row: Sequence[str], cell: str) -> str:
        return "<tr>" + "".join(f"<{cell}{side}>{html.escape(text)}</{cell}>" for text, side in zip(row, sides)) + "</tr>"

    return '<div class="wide"><table>' + line(rows[0], "th") + "".join(line(row, "td") for row in rows[1:]) + "</table></div>"


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return text in ("", "–")
    return True


_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>
body {{ font: 15px/1.5 system-ui, sans-serif; max-width: 76rem; margin: 2rem auto; padding: 0 1rem; background: #fff; color: #222; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; }}
th, td {{ border-bottom: 1px solid #ddd; padding: .2rem .6rem; text-align: left; vertical-align: top; }}
th {{ font-weight: 600; vertical-align: bottom; }}
.number {{ text-align: right; }} td.number {{ white-space: nowrap; }}
td:first-child {{ min-width: 15rem; }}
.wide {{ overflow-x: auto; }}
h2 {{ margin-top: 2.5rem; font-size: 1.15rem; }}
figure {{ margin: 1rem 0; }} svg {{ max-width: 100%; height: auto; }}
</style>
{body}
</html>
"""
