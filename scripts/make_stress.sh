#!/usr/bin/env bash
# Where methods fail, for docs/results.md: the report, the heat map and the worst examples; half an hour on two cores.
# Goes on where it was interrupted.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
out=target/reports
mkdir -p "$out" docs/images/stress
cargo build --release --workspace
resume=()
[ -e "$out/stress.partial.json" ] && resume=(--resume)
target/release/nbrdf stress -o "$out/stress.html" --pictures docs/images/stress --json "${resume[@]}" "$@" > "$out/stress.new.json"
mv "$out/stress.new.json" "$out/stress.json"
cp "$out/stress.svg" docs/images/stress.svg
echo "now: python3 scripts/make_results.py $out"
