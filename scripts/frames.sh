#!/usr/bin/env bash
# A scripted minute of scrubbing in the real window (software GL under Xvfb, 1280 × 800 and five spheres): frame times into docs/frames.json and
# docs/app.md. On a quiet machine: the window, its worker and the software GL share the cores.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/xvfb.sh
cargo build --release
nbrdf="${CARGO_TARGET_DIR:-target}/release/nbrdf"
xvfb-run -a -s "-screen 0 1280x800x24" "$nbrdf" app --new --size 1280x800 --drive 60 --report docs/frames.json
python3 scripts/record_frames.py
