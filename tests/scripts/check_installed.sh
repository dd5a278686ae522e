#!/usr/bin/env bash
# check_installed.sh BUILD SCENE: installs the build into a scratch folder and builds the example of docs/examples against
# what lies there, by CMake and by pkg-config. The project's own folders are never on a search path.
set -euo pipefail
build="$1" scene="$2"
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
fail() { printf '%s\n' "$*" >&2; exit 1; }

cmake --install "$build" --prefix "$scratch/usr" >"$scratch/install.log" || fail "$(cat "$scratch/install.log")"
for file in bin/diptych include/diptych/diptych.h include/diptych/version.h; do
    [ -f "$scratch/usr/$file" ] || fail "not installed: $file"
done
library="$(find "$scratch/usr" -name 'libdiptych.so.*.*.*')"
[ -n "$library" ] || fail "not installed: libdiptych.so"

# The installed headers name the standard library and each other alone.
others="$(grep -rhoE '^#include <[^>]+>|^#include "[^"]+"' "$scratch/usr/include" | sort -u |
    grep -vE '^#include (<[a-z_]+>|"diptych/[a-z_]+\.h")$' || true)"
[ -z "$others" ] || fail "public headers include: $others"
# Each of them compiles by itself.
for header in "$scratch"/usr/include/diptych/*.h; do
    echo "#include <diptych/$(basename "$header")>" | "${CXX:-c++}" -std=c++20 -Wall -Wextra -Werror -fsyntax-only \
        -I "$scratch/usr/include" -x c++ - || fail "does not compile alone: $header"
done
readelf -d "$library" | grep -q 'SONAME.*libdiptych\.so\.0' || fail "no soname"
foreign="$(nm -DC --defined-only "$library" | cut -d' ' -f3- | grep -v 'diptych::v0::' || true)"
[ -z "$foreign" ] || fail "the library exports: $(head -n 5 <<<"$foreign")"

check_run() {
    mkdir -p "$scratch/out"
    "$1" "$scene" "$scratch/out" >"$scratch/run.log" 2>&1 || fail "$1: $(cat "$scratch/run.log")"
    grep -q '^cpu: 16 samples a pixel' "$scratch/run.log" || fail "$1 says: $(cat "$scratch/run.log")"
    "$scratch/usr/bin/diptych" compare "$scratch/out/cpu.exr" "$scratch/out/cpu.exr" >/dev/null || fail "cpu.exr is no picture"
    rm -r "$scratch/out"
}
cmake -G Ninja -S "$root/docs/examples" -B "$scratch/example" -DCMAKE_PREFIX_PATH="$scratch/usr" \
    -DCMAKE_CXX_COMPILER="${CXX:-c++}" >"$scratch/cmake.log" || fail "$(cat "$scratch/cmake.log")"
cmake --build "$scratch/example" >"$scratch/cmake.log" 2>&1 || fail "$(cat "$scratch/cmake.log")"
check_run "$scratch/example/two_panels"
if command -v pkg-config >/dev/null; then
    PKG_CONFIG_PATH="$(dirname "$(find "$scratch/usr" -name diptych.pc)")"
    export PKG_CONFIG_PATH
    # shellcheck disable=SC2046
    "${CXX:-c++}" -std=c++20 "$root/docs/examples/two_panels.cpp" -o "$scratch/by_pkg_config" \
        $(pkg-config --define-variable=prefix="$scratch/usr" --cflags --libs diptych) -Wl,-rpath,"$(dirname "$library")"
    check_run "$scratch/by_pkg_config"
fi
cat "$scratch/run.log"
