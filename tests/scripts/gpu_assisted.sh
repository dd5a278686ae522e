#!/usr/bin/env bash
# tests/scripts/gpu_assisted.sh BUILD FOLDER...: runs the everyday tests of these folders of tests/ (gpu, panels) under
# the validation layer's GPU-assisted and synchronisation checks, and fails if a test fails or the layer prints a
# message. Exit code 77 (skipped) if no suitable layer is installed or can be fetched.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../../cmake/setup.sh"
build=$1
shift

# Older layers take a vec3 for 16 bytes, but it has 12 in scalar layout. So they report valid reads at the end of a
# buffer as out of bounds, and give the shader zeros instead (KhronosGroup/SPIRV-Tools issue 4992).
least=1.3.268
version_in() {
    sed -n 's/.*"api_version": *"\([0-9.]*\)".*/\1/p' "$1/VkLayer_khronos_validation.json" 2>/dev/null || true
}
is_new() { [ -n "$1" ] && [ "$(printf '%s\n' "$least" "$1" | sort -V | head -n 1)" = "$least" ]; }

# Unpacks Debian 13's layer, with the C and C++ libraries that it needs, into folder $1; nothing is installed. The
# packages come from the mirror that this machine's apt uses.
fetch_layer() {
    local folder=$1 suite options
    [ ! -d "$folder/root" ] || return 0
    [ "${DIPTYCH_NO_INSTALL:-0}" != 1 ] && command -v apt-get >/dev/null && command -v dpkg >/dev/null || return 1
    suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
    mkdir -p "$folder/sources" "$folder/lists/partial" "$folder/cache/archives/partial"
    source_of_suite "$suite" trixie >"$folder/sources/trixie.sources" || return 1
    options=(-qq -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$folder/sources"
             -o "Dir::State::Lists=$folder/lists" -o "Dir::Cache=$folder/cache" -o Acquire::Languages=none)
    (cd "$folder" && rm -rf unpacked && apt-get "${options[@]}" update &&
        apt-get "${options[@]}" download vulkan-validationlayers libc6 libstdc++6 libgcc-s1 &&
        mkdir unpacked && for package in *.deb; do dpkg -x "$package" unpacked || exit 1; done &&
        mv unpacked root) >"$folder/log" 2>&1
}

runner=()
version=$(version_in "${VK_LAYER_PATH:-/usr/share/vulkan/explicit_layer.d}")
if ! is_new "$version"; then
    layer=$diptych_root/build/validation-layer
    mkdir -p "$layer"
    if ! fetch_layer "$layer"; then
        echo "SKIPPED: the validation layer is ${version:-not installed}; $least or later is needed ($layer/log)"
        exit 77
    fi
    export VK_LAYER_PATH=$layer/root/usr/share/vulkan/explicit_layer.d
    version=$(version_in "$VK_LAYER_PATH")
    runner=("$layer/root/usr/lib64/ld-linux-x86-64.so.2" --library-path "$layer/root/usr/lib/x86_64-linux-gnu")
fi
echo "validation layer $version"

# The filter drops the layer's messages about itself: that it is slow, and which features it turns on for its shaders.
export VK_LAYER_ENABLES=VK_VALIDATION_FEATURE_ENABLE_GPU_ASSISTED_EXT DIPTYCH_VALIDATION=1
export VK_LAYER_MESSAGE_ID_FILTER=VALIDATION-SETTINGS,WARNING-GPU-Assisted-Validation

# These two tests provoke messages, so they run apart from the others, whose output must have none.
provoked=("Validation reports a write that races with another, and counts it"
          "GPU-assisted validation reports a read beyond the end of a buffer by its address")
others="~[nightly]"
for test in "${provoked[@]}"; do
    "${runner[@]}" "$build/tests/tests_gpu" "${test//,/\\,}"
    others+="~\"${test//,/\\,}\""
done
for folder in "$@"; do
    log=$build/gpu_assisted_$folder.log
    "${runner[@]}" "$build/tests/tests_$folder" "$others" --durations yes 2>&1 | tee "$log"
    if grep -q "^validation: " "$log"; then
        echo "FAILED: $folder has validation messages: $log"
        exit 1
    fi
done
