#!/usr/bin/env bash
# Everything that must hold, from a fresh clone: style, lints, tests in Rust and Python, and the two against each other.
set -euo pipefail
cd "$(dirname "$0")/.."

say() { printf '\n== %s\n' "$*"; }
need() { command -v "$1" >/dev/null || { echo "missing: $1 — $2" >&2; exit 1; }; }

need cargo "install Rust 1.95 or newer (rustup)"
need cc "install a C compiler (Debian: apt-get install build-essential)"
# Asked to run, not only looked up: a version manager's stand-in may be on the path for a version that is not there.
python=""
for candidate in python3 python3.14 python3.13 python3.12 python3.11; do
    if "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then python=$candidate; break; fi
done
[ -n "$python" ] || { echo "missing: python3 — install Python 3.11 or newer" >&2; exit 1; }

# With the published data beside the repository, tests that read it must run; without it they say that they were skipped.
export NBRDF_DATA="${NBRDF_DATA:-$PWD/../shared/data}"
if [ -d "$NBRDF_DATA" ]; then export NBRDF_REQUIRE_DATA="${NBRDF_REQUIRE_DATA:-1}"; fi

say "Python environment (.venv)"
if ! [ -x .venv/bin/python ]; then
    if ! "$python" -m venv .venv 2>/dev/null; then
        rm -rf .venv
        [ "$(id -u)" = 0 ] || { echo "missing: python3-venv — apt-get install python3-venv" >&2; exit 1; }
        apt-get update -q && apt-get install -qy python3-venv
        "$python" -m venv .venv
    fi
fi
# Mitsuba has no wheels for every machine; all else must be there.
if ! .venv/bin/python -m pip install -q -e 'scripts[mitsuba,keras]'; then .venv/bin/python -m pip install -q -e 'scripts[keras]'; fi

say "style"
cargo fmt --all --check

say "Vulkan in software"
source scripts/vulkan.sh

say "tests (Rust)"
# In release: the networks trained and spheres rendered would take minutes more otherwise, and `cargo run --release`
# shares the build.
cargo test --release --workspace

say "the window"
if [ "$(uname)" = Linux ]; then scripts/smoke.sh; else echo "SKIPPED: a window without a display is opened under Xvfb, on Linux"; fi

say "pages in a browser"
source scripts/browser.sh
mkdir -p target
if [ -n "$NBRDF_BROWSER" ]; then
    .venv/bin/python scripts/browser_check.py target/browser.json
else
    echo "SKIPPED: no Chromium, and it could not be installed (Debian: apt-get install chromium)"
fi

say "lints"
cargo clippy --release --workspace --all-targets -- -D warnings

say "documentation"
RUSTDOCFLAGS="-D warnings" cargo doc --release --no-deps --workspace

say "the tour"
scripts/tour.sh target/tour

say "tests (Python)"
.venv/bin/python -m pytest -q scripts

say "Rust against JAX"
if [ -d "$NBRDF_DATA" ]; then
    # A minute of it: the autoencoder's held-out rows, two pairs of every walk, and what docs/results.md says of them.
    .venv/bin/python scripts/evaluate.py --quick
else
    echo "SKIPPED: no published data in $NBRDF_DATA"
fi

say "against Mitsuba"
if .venv/bin/python -c 'import mitsuba' 2>/dev/null; then
    .venv/bin/python scripts/mitsuba_check.py --quick
else
    echo "SKIPPED: Mitsuba 3 cannot be installed here (pip install mitsuba); exports to it are not checked"
fi

say "fuzzing"
# On demand: every dependency is compiled anew for it. The same readers have met changed files in the tests above.
if [ -n "${NBRDF_FUZZ:-}" ]; then scripts/fuzz.sh "$NBRDF_FUZZ"; else echo "SKIPPED: NBRDF_FUZZ=20000 would fuzz every reader so often"; fi

say "all good"
