#!/usr/bin/env bash
# How far every form, read again, is from the published networks of the 100 MERL materials, into docs/exports.json: a
# quarter of an hour on two cores, most of it for fits of standard models. Nothing else is written but reports in
# target/exports.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
nbrdf="${CARGO_TARGET_DIR:-target}/release/nbrdf"
cargo build --release --workspace --bins
out=target/exports
mkdir -p "$out"
library=$NBRDF_DATA/merl_nbrdf.zip
mapfile -t names < <("$nbrdf" list --library "$library" --json | python3 -c 'import json, sys; print("\n".join(row["name"] for row in json.load(sys.stdin)["materials"]))')
"$nbrdf" export --list --json > "$out/forms.json"
# Codes are of a model, whose error `nbrdf evaluate` measures: as files they are exact.
for form in $(python3 -c 'import json, sys; print(*(form["name"] for form in json.load(open(sys.argv[1]))["forms"] if form["needs"] != "code"))' "$out/forms.json"); do
    "$nbrdf" export "${names[@]}" --library "$library" --to "$form" --measure --json --quiet > "$out/$form.json"
done
python3 scripts/record_exports.py "$out"
