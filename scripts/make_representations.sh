#!/usr/bin/env bash
# Every report behind docs/representations.md, its charts, and the page itself; half an hour on two cores.
# Nothing else should run meanwhile: some figures are times.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
out=target/reports
mkdir -p "$out/measured"
cargo build --release --workspace --examples --bins
nbrdf=target/release/nbrdf

"$nbrdf" evaluate --json > "$out/representations.json"
lengths=()
for dim in 4 8 16; do
    checkpoint=target/sizes-8000/size-$dim.safetensors
    [ -f "$checkpoint" ] || { echo "missing: $checkpoint — scripts/sizes.sh makes it" >&2; exit 1; }
    lengths+=(--checkpoint "$checkpoint")
done
"$nbrdf" chart --runs 5 "${lengths[@]}" -o docs/images/chart.svg --json > "$out/chart.json"
"$nbrdf" reconstruct --draws 20 -o docs/images/reconstruct.svg > "$out/reconstruct.txt"
"$nbrdf" linear -o docs/images/linear.svg --ranks docs/images/ranks.svg > "$out/linear.txt"
"$nbrdf" manifold -o docs/images/manifold.svg > "$out/manifold.txt"
target/release/examples/published_fits > "$out/published_fits.txt"
NBRDF_REQUIRE_DATA=1 cargo test --release --workspace --test factored -- --nocapture | grep SGD > "$out/factored.txt"

for name in cc_ibiza_sunset cg_sunflower colodur_napoli_4f paper_white; do
    table="$NBRDF_DATA/rgl_measured/${name}_rgb.bsdf"
    "$nbrdf" fit "$table" -o "$out/measured/$name.npz" --json --quiet > "$out/measured/$name.json"
    "$nbrdf" info "rgl/$name" --library "$NBRDF_DATA/rgl_nbrdf_subset.zip" --against "$table" --json --quiet \
        > "$out/measured/$name-published.json"
done
for name in cayman garnet_red krylon_blue; do
    "$nbrdf" fit "$NBRDF_DATA/cornell_measured/$name.brdf" -o "$out/measured/$name.npz" --leave-out 10 --json --quiet \
        > "$out/measured/$name.json"
done
python3 scripts/make_representations.py "$out"
