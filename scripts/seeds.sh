#!/usr/bin/env bash
# Trains ZNBRDF with five seeds and records what the seeds change in docs/seeds.json; an hour on two cores. Checkpoints
# stay in target/seeds, so that an interrupted run goes on where it was.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
out=target/seeds
mkdir -p "$out"
cargo build --release --workspace
for seed in 0 1 2 3 4; do
    checkpoint=$out/seed-$seed.safetensors
    [ -f "$checkpoint" ] ||
        target/release/nbrdf train --library "$NBRDF_DATA/merl_nbrdf.zip" --seed "$seed" --resume -o "$checkpoint" --quiet
    [ -f "$out/seed-$seed.json" ] || {
        target/release/nbrdf evaluate --with znbrdf --checkpoint "$checkpoint" --json --quiet > "$out/seed.json"
        mv "$out/seed.json" "$out/seed-$seed.json"
    }
done
python3 scripts/record_seeds.py "$out"
