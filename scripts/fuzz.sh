#!/usr/bin/env bash
# Every reader against bytes that nobody wrote: scripts/fuzz.sh [RUNS per target] [--record docs/fuzz.json]
# Begins with the committed seeds (fuzz/seeds) and keeps what it finds in target/fuzz/found for the next time.
set -euo pipefail
cd "$(dirname "$0")/.."

runs=${1:-20000}
record=""
[ "${2:-}" = --record ] && record=${3:?--record takes the file to write}
case $runs in '' | *[!0-9]*) echo "expected a number of runs per target, found '$runs'" >&2; exit 2 ;; esac

# Fewer where one run is long: a scene is written to a file, a MERL table has 35 MB.
share() { case $1 in merl) echo 2000 ;; scene) echo 10 ;; *) echo 1 ;; esac; }

# No sanitizer: there is no `unsafe` to look into. What is looked for are panics, overflows, hangs, and memory beyond the
# limits that the targets state. Instrumentation needs switches of the compiler that stable versions hide.
export RUSTC_BOOTSTRAP=1
version=0.13.2
tools=$PWD/target/tools
if ! "$tools/bin/cargo-fuzz" --version 2>/dev/null | grep -qF " $version"; then
    cargo install --quiet --locked --root "$tools" --version $version cargo-fuzz ||
        { echo "missing: cargo-fuzz $version — needs crates.io once" >&2; exit 1; }
fi
command -v c++ >/dev/null || { echo "missing: c++ — install a C++ compiler (Debian: apt-get install g++)" >&2; exit 1; }
PATH=$tools/bin:$PATH cargo fuzz build --fuzz-dir fuzz --sanitizer none --target-dir target/fuzz

binaries=target/fuzz/$(rustc -vV | sed -n 's/^host: //p')/release
logs=target/fuzz/logs
mkdir -p $logs
total=0
lines=""
start=$SECONDS
for source in fuzz/targets/*.rs; do
    name=$(basename "$source" .rs)
    found=target/fuzz/found/$name
    count=$((runs / $(share "$name") + 10))
    mkdir -p "$found"
    # Ten seconds would be a hang: most runs take less than a millisecond.
    if ! RAYON_NUM_THREADS=1 "$binaries/$name" -runs=$count -seed=1 -timeout=10 -rss_limit_mb=2048 \
        -artifact_prefix="$logs/$name-" -print_final_stats=1 "$found" "fuzz/seeds/$name" >"$logs/$name.log" 2>&1; then
        tail -n 40 "$logs/$name.log" >&2
        echo "fuzz: $name failed; the input is $(grep -oE "$logs/$name-[a-z]+-[0-9a-f]+" "$logs/$name.log" | tail -1)" >&2
        exit 1
    fi
    executed=$(sed -n 's/^stat::number_of_executed_units: *//p' "$logs/$name.log")
    printf '%-20s %10d executions\n' "$name" "$executed"
    lines+=$(printf '    "%s": %d,' "$name" "$executed")$'\n'
    total=$((total + executed))
done
printf '%-20s %10d executions, no crash, no hang, memory within limits\n' "all" $total
if [ -n "$record" ]; then
    printf '{\n  "command": "scripts/fuzz.sh %d --record %s",\n  "executions": {\n%s\n  },\n  "total": %d,\n  "seconds": %d\n}\n' \
        "$runs" "$record" "$(printf '%s' "$lines" | sed '$ s/,$//')" $total $((SECONDS - start)) >"$record"
fi
