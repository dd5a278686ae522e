// The least scene there is, for tests to add one thing to.
#pragma once

#include "catch.h"
#include "pack/features.h"
#include "pack/packed_scene.h"
#include "generate/shapes.h"

namespace diptych::core::tests {

/// One square of rough black, one camera, no light.
inline Scene least_scene() {
    Scene scene;
    scene.name = "least";
    Material m = make_material("matter", glm::vec3(0.5F), 0, 1);
    Primitive square;
    square.material = add_material(scene, m);
    add_quad(square, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    add_object(scene, "square", {square});
    scene.cameras.push_back(make_camera("camera", {0, 1, 3}, {0, 0, 0}, 45));
    return scene;
}

/// Four grey texels and a texture of them.
inline int add_texture(Scene& scene) {
    TextureImage image;
    image.name = "grey";
    image.width = 2;
    image.height = 2;
    image.rgba.assign(16, 128);
    scene.images.push_back(image);
    Texture texture;
    texture.image = static_cast<int>(scene.images.size()) - 1;
    scene.textures.push_back(texture);
    return static_cast<int>(scene.textures.size()) - 1;
}

inline RenderSettings brdf_settings() {
    RenderSettings s;
    s.width = 8;
    s.height = 8;
    s.integrator = Integrator::brdf;
    return s;
}

}  // namespace diptych::core::tests
