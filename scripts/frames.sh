#!/usr/bin/env bash
# Scripted minutes of scrubbing in the real window (software GL under Xvfb): as it opens, with three methods side by side, and with one
# picture of about 512 × 512 pixels. Frame times into docs/frames.json and docs/app.md. On a quiet machine: the window, its worker and the
# software GL share the cores.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/xvfb.sh
cargo build --release
nbrdf="${CARGO_TARGET_DIR:-target}/release/nbrdf"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export NBRDF_SESSION="$scratch/session.json"
drive() { # NAME SIZE
    xvfb-run -a -s "-screen 0 1280x1200x24" "$nbrdf" app --size "$2" --drive 60 --report "$scratch/$1.json"
}
drive side_by_side 1280x800
# The height at which the stage has room for so many pixels, less one.
printf '{"schema": 1, "session": {"compare": {"mode": "Flicker"}, "methods": ["latent"], "strips": false}}' >"$NBRDF_SESSION"
drive one_picture 1280x1131
python3 scripts/record_frames.py "$scratch/side_by_side.json" "$scratch/one_picture.json"
