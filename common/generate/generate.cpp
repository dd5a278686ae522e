#include "generate/generate.h"

#include "error.h"
#include "generate/scenes.h"

namespace diptych::core {
namespace {

constexpr SceneGenerator generators[] = {
    {"cornell", "the Cornell box, as measured", generate_cornell},
    {"veach-mis", "glossy plates reflect spheres of equal power and unequal size", generate_veach_mis},
    {"brdf-grid", "spheres, roughness across and metalness up", generate_brdf_grid},
    {"furnace", "a closed room where every ray sees 0.5", generate_furnace},
    {"normal-map", "a brick relief head-on and at a grazing angle", generate_normal_map},
    {"courtyard", "a columned hall around a court under the sky", generate_courtyard},
    {"many-lights", "a street at night with `count` emitters, most of them hidden", generate_many_lights},
    {"mirror-maze", "perfect mirrors and small coloured lamps", generate_mirror_maze},
    {"moving-light", "a room whose occluder, lamps and second camera move", generate_moving_light},
};

constexpr SceneGenerator extreme_generators[] = {
    {"extreme-instances", "mirrored, sheared, flattened and stretched instances", generate_extreme_instances},
    {"extreme-near-lamp", "a lamp a millimetre above a plane", generate_extreme_near_lamp},
    {"extreme-sun", "a sun of 1e-5 sr", generate_extreme_sun},
    {"extreme-far-room", "a room 100 km from the origin", generate_extreme_far_room},
    {"extreme-macro", "a room of 10 micrometres", generate_extreme_macro},
    {"extreme-wide", "a plane of 1000 km with a stone on it", generate_extreme_wide},
    {"extreme-white-room", "walls of albedo 0.999", generate_extreme_white_room},
    {"extreme-coplanar", "faces in one plane, and through one another", generate_extreme_coplanar},
    {"extreme-broken-mesh", "triangles without area, and vertices that are no numbers", generate_extreme_broken_mesh},
    {"extreme-normal-map", "normal maps tilted by 85 degrees", generate_extreme_normal_map},
    {"extreme-terminator", "smooth normals on coarse spheres", generate_extreme_terminator},
};

}  // namespace

std::span<const SceneGenerator> scene_generators() {
    return generators;
}

std::span<const SceneGenerator> extreme_scene_generators() {
    return extreme_generators;
}

GeneratedScene generate_scene(const std::string& name, const GenerateOptions& options) {
    std::string names;
    for (const SceneGenerator& generator : generators) {
        if (name == generator.name) {
            return generator.generate(options);
        }
        names += (names.empty() ? "" : ", ") + std::string(generator.name);
    }
    for (const SceneGenerator& generator : extreme_generators) {
        if (name == generator.name) {
            return generator.generate(options);
        }
        names += ", " + std::string(generator.name);
    }
    throw Error("no generated scene is called '" + name + "'; there are " + names);
}

}  // namespace diptych::core
