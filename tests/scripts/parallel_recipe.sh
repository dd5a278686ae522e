#!/usr/bin/env bash
# parallel_recipe.sh PROGRAM FARM.MD: runs the recipe for GNU parallel of docs/farm.md, with small pictures, and compares
# its picture with that of one render.
set -euo pipefail
program="$1" page="$2"
if ! command -v parallel >/dev/null; then
    echo "SKIPPED: GNU parallel is not installed"
    exit 77
fi
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
cat > "$folder/bin/diptych" <<SCRIPT
#!/usr/bin/env bash
[ "\$1" = render ] && set -- "\$@" --size 24
exec "$program" "\$@"
SCRIPT
chmod +x "$folder/bin/diptych"
recipe="$(awk '/^### GNU parallel/ {here = 1} here && /^```$/ {exit} on {print} here && /^```bash$/ {on = 1}' "$page")"
[ -n "$recipe" ] || { echo "$page has no recipe for GNU parallel"; exit 1; }
cd "$folder"
export PATH="$folder/bin:$PATH"
export HOME="$folder"  # parallel keeps notes there
"$program" generate cornell -o scene.glb >/dev/null
bash -euc "$recipe"
diptych render scene.glb --spp 32 -o one.exr
diptych compare one.exr whole.exr 2>/dev/null | tee said
grep -q "The two pictures are identical" said
