#!/usr/bin/env bash
# Renders the gallery: make.sh PROGRAM SCENES FOLDER, with a device that does hundreds of Msamples/s.
set -euo pipefail
program=$1 scenes=$2 folder=$3
mkdir -p "$folder"
render() { "$program" render "$@" 2>/dev/null; }

render "$scenes/cornell.gltf" --backend cpu --seed 1 --size 224x224 --spp 256 -o "$folder/cornell-cpu.exr"
render "$scenes/cornell.gltf" --backend vulkan --seed 2 --size 224x224 --spp 256 -o "$folder/cornell-vulkan.exr"
"$program" compare "$folder/cornell-cpu.exr" "$folder/cornell-vulkan.exr" --tonemap none -o "$folder/cornell-panels.png"

vulkan() { name=$1; shift; render "$@" --backend vulkan -o "$folder/$name.png"; }
vulkan veach-mis "$scenes/veach-mis.gltf" --size 576x384 --spp 4096 --tonemap aces
vulkan veach-mis-brdf "$scenes/veach-mis.gltf" --size 360x240 --spp 64 --max-depth 1 --integrator brdf --tonemap aces
vulkan veach-mis-direct "$scenes/veach-mis.gltf" --size 360x240 --spp 64 --max-depth 1 --integrator direct --tonemap aces
vulkan brdf-grid "$scenes/brdf-grid.gltf" --size 560x400 --spp 8192 --tonemap pbr-neutral
vulkan brdf-grid-blinn-phong "$scenes/brdf-grid.gltf" --brdf blinn-phong --size 560x400 --spp 8192 --tonemap pbr-neutral
vulkan furnace "$scenes/furnace.gltf" --size 240x180 --spp 4096 --max-depth 32 --tonemap none
vulkan normal-map "$scenes/normal-map.gltf" --size 480x320 --spp 4096 --tonemap aces
vulkan normal-map-grazing "$scenes/normal-map.gltf" --camera grazing --size 480x320 --spp 4096 --tonemap aces
for model in shading microfacet; do
    render "$scenes/normal-map.gltf" --normal-maps $model --backend vulkan --size 480x320 --spp 4096 -o "$folder/normal-map-$model.exr"
done
"$program" compare "$folder"/normal-map-{shading,microfacet}.exr --tonemap aces -o "$folder/normal-maps.png"
vulkan courtyard "$scenes/courtyard.gltf" --env 1.8,2.1,2.6 --size 576x384 --spp 4096 --tonemap uncharted2
vulkan mirror-maze "$scenes/mirror-maze.gltf" --size 432x288 --spp 16384 --max-depth 32 --tonemap exponential
"$program" generate many-lights --count 100000 -o "$folder/many-lights.glb"
vulkan many-lights "$folder/many-lights.glb" --size 480x320 --spp 8192 --tonemap aces
rm -f "$folder/many-lights.glb" "$folder"/{cornell,normal-map}-*.exr
