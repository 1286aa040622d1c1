# Sourced by scripts whose programs draw with wgpu: makes sure of Vulkan in software (lavapipe) and of a compiler of HLSL (glslang)
# where they may be installed, and has tests insist on what is there.
if [ "$(uname)" = Linux ]; then
    has_lavapipe() { compgen -G '/usr/share/vulkan/icd.d/lvp_icd*.json' >/dev/null; }
    has_all() { has_lavapipe && command -v glslangValidator >/dev/null; }
    if ! has_all && [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null; then
        { apt-get update -q && apt-get install -qy libvulkan1 mesa-vulkan-drivers glslang-tools; } || echo "lavapipe and glslang could not be installed" >&2
    fi
    if command -v glslangValidator >/dev/null; then export NBRDF_REQUIRE_GLSLANG="${NBRDF_REQUIRE_GLSLANG:-1}"; fi
    if has_lavapipe; then
        export NBRDF_REQUIRE_VULKAN="${NBRDF_REQUIRE_VULKAN:-1}"
    else
        echo "no Vulkan in software: tests that need it may be skipped (Debian: apt-get install mesa-vulkan-drivers)" >&2
    fi
fi
