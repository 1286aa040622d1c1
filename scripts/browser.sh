# Sourced by scripts that open pages: NBRDF_BROWSER is a Chromium that runs without a display, installed where that may be done, or empty
# where there is none.
NBRDF_BROWSER="${NBRDF_BROWSER:-}"
find_browser() {
    local name
    for name in chromium chromium-browser google-chrome google-chrome-stable; do
        if [ -z "$NBRDF_BROWSER" ]; then NBRDF_BROWSER=$(command -v "$name" || true); fi
    done
}
find_browser
if [ -z "$NBRDF_BROWSER" ] && [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
    { apt-get update -q && apt-get install -qy --no-install-recommends chromium; } || echo "Chromium could not be installed" >&2
    find_browser
fi
export NBRDF_BROWSER
