#!/usr/bin/env bash
# Runs every command of docs/tour.md and makes its pictures, docs/images/tour-*.png, or in the folder that is given. What is
# opened in Mitsuba is run where a Python with its package is found: in .venv, or named by PYTHON.
set -euo pipefail
cd "$(dirname "$0")/.."
programs="${CARGO_TARGET_DIR:-$PWD/target}/release"
[ -x "$programs/nbrdf" ] || cargo build --release
mkdir -p "${1:-docs/images}"
pictures=$(cd "${1:-docs/images}" && pwd)
tour=$PWD/docs/tour.md
python="${PYTHON:-$PWD/.venv/bin/python}"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"

# The commands of the blocks of one kind; lines of a command after its first begin with "> ".
commands() {
    awk -v fence="\`\`\`$1" '/^```/ { inside = ($0 == fence); next } inside && /^[$>] / { print substr($0, 3) }' "$tour"
}
run() { PATH="$programs:$(dirname "$python"):$PATH" bash -euxo pipefail -c "$(commands "$1")"; }

run console
if "$python" -c 'import mitsuba' 2>/dev/null; then run bash; else echo "SKIPPED: no Mitsuba in $python"; fi
for shown in $(grep -o 'images/tour-[a-z]*\.png' "$tour"); do
    made=${shown#images/tour-}
    if [ -f "$made" ]; then cp "$made" "$pictures/tour-$made"; fi
done
