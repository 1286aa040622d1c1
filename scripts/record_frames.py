"""Puts two reports of frame times into docs/frames.json, and into docs/app.md between its two marks."""

import json
import os
import sys
from pathlib import Path

BEGIN, END = "<!-- frames -->", "<!-- end of frames -->"
docs = Path(__file__).resolve().parent.parent / "docs"
side_by_side, one = (json.loads(Path(path).read_text()) for path in sys.argv[1:3])
(docs / "frames.json").write_text(json.dumps({"schema": 1, "side_by_side": side_by_side, "one_picture": one}, indent=2) + "\n")


def row(title: str, key: str) -> str:
    cells = [f"{found[key][name]:.1f} ms" for found in (side_by_side, one) for name in ("median", "p99", "max")]
    return f"| {title} | {' | '.join(cells)} |"


text = f"""Scripted minutes of scrubbing on {os.cpu_count()} cores, drawn by software without a GPU (`scripts/frames.sh`; [frames.json](frames.json)): the window as it
opens, {side_by_side["spheres"]} methods side by side at 1280 × 800, and one picture of {one["largest_side_px"]} × {one["largest_side_px"]} pixels.

| | side by side: median | 99 % | largest | one picture: median | 99 % | largest |
|---|---|---|---|---|---|---|
{row("between two frames of the window", "interval_ms")}
{row("work of the window for a frame, drawing included", "work_ms")}

Each of the {side_by_side["spheres"]} methods gets {side_by_side["pictures_per_sphere_and_second"]:.0f} new pictures a second, figures included; the one picture
{one["pictures_per_sphere_and_second"]:.0f}. The first frame is there {side_by_side["first_frame_s"]:.2f} s after the start. Ten thousand frames of scrubbing keep no more
memory (`tests/allocation.rs`)."""
page = docs / "app.md"
before, rest = page.read_text().split(BEGIN)
_, after = rest.split(END)
page.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}")
