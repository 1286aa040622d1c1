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
    def line(row: Sequence[str], cell: str) -> str:
        return "<tr>" + "".join(f"<{cell}>{html.escape(text)}</{cell}>" for text in row) + "</tr>"

    return "<table>" + line(rows[0], "th") + "".join(line(row, "td") for row in rows[1:]) + "</table>"


_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>{title}</title>
<style>
body {{ font: 15px/1.5 system-ui, sans-serif; max-width: 70rem; margin: 2rem auto; padding: 0 1rem; background: #fff; color: #222; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; }}
th, td {{ border-bottom: 1px solid #ddd; padding: .2rem .6rem; text-align: left; }}
figure {{ margin: 1rem 0; }} svg {{ max-width: 100%; height: auto; }}
</style>
{body}
</html>
"""
