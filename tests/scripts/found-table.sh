#!/usr/bin/env bash
# Prints what a program makes of small files that other renderers stumbled over, as Markdown with a column a backend:
#   tests/scripts/found-table.sh [PROGRAM] [FOLDER]
# By default PROGRAM is the release build, and FOLDER is `found` of the assets beside the repository.
# Needs python3. Programs of any commit will do. A command has 30 s and 2 GiB of address space, because some of the
# files made earlier programs run without an end or take all memory.
# docs/results/found.md explains the figures.
set -uo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
program="$(realpath "${1:-$root/build/release/diptych}")"
folder="$(realpath "${2:-$root/../shared/assets/found}")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$folder" || exit 2

run() { (ulimit -v $((2 << 20)); timeout -k 5 30 "$program" "$@") >"$work/out" 2>"$work/err"; }
mean() { python3 "$root/tests/scripts/exr-mean.py" "$@"; }
message() {  # of the last command, without the progress lines: its last line, or all
    tr '\r' '\n' <"$work/err" | grep '^diptych: ' | grep -Ev 'no light|no camera' | ${1:-tail -n 1} |
        sed 's/^diptych: //; s/|/\\|/g' | paste -sd ';'
}
failed() {  # EXIT_CODE
    case "$1" in
        124 | 137) echo "no end in 30 s" ;;
        134) echo "aborts" ;;
        *) echo "exit $1: $(message)" ;;
    esac
}
render() {  # SCENE BACKEND SAMPLES DEPTH OPTIONS...: writes $work/BACKEND.exr, or prints why there is none
    run render "$1" --backend "$2" --spp "$3" --max-depth "$4" --size "${size:-64x48}" -o "$work/$2.exr" "${@:5}" ||
        { failed $?; return 1; }
}
row() {  # FILE FUNCTION ARGUMENTS...: one cell for each backend
    local cells="" backend
    for backend in cpu vulkan oracle; do cells+=" | $("$2" "$1" "$backend" "${@:3}")"; done
    echo "| $1$cells |"
}

seed() { case "$1" in cpu) echo 1 ;; vulkan) echo 2 ;; *) echo 3 ;; esac; }
picture_mean() { render "$1" "$2" "${3:-64}" 3 --seed "$(seed "$2")" && mean "$work/$2.exr"; }
centre() { render "$1" "$2" 64 1 --env "${3:-0,0,0}" && mean "$work/$2.exr" "${4:-G}" 28 20 36 28; }
layer() { render "$1" "$2" 64 1 && mean "$work/$2.exr" "$3"; }
profile() {  # along x = -0.6, -0.4 ... 0.6 of a view of [-1, 1]
    local x size=40x40
    render "$1" "$2" 64 1 --env 0,0,0 || return
    for x in 7 11 15 19 23 27 31; do mean "$work/$2.exr" G "$x" 19 $((x + 2)) 21; done |
        paste -sd ' ' | sed 's/\b0\././g; s/\([0-9]\{3\}\)[0-9]\b/\1/g'
}

sky() {  # IMAGE BACKEND: a wide view of it, away from all geometry
    render geometry/bevy-cornell.glb "$2" 16 0 --eye 0,9000,0 --look-at 4000,12000,5000 --fov 150 --env "$1"
}
as_sky() {  # IMAGE BACKEND REFERENCE: how a view of the sky differs from one of the reference
    sky "$3" "$2" && mv "$work/$2.exr" "$work/reference.exr" && sky "$1" "$2" || return
    run compare "$work/$2.exr" "$work/reference.exr" --json
    python3 -c 'import json, sys
found = json.load(open(sys.argv[1]))
differs = "{:.2f} times as bright, relMSE {:.2g}".format(found["mean_ratio"][1], found["relmse"])
print("the same" if found["relmse"] < 1e-9 else differs)' "$work/out"
}
sky_colour() { sky "$1" "$2" && for c in R G B; do mean "$work/$2.exr" "$c"; done | paste -sd ' '; }
answer() {  # FILE BACKEND OPTIONS...: refused, or rendered with these warnings
    render "$1" "$2" 1 3 "${@:3}" || return
    local warnings; warnings="$(message cat)"
    echo "renders${warnings:+; $warnings}"
}
broken_sky() { sky "$1" "$2" && echo renders; }

echo "| file | CPU | Vulkan | oracle |"
echo "|---|---|---|---|"
for file in geometry/oom_card.glb geometry/flat_*.glb geometry/pl_0.glb; do row "$file" picture_mean; done
row geometry/zs_s0.glb centre 1,1,1 R
row geometry/bevy-cornell.glb picture_mean 256
for file in materials/nm_*.glb materials/tanpar.glb; do row "$file" centre; done
row materials/dome_d50_map.glb profile
row materials/cut0.5-vec3.glb layer albedo.G
row materials/turn0.glb layer normal.Y
for file in images/e_up.hdr images/e_tr.hdr images/e_exp.hdr; do row "$file" as_sky images/e_flat.hdr; done
row images/e_xyze.hdr sky_colour
row images/e_crop.exr as_sky images/e_cropref.exr
for name in layers bl multi xyz rg; do row "images/e_$name.exr" as_sky images/e_ref.exr; done
run compare images/k_crop.exr images/k_crop2.exr
code=$?
echo "| images/k_crop.exr, k_crop2.exr | \`compare\` exits with $code: $(message) | | |"
row animation/an_t_neg.glb answer
for file in animation/an_t_neg.glb animation/an_clips.glb; do row "$file" answer --start 1; done
for file in broken/*.gltf; do row "$file" answer; done
for file in broken/*.exr broken/*.hdr; do row "$file" broken_sky; done
