#!/usr/bin/env bash
# Instructions of one frame of scrubbing, decode and a 128² sphere under light `studio`: a trend line without noise.
# Callgrind knows no AVX-512, so the AVX2 path is counted. Prints JSON.
set -euo pipefail
cd "$(dirname "$0")/.."
if ! command -v valgrind >/dev/null; then
    [ "$(id -u)" = 0 ] || { echo "missing: valgrind — apt-get install valgrind" >&2; exit 1; }
    apt-get update -q >&2 && apt-get install -qy valgrind >&2
fi
cargo build --release --workspace --example frame >&2
count() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null target/release/examples/frame "$1" 2>&1 >/dev/null |
        sed -n 's/.*Collected : *\([0-9]*\).*/\1/p'
}
# The difference leaves out everything but the frames.
few=$(count 2) many=$(count 12)
[ -n "$few" ] && [ -n "$many" ] || { echo "valgrind counted nothing" >&2; exit 1; }
printf '{"schema": 1, "instructions_per_frame": %d}\n' $(((many - few) / 10))
