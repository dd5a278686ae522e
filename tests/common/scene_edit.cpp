// What of an edited scene a renderer can go on with.
#include "catch.h"
#include "render/session.h"

using namespace diptych::core;

TEST_CASE("An edit of a node counts where it moves an instance, at whatever moment", "[session]") {
    Scene scene;
    scene.meshes.resize(1);
    scene.nodes.resize(4);
    scene.nodes[0].scale = glm::dvec3(0);  // hides all edits below it, at rest
    scene.nodes[1].parent = 0;
    scene.nodes[2].parent = 1;
    scene.instances = {{"flat", 0, glm::dmat4(0), 2}, {"still", 0, glm::dmat4(1), none}};
    scene.lights.resize(1);
    scene.lights[0].node = 3;
    CHECK(editable_in_place(scene, scene));
    for (const std::size_t node : {0U, 1U, 2U}) {
        INFO(node);
        Scene edited = scene;
        edited.nodes[node].translation.x = 1;
        CHECK_FALSE(editable_in_place(scene, edited));
        edited = scene;
        edited.nodes[node].rotation = {1, 0, 0, 0};
        CHECK_FALSE(editable_in_place(scene, edited));
        edited = scene;
        edited.nodes[node].scale.y = 2;
        CHECK_FALSE(editable_in_place(scene, edited));
        edited = scene;
        edited.nodes[node].matrix = glm::dmat4(1);
        CHECK_FALSE(editable_in_place(scene, edited));
    }
    Scene edited = scene;
    edited.nodes[3].translation.x = 1;  // a light's alone
    edited.lights[0].light_to_world[3][0] = 1;
    CHECK(editable_in_place(scene, edited));
}
