# Sourced by scripts that open windows where there is no display: makes sure of Xvfb, software GL and a pointer to move.
packages="xvfb xauth xdotool libxkbcommon-x11-0 libgl1 libegl1 libgl1-mesa-dri"
if ! command -v xvfb-run >/dev/null || ! command -v xdotool >/dev/null; then
    [ "$(id -u)" = 0 ] || { echo "missing: apt-get install $packages" >&2; exit 1; }
    # shellcheck disable=SC2086
    apt-get update -q && apt-get install -qy $packages
fi
