#!/usr/bin/env bash
# Plans of the shipped scenes: every figure and picture of docs/scenes.md; some minutes on two cores.
# Nothing else should run meanwhile: models are chosen by time.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
out=target/reports/scenes
mkdir -p "$out"
cargo build --release --workspace --bins
nbrdf=target/release/nbrdf

# The published networks are the reference, as in every other figure.
rm -rf "$out/published"
"$nbrdf" import "$NBRDF_DATA/merl_nbrdf.zip" "$NBRDF_DATA/rgl_nbrdf_subset.zip" -o "$out/published" --quiet > /dev/null
for scene in shelf interior metal; do
    for by in time bytes; do
        "$nbrdf" plan "scenes/$scene.toml" --library "$out/published" --by "$by" --check --json --quiet \
            -o "$out/$scene-$by.png" > "$out/$scene-$by.json"
    done
    "$nbrdf" plan "scenes/$scene.toml" --library "$out/published" --sweep tolerance --most-bytes 1000000 --json --quiet \
        -o "$out/$scene-tolerance.svg" > "$out/$scene-tolerance.json"
done
"$nbrdf" plan scenes/shelf.toml --library "$out/published" --sweep distance --object "near middle" \
    --most-bytes 1000000 --json --quiet \
    -o docs/images/distance.svg > "$out/distance.json"
cp "$out/shelf-tolerance.svg" docs/images/tolerance.svg
cp "$out/shelf-time.png" docs/images/shelf.png
python3 scripts/make_scenes.py "$out"
