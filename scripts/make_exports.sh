#!/usr/bin/env bash
# Every figure of docs/exports.md: errors of all forms, fits of standard models, Mitsuba, a browser. Some 50 minutes on two cores.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
python=.venv/bin/python
[ -x "$python" ] || { echo "missing: .venv with Mitsuba — scripts/check.sh makes it" >&2; exit 1; }

scripts/export_errors.sh
# Beside the rest: a failed run leaves the record as it was.
cargo run --release -p nbrdf-core --example parametric_fits > target/parametric.json
mv target/parametric.json docs/parametric.json
"$python" scripts/mitsuba_check.py -o docs/mitsuba.json --strip docs/images/mitsuba.png
source scripts/browser.sh
"$python" scripts/browser_check.py docs/browser.json
"$python" scripts/make_exports.py
