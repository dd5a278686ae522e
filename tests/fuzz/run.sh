#!/usr/bin/env bash
# tests/fuzz/run.sh TARGET SECONDS [OPTION...]: builds the fuzz target (preset `fuzz`) and runs it from its corpus for so long;
# further options go to libFuzzer. Exit code 77 where there is no clang with its sanitizers. A finding is kept in
# build/fuzz/findings, and is exit code 1.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
target=$1 seconds=$2
shift 2
build=$root/build/fuzz

probe=$(mktemp -d)
trap 'rm -rf "$probe"' EXIT
echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' >"$probe/probe.cpp"
if ! clang++ -fsanitize=fuzzer,address,undefined "$probe/probe.cpp" -o "$probe/probe" 2>"$probe/log"; then
    echo "SKIPPED: no clang++ that links -fsanitize=fuzzer,address,undefined (Debian: clang, libclang-rt-dev)"
    exit 77
fi

cd "$root"
mkdir -p "$build/findings"
if ! { cmake --preset fuzz && cmake --build "$build" --target "fuzz_$target"; } >"$build/build.log" 2>&1; then
    tail -n 20 "$build/build.log"
    echo "the build failed: $build/build.log"
    exit 1
fi
cp -r "$root/tests/fuzz/corpus/$target" "$probe/corpus"
dictionary=()
[ ! -e "$root/tests/fuzz/$target.dict" ] || dictionary=("-dict=$root/tests/fuzz/$target.dict")
# One allocation beyond malloc_limit_mb is a finding: the readers are given 64 MB (target.h).
# Leaks are not looked for: OpenImageIO leaks the message of a PNG that was cut off.
ASAN_OPTIONS=detect_leaks=0 "$build/fuzz_$target" "${dictionary[@]}" -max_total_time="$seconds" -rss_limit_mb=1500 \
    -malloc_limit_mb=300 -timeout=20 -max_len=65536 -print_final_stats=1 -artifact_prefix="$build/findings/$target-" "$@" \
    "$probe/corpus"
