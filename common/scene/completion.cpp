#include "scene/completion.h"

#include "scene/default_camera.h"
#include "scene/environment_load.h"
#include "scene/own_light.h"

namespace diptych::core {

bool add_missing_light(Scene& scene, const std::string& remedy) {
    const OwnLight light = own_light(scene);
    if (light == OwnLight::enough) {
        return false;
    }
    scene.environment = neutral_sky();
    const char* reason =
        light == OwnLight::absent ? "the scene has no light" : "what emits in the scene is too weak to light it";
    scene.warnings.add(reason + std::string(": lit by a neutral sky") + remedy, scene.name);
    return true;
}

bool add_missing_camera(Scene& scene) {
    if (!scene.cameras.empty()) {
        return false;
    }
    scene.cameras.push_back(frame_scene(scene));
    return true;
}

}  // namespace diptych::core
