#!/usr/bin/env bash
# Trains ZNBRDF with codes of 2 to 64 numbers, for the steps given, and records how close they come in docs/sizes.json; and
# what 32 numbers lose, on the validation materials, where a part of them should serve alone. 40 minutes on two cores for
# 8000 steps. Checkpoints and reports stay in target/sizes-STEPS, so that an interrupted run goes on where it was: remove
# that folder when anything that is trained or measured has changed.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
steps="${1:-8000}"
out="target/sizes-$steps"
mkdir -p "$out"
cargo build --release --workspace
for dim in 2 4 8 16 32 64; do
    checkpoint=$out/size-$dim.safetensors
    [ -f "$checkpoint" ] || target/release/nbrdf train --library "$NBRDF_DATA/merl_nbrdf.zip" --dim "$dim" --steps "$steps" \
        --resume -o "$checkpoint" --quiet
    [ -f "$out/size-$dim.json" ] || {
        target/release/nbrdf evaluate --with znbrdf --checkpoint "$checkpoint" --json --quiet > "$out/size.json"
        mv "$out/size.json" "$out/size-$dim.json"
    }
done
for order in plain ordered; do
    checkpoint=$out/$order.safetensors
    switch=$([ "$order" = ordered ] && echo --ordered || true)
    # shellcheck disable=SC2086
    [ -f "$checkpoint" ] || target/release/nbrdf train --library "$NBRDF_DATA/merl_nbrdf.zip" --validate $switch \
        --steps "$steps" --resume -o "$checkpoint" --quiet
    [ -f "$out/$order.json" ] || {
        target/release/nbrdf evaluate --with znbrdf --validate --checkpoint "$checkpoint" --json --quiet > "$out/size.json"
        mv "$out/size.json" "$out/$order.json"
    }
done
python3 scripts/record_sizes.py "$out" "$steps"
