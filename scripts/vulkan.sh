# Sourced by scripts whose programs draw with wgpu: makes sure of Vulkan in software (lavapipe) where it may be installed, and has
# tests insist on it where it is there.
if [ "$(uname)" = Linux ]; then
    has_lavapipe() { compgen -G '/usr/share/vulkan/icd.d/lvp_icd*.json' >/dev/null; }
    if ! has_lavapipe && [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
        { apt-get update -q && apt-get install -qy libvulkan1 mesa-vulkan-drivers; } || echo "lavapipe could not be installed" >&2
    fi
    if has_lavapipe; then
        export NBRDF_REQUIRE_VULKAN="${NBRDF_REQUIRE_VULKAN:-1}"
    else
        echo "no Vulkan in software: tests that need it may be skipped (Debian: apt-get install mesa-vulkan-drivers)" >&2
    fi
fi
