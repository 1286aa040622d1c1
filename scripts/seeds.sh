#!/usr/bin/env bash
# Trains ZNBRDF with five seeds, for the steps given or as long as the built-in one, and records what the seeds change in
# docs/seeds.json; an hour and a quarter on two cores. Checkpoints and reports stay in target/seeds-STEPS, so that an
# interrupted run goes on where it was: remove that folder when anything that is trained has changed.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
steps="${1:-48000}"
out="target/seeds-$steps"
mkdir -p "$out"
cargo build --release --workspace
for seed in 0 1 2 3 4; do
    checkpoint=$out/seed-$seed.safetensors
    [ -f "$checkpoint" ] ||
        target/release/nbrdf train --library "$NBRDF_DATA/merl_nbrdf.zip" --seed "$seed" --steps "$steps" --resume -o "$checkpoint" --quiet
    [ -f "$out/seed-$seed.json" ] || {
        target/release/nbrdf evaluate --with znbrdf --checkpoint "$checkpoint" --json --quiet > "$out/seed.json"
        mv "$out/seed.json" "$out/seed-$seed.json"
    }
done
python3 scripts/record_seeds.py "$out" "$steps"
