"""Puts the frame times of docs/frames.json into docs/app.md, between its two marks."""

import json
import os
from pathlib import Path

BEGIN, END = "<!-- frames -->", "<!-- end of frames -->"
docs = Path(__file__).resolve().parent.parent / "docs"
found = json.loads((docs / "frames.json").read_text())
work, interval = found["work_ms"], found["interval_ms"]
text = f"""A scripted minute of scrubbing on {os.cpu_count()} cores, drawn by software without a GPU (`scripts/frames.sh`; [frames.json](frames.json)):

| | median | 99 % | largest |
|---|---|---|---|
| between two frames of the window | {interval["median"]:.1f} ms | {interval["p99"]:.1f} ms | {interval["max"]:.1f} ms |
| work of the window for a frame, drawing included | {work["median"]:.1f} ms | {work["p99"]:.1f} ms | {work["max"]:.1f} ms |

Each of the {found["spheres"]} methods shown gets {found["pictures_per_sphere_and_second"]:.0f} new pictures a second, figures included; the first frame is
there {found["first_frame_s"]:.2f} s after the start. Ten thousand frames of scrubbing keep no more memory (`tests/allocation.rs`)."""
page = docs / "app.md"
before, rest = page.read_text().split(BEGIN)
_, after = rest.split(END)
page.write_text(f"{before}{BEGIN}\n{text}\n{END}{after}")
