#!/usr/bin/env bash
# tests/scripts/sanitizers.sh PRESET [CTEST_OPTION...]: builds the preset asan or tsan, and runs its everyday tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
preset=$1 log=build/$1.log
shift
mkdir -p build
if ! { cmake --preset "$preset" && cmake --build --preset "$preset"; } >"$log" 2>&1; then
    tail -n 20 "$log"
    echo "the build failed: $log"
    exit 1
fi
ctest --preset "$preset" --timeout 1500 --parallel "$(nproc)" "$@"
