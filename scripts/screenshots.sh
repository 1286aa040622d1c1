#!/usr/bin/env bash
# Photographs the app in both themes and two sizes, films a walk, and draws a path of spheres, into docs/images; software GL under Xvfb.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/xvfb.sh
cargo build --release
nbrdf="${CARGO_TARGET_DIR:-target}/release/nbrdf"
mkdir -p docs/images
"$nbrdf" blend gold-paint blue-acrylic --steps 7 --method latent --method raw_weights --method pca_tables \
    -o docs/images/path.png
window() { xvfb-run -a -s "-screen 0 1920x1200x24" "$nbrdf" app "$@"; }
shoot() { # NAME SIZE THEME [MORE...]
    window --size "$2" --theme "$3" --screenshot "docs/images/$1.png" "${@:4}"
}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export NBRDF_SESSION="$scratch/session.json"
session() { printf '{"schema": 1, "session": %s}' "$1" >"$NBRDF_SESSION"; }
for theme in dark light; do
    shoot "app-$theme" 1600x900 "$theme"
    shoot "app-small-$theme" 900x600 "$theme"
done
shoot app-softboxes 1600x900 dark --a chrome --b brass --light softboxes
shoot app-figures 1600x900 light --a chrome --b yellow-paint --pane figures
shoot app-map 1600x900 dark --pane map
session '{"scene": {"source": {"Example": "shelf"}}}'
shoot app-scene 1600x900 light --pane scene
session '{"blend": {"ends": ["gold-paint", "blue-acrylic", "green-plastic"], "way": "Polygon", "place": [0.1, 0.2]},
    "look": {"scenery": {"lighting": {"Point": [0.5, 0.6, 0.62]}, "shape": {"Mesh": 0}}, "exposure": 0.5},
    "methods": ["latent", "raw_weights"]}'
shoot app-polygon 1600x900 dark
rm "$NBRDF_SESSION"

# A scrub from A to B and back, as an animation of a few hundred kilobytes.
mkdir "$scratch/film"
window --size 1100x640 --theme dark --film "$scratch/film" --frames 48
[ -x .venv/bin/python ] || python3 -m venv .venv
.venv/bin/python -m pip install -q pillow
.venv/bin/python scripts/animate.py "$scratch/film" -o docs/images/app-scrub.webp
