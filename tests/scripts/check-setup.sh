#!/usr/bin/env bash
# Checks what cmake/setup.sh makes of CXX: the package it installs, and whether it configures the build tree anew.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/../../cmake/setup.sh"

failures=0
expect() {  # WHAT FOUND RIGHT
    if [ "$2" != "$3" ]; then
        echo "$1: found '$2', expected '$3'" >&2
        failures=$((failures + 1))
    fi
}
answer() { if "$@"; then echo yes; else echo no; fi; }

expect "package of c++" "$(compiler_package c++)" g++
expect "package of g++-14" "$(compiler_package g++-14)" g++-14
expect "package of clang++" "$(compiler_package clang++)" clang
expect "package of /usr/bin/clang++-19" "$(compiler_package /usr/bin/clang++-19)" clang-19
expect "missing with CXX=clang++-0" "$(CXX=clang++-0 missing_packages | grep -E '^(clang|g\+\+)')" clang-0

diptych_build="$(mktemp -d)"
trap 'rm -rf "$diptych_build"' EXIT
expect "an empty folder is configured" "$(unset CXX; answer is_configured)" no
touch "$diptych_build/build.ninja"
echo "CMAKE_CXX_COMPILER:FILEPATH=/usr/bin/clang++" >"$diptych_build/CMakeCache.txt"
expect "configured for any compiler" "$(unset CXX; answer is_configured)" yes
expect "configured for clang++" "$(CXX=clang++ answer is_configured)" yes
expect "configured for g++" "$(CXX=g++ answer is_configured)" no
exit "$((failures > 0))"
