#!/usr/bin/env bash
# validate_scenes.sh PROGRAM: every scene that PROGRAM generates, and every committed one, passes the Khronos glTF
# validator; and a broken scene does not. Exit 77 (skipped) without node or the validator, which ./test fetches.
set -euo pipefail
program="$1"
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
packages="$root/build/node_modules"
if ! command -v node >/dev/null || [ ! -d "$packages/gltf-validator" ]; then
    echo "SKIPPED: no node or no npm package gltf-validator in build/node_modules"
    exit 77
fi
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

validate() { node "$root/tests/scripts/validate_gltf.js" "$packages" "$@"; }

printf '{"asset":{"version":"2.0"},"nodes":[{"mesh":3}]}' >"$folder/broken.gltf"
if validate "$folder/broken.gltf" >/dev/null; then
    echo "the validator accepts a broken scene"
    exit 1
fi
for name in cornell veach-mis brdf-grid furnace normal-map courtyard mirror-maze; do
    "$program" generate "$name" -o "$folder/$name.gltf"
done
"$program" generate many-lights --count 1000 -o "$folder/many-lights.gltf"
"$program" generate cornell -o "$folder/cornell.glb"
rm "$folder/broken.gltf"
shopt -s nullglob
validate "$folder"/*.gl* "$root"/scenes/*.gltf "$root"/scenes/*.glb
