#!/usr/bin/env bash
# Every figure of docs/exports.md: errors of all forms, fits of standard models, Mitsuba, a browser. Some 40 minutes on two cores.
# Where Mitsuba or the browser disagree, the page says so and this ends with their exit code.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
python=.venv/bin/python
[ -x "$python" ] || { echo "missing: .venv with Mitsuba — scripts/check.sh makes it" >&2; exit 1; }

scripts/export_errors.sh
# Beside the rest: a failed run leaves the record as it was.
cargo run --release -p nbrdf-core --example parametric_fits > target/parametric.json
mv target/parametric.json docs/parametric.json
found=0
"$python" scripts/mitsuba_check.py --all -o docs/mitsuba.json --strip docs/images/mitsuba.png || found=$?
source scripts/browser.sh
"$python" scripts/browser_check.py docs/browser.json || found=$?
"$python" scripts/make_exports.py
"$python" scripts/make_agreement.py
exit "$found"
