#!/usr/bin/env bash
# Photographs the app in both themes and two sizes, and a path of spheres, into docs/images; software GL under Xvfb.
set -euo pipefail
cd "$(dirname "$0")/.."
packages="xvfb xauth libxkbcommon-x11-0 libgl1 libegl1 libgl1-mesa-dri"
if ! command -v xvfb-run >/dev/null; then
    [ "$(id -u)" = 0 ] || { echo "missing: apt-get install $packages" >&2; exit 1; }
    # shellcheck disable=SC2086
    apt-get update -q && apt-get install -qy $packages
fi
cargo build --release
nbrdf="${CARGO_TARGET_DIR:-target}/release/nbrdf"
mkdir -p docs/images
"$nbrdf" blend gold-paint blue-acrylic --steps 7 --method latent --method raw_weights --method pca_tables \
    -o docs/images/path.png
shoot() { # NAME SIZE THEME [MORE...]
    xvfb-run -a -s "-screen 0 1920x1200x24" "$nbrdf" app --size "$2" --theme "$3" --screenshot "docs/images/$1.png" "${@:4}"
}
for theme in dark light; do
    shoot "app-$theme" 1600x900 "$theme"
    shoot "app-small-$theme" 900x600 "$theme"
done
shoot app-softboxes 1600x900 dark --a chrome --b brass --light softboxes
