#!/usr/bin/env bash
# How long training should be, judged on the validation part of the training materials, which neither autoencoder nor PCA
# bases see (the shared start has seen their mean); recorded in docs/ablation.json. 25 minutes on two cores. Checkpoints stay in target/ablation, so that an
# interrupted run goes on where it was: remove that folder when anything that is trained has changed.
set -euo pipefail
cd "$(dirname "$0")/.."
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
out=target/ablation
mkdir -p "$out"
cargo build --release --workspace
for steps in 8000 24000 48000; do
    checkpoint=$out/steps-$steps.safetensors
    [ -f "$checkpoint" ] ||
        target/release/nbrdf train --library "$NBRDF_DATA/merl_nbrdf.zip" --seed 0 --steps "$steps" --validate --resume -o "$checkpoint" --quiet
    target/release/nbrdf evaluate --with znbrdf --with pca_tables --validate --checkpoint "$checkpoint" --json --quiet > "$out/steps-$steps.json"
done
python3 scripts/record_ablation.py "$out"
