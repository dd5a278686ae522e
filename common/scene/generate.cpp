#include "scene/generate.h"

#include "error.h"
#include "scene/generate_scenes.h"

namespace diptych {
namespace {

constexpr SceneGenerator generators[] = {
    {"cornell", "the Cornell box, as measured", generate_cornell},
    {"veach-mis", "glossy plates reflect spheres of equal power and unequal size", generate_veach_mis},
    {"brdf-grid", "spheres, roughness across and metalness up", generate_brdf_grid},
    {"furnace", "a closed room where every ray sees 0.5", generate_furnace},
    {"normal-map", "a brick relief head-on and at a grazing angle", generate_normal_map},
    {"courtyard", "a columned hall around a court under the sky", generate_courtyard},
    {"many-lights", "a street at night with --count emitters, most of them hidden", generate_many_lights},
    {"mirror-maze", "perfect mirrors and small coloured lamps", generate_mirror_maze},
    {"moving-light", "a room whose occluder, lamps and second camera move", generate_moving_light},
};

}  // namespace

std::span<const SceneGenerator> scene_generators() {
    return generators;
}

GeneratedScene generate_scene(const std::string& name, const GenerateOptions& options) {
    std::string names;
    for (const SceneGenerator& generator : generators) {
        if (name == generator.name)
            return generator.generate(options);
        names += (names.empty() ? "" : ", ") + std::string(generator.name);
    }
    throw Error("no generated scene is called '" + name + "'; there are " + names);
}

}  // namespace diptych
