#!/usr/bin/env bash
# Opens the real window under Xvfb, drags the slider with the pointer, undoes that by keyboard, closes, and looks at what is left:
# the session's file, memory, and how soon the first frame was there. Software GL; no GPU is needed.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/xvfb.sh
nbrdf="${CARGO_TARGET_DIR:-target}/release/nbrdf"
[ -x "$nbrdf" ] || cargo build --release
if [ -z "${INSIDE_XVFB:-}" ]; then INSIDE_XVFB=1 exec xvfb-run -a -s "-screen 0 1280x800x24" "$0"; fi

most_memory_mb=400
most_first_frame_s=1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export NBRDF_SESSION="$scratch/session.json" NBRDF_CACHE="$scratch/cache"
value() { python3 -c 'import json, sys; d = json.load(open(sys.argv[1])); print(eval(sys.argv[2], {"d": d}))' "$@"; }
fail() { echo "smoke: $*" >&2; exit 1; }

# Once by itself, to learn where the slider is.
"$nbrdf" app --new --size 1280x800 --drive 1 --report "$scratch/first.json"
read -r left right y < <(value "$scratch/first.json" '"{0:.0f} {2:.0f} {3:.0f}".format(*d["scrubber"][:3], (d["scrubber"][1] * 2 + d["scrubber"][3]) / 3)')

"$nbrdf" app --size 1280x800 --report "$scratch/report.json" &
app=$!
window=$(timeout 30 xdotool search --sync --onlyvisible --name '^nbrdf$' | head -1)
[ -n "$window" ] || fail "no window appeared"
sleep 3
x() { echo $((left + (right - left) * $1 / 100)); }
xdotool mousemove --window "$window" "$(x 50)" "$y" mousedown 1
for percent in 55 60 65 70 75; do xdotool mousemove --window "$window" "$(x $percent)" "$y"; sleep 0.1; done
xdotool mouseup 1
sleep 2.5
t=$(value "$NBRDF_SESSION" 'd["session"]["blend"]["t"]')
python3 -c "import sys; sys.exit(not 0.65 < $t < 0.85)" || fail "the slider was dragged to about 0.75, and t is $t"
memory_mb=$(awk '/VmHWM/ { print int($2 / 1024) }' "/proc/$app/status")
xdotool windowfocus "$window" key ctrl+z
sleep 2.5
xdotool key ctrl+q
for _ in $(seq 50); do kill -0 "$app" 2>/dev/null || break; sleep 0.2; done
kill -0 "$app" 2>/dev/null && { kill "$app"; fail "Ctrl+Q did not close the window"; }
wait "$app" || fail "the app ended with exit code $?"
t=$(value "$NBRDF_SESSION" 'd["session"]["blend"]["t"]')
[ "$t" = 0.5 ] || fail "Ctrl+Z should have put t back to 0.5, and it is $t"
first=$(value "$scratch/report.json" 'round(d["first_frame_s"], 3)')
[ "$memory_mb" -le $most_memory_mb ] || fail "at most $most_memory_mb MB were expected, found $memory_mb"
python3 -c "import sys; sys.exit(not $first <= $most_first_frame_s)" || fail "the first frame took $first s"
code=0
timeout 120 "$nbrdf" app --new --size 720x540 --screenshot /dev/full 2>"$scratch/full.log" || code=$?
[ "$code" = 1 ] && grep -q '^error: ' "$scratch/full.log" || fail "a picture that cannot be written should end with 1, and it is $code"
# Where OpenGL opens no window, the app starts itself again on wgpu. Xvfb within Xvfb: this one knows no OpenGL.
if [ -n "${NBRDF_REQUIRE_VULKAN:-}" ]; then
    __EGL_VENDOR_LIBRARY_FILENAMES=/none xvfb-run -a -s "-screen 0 800x600x24 -extension GLX" \
        timeout 120 "$nbrdf" app --new --size 720x540 --screenshot "$scratch/second.png" 2>"$scratch/second.log" ||
        { cat "$scratch/second.log" >&2; fail "without OpenGL no window opened"; }
    [ -s "$scratch/second.png" ] || fail "without OpenGL nothing was drawn"
    echo "without OpenGL it opens on wgpu"
fi
echo "the window opens ($first s to the first frame), scrubs, undoes and closes; $memory_mb MB at most"
