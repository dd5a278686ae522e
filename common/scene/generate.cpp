#include "scene/generate.h"

#include "error.h"
#include "scene/generate_scenes.h"

namespace diptych {
namespace {

constexpr SceneGenerator generators[] = {
    {"cornell", "the Cornell box, as measured", generate_cornell},
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
