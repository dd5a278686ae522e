// The file's node tree: what hangs where, and what an edit of a node moves.
#include <fstream>
#include <limits>

#include "library/library_fixture.h"

using namespace library_tests;

namespace {

/// Three points, two times (0 and 2 s), two translations ((0.5, 0, 0) and (0.5, 1, 0)), joints and weights.
const std::string buffer = "data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAEAAAAA/AAAAAAAAAAAAAAA/AACAPwAAAA"
    "AAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAA=";

/// A root with an arm, in which a triangle, a camera and a lamp hang, and with a triangle that an animation moves.
struct TreeFile {
    std::string root = R"("translation":[0,0.25,0])";
    std::string arm = R"("translation":[0,0,0.5],"rotation":[0,0.0871557427,0,0.9961946981],"scale":[1.25,1.25,1.25])";
    std::string mover = R"("translation":[-0.5,0.125,0])";

    dp::Scene load() const {
        const Folder folder;
        const std::string path = folder.file("tree.gltf");
        std::ofstream(path) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,6,7]}],"nodes":[)"
                            << R"({"name":"root","children":[1,5],)" << root << "},"
                            << R"({"name":"arm","children":[2,3,4],)" << arm << "},"
                            << R"({"name":"hand","mesh":0,"translation":[-0.75,-0.25,0]},)"
                            << R"({"name":"eye","camera":0,"translation":[0,0.25,3]},)"
                            << R"({"name":"bulb","translation":[0,1,2],)"
                            << R"("extensions":{"KHR_lights_punctual":{"light":0}}},)"
                            << R"({"name":"mover","mesh":0,)" << mover << "},"
                            << R"({"name":"still","mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,-0.5,-1,-0.5,1]},)"
                            << R"({"name":"skinned","mesh":1,"skin":0},{"name":"outside","mesh":0}],)"
                            << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},)"
                            << R"({"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":3,"WEIGHTS_0":4}}]}],)"
                            << R"("skins":[{"joints":[1]}],)"
                            << R"("cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],)"
                            << R"("extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":)"
                            << R"({"lights":[{"type":"spot","intensity":30,"spot":{"outerConeAngle":1.2}}]}},)"
                            << R"("animations":[{"name":"rise","samplers":[{"input":1,"output":2}],)"
                            << R"("channels":[{"sampler":0,"target":{"node":5,"path":"translation"}}]}],)"
                            << R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
                            << R"("min":[0,0,0],"max":[1,1,0]},)"
                            << R"({"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[2]},)"
                            << R"({"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"},)"
                            << R"({"bufferView":3,"componentType":5121,"count":3,"type":"VEC4"},)"
                            << R"({"bufferView":4,"componentType":5126,"count":3,"type":"VEC4"}],)"
                            << R"("bufferViews":[{"buffer":0,"byteLength":36},)"
                            << R"({"buffer":0,"byteOffset":36,"byteLength":8},)"
                            << R"({"buffer":0,"byteOffset":44,"byteLength":24},)"
                            << R"({"buffer":0,"byteOffset":68,"byteLength":12},)"
                            << R"({"buffer":0,"byteOffset":80,"byteLength":48}],)"
                            << R"("buffers":[{"byteLength":128,"uri":")" << buffer << R"("}]})";
        return dp::load(path);
    }
};

using Where = std::optional<double>;  // the moment, or at rest

dp::Film film_of(dp::Session& session, const Where& moment) {
    session.pose(moment);
    session.render(2);
    return session.film();
}

dp::Film film_of(const dp::Scene& scene, dp::Backend backend, const Where& moment) {
    dp::BackendChoice choice;
    choice.backend = backend;
    dp::Session session(scene, choice, small_settings());
    return film_of(session, moment);
}

/// Exact in binary, so that it is the same from text: a quarter turn about +Y, twice the size, elsewhere.
const dp::Matrix turned = {0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, -0.25, 0.5, 0.125, 1};
const std::string turned_text = R"("matrix":[0,0,-2,0,0,2,0,0,2,0,0,0,-0.25,0.5,0.125,1])";

/// Renders once, which is when edits are seen.
void see(const dp::Scene& scene) {
    rendered(scene, dp::Backend::cpu, small_settings(), 1);
}

bool same_places(dp::Scene& a, dp::Scene& b) {
    return a.instances() == b.instances() && a.cameras() == b.cameras() && a.lights() == b.lights();
}

}  // namespace

TEST_CASE("A scene has its file's nodes, with what hangs in each") {
    dp::Scene scene = TreeFile().load();
    REQUIRE(scene.nodes().size() == 9);
    const std::vector<dp::Node>& nodes = scene.nodes();
    CHECK(nodes[0].name == "root");
    CHECK(nodes[0].parent == dp::none);
    CHECK(nodes[0].children == std::vector<int>{1, 5});
    CHECK(nodes[0].node_to_parent == dp::Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.25, 0, 1});
    CHECK(nodes[1].children == std::vector<int>{2, 3, 4});
    CHECK(nodes[4].parent == 1);
    CHECK(nodes[6].node_to_parent == dp::Matrix{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.5, -1, -0.5, 1});
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        CHECK(nodes[i].animated == (nodes[i].name == "mover"));
    }
    REQUIRE(scene.instances().size() == 4);
    CHECK(scene.instance("hand").node == 2);
    CHECK(scene.content_of(2).instances == std::vector<int>{0});
    CHECK(scene.content_of(3).cameras == std::vector<int>{0});
    CHECK(scene.content_of(4).lights == std::vector<int>{0});
    CHECK(scene.content_of(0).instances.empty());  // what is below is not the node's own
    CHECK(scene.content_of(7).instances.empty());  // the joints place a skinned mesh
    CHECK(scene.content_of(8).instances.empty());  // no part of the scene that the file shows
    CHECK(&scene.node("arm") == &scene.nodes()[1]);
    CHECK(message_of([&] { scene.node("arn"); }).find("no node 'arn' (did you mean 'arm'?)") != std::string::npos);
    CHECK(message_of([&] { scene.content_of(9); }).find("there is no node 9") != std::string::npos);

    dp::Scene built = small_scene();
    CHECK(built.nodes().empty());
}

TEST_CASE("An edited node moves all below it, as if the file had said so") {
    TreeFile edited_file;
    edited_file.arm = turned_text;
    for (const dp::Backend backend : panels()) {
        for (const Where& moment : {Where(), Where(1.0)}) {
            INFO(dp::name_of(backend) << ", " << (moment ? "posed" : "at rest"));
            dp::Scene scene = TreeFile().load();
            dp::Scene expected = edited_file.load();
            dp::BackendChoice choice;
            choice.backend = backend;
            dp::Session session(scene, choice, small_settings());
            const dp::Film before = film_of(session, moment);
            scene.node("arm").node_to_parent = turned;
            const dp::Film after = film_of(session, moment);
            CHECK_FALSE(same_bits(before, after));
            // The skinned mesh was placed when the file was loaded, so it has no part in this comparison.
            dp::Scene untouched = TreeFile().load();
            CHECK(scene.instance("hand") == expected.instance("hand"));
            CHECK(scene.cameras() == expected.cameras());
            CHECK(scene.lights() == expected.lights());
            for (const char* name : {"mover", "still", "skinned"}) {
                CHECK(scene.instance(name) == untouched.instance(name));
            }
            expected.instances().pop_back();
            scene.instances().pop_back();
            CHECK(same_bits(film_of(session, moment), film_of(expected, backend, moment)));
        }
    }
}

TEST_CASE("A matrix edited on its own wins over the node, and the object hangs in no node any more") {
    dp::Scene scene = TreeFile().load();
    scene.instance("hand").object_to_world[12] = 0.5;
    const dp::Instance hand = scene.instance("hand");
    scene.node("arm").node_to_parent = turned;
    see(scene);
    CHECK(scene.instance("hand").object_to_world == hand.object_to_world);
    CHECK(scene.instance("hand").node == dp::none);
    CHECK(scene.content_of(2).instances.empty());
    CHECK(scene.camera("eye").node == 3);  // which goes on hanging there

    const dp::Light bulb = scene.light("bulb");
    scene.camera("eye") = dp::look_at({0, 0, 4}, {0, 0, 0});
    scene.cameras()[0].name = "eye";
    see(scene);
    scene.node("root").node_to_parent[12] = 0.75;
    see(scene);
    CHECK(scene.camera("eye").camera_to_world == dp::look_at({0, 0, 4}, {0, 0, 0}).camera_to_world);
    CHECK(scene.instance("hand").object_to_world == hand.object_to_world);
    CHECK(scene.light("bulb").light_to_world[12] == bulb.light_to_world[12] + 0.75);

    scene.light("bulb").light_to_world[12] = 0.125;
    see(scene);
    CHECK(scene.light("bulb").node == dp::none);
}

TEST_CASE("What hangs in a node goes on to when rows before it are erased, and when it is edited otherwise") {
    TreeFile edited_file;
    edited_file.root = turned_text;
    dp::Scene scene = TreeFile().load();
    dp::Scene expected = edited_file.load();
    for (dp::Scene* each : {&scene, &expected}) {
        each->instances().erase(each->instances().begin());
        each->instances().pop_back();  // the skinned one
        each->camera("eye").vertical_fov = 0.7;
        each->light("bulb").intensity = {20, 25, 30};
    }
    see(scene);
    CHECK(scene.instance("mover").node == 5);
    scene.node("root").node_to_parent = turned;
    see(scene);
    CHECK(same_places(scene, expected));
    for (const Where& moment : {Where(), Where(1.0)}) {
        CHECK(same_bits(film_of(scene, dp::Backend::cpu, moment), film_of(expected, dp::Backend::cpu, moment)));
    }
}

TEST_CASE("An object hangs in the node that it names if it stands where the node places it") {
    dp::Scene scene = TreeFile().load();
    dp::Instance copy = scene.instance("hand");
    copy.name = "copy";
    dp::Instance elsewhere = copy;
    elsewhere.name = "elsewhere";
    elsewhere.object_to_world[12] += 1;
    scene.instances().push_back(copy);
    scene.instances().push_back(elsewhere);
    scene.node("arm").node_to_parent = turned;
    see(scene);
    CHECK(scene.instance("copy").object_to_world == scene.instance("hand").object_to_world);
    CHECK(scene.instance("copy").node == 2);
    CHECK(scene.instance("elsewhere").object_to_world == elsewhere.object_to_world);
    CHECK(scene.instance("elsewhere").node == dp::none);
}

TEST_CASE("An animation sets its part of a node's matrix at each moment, and the edited matrix the rest") {
    TreeFile edited_file;
    edited_file.mover = R"("translation":[0.25,0.5,0.25],"scale":[0.5,2,1])";
    for (const dp::Backend backend : panels()) {
        INFO(dp::name_of(backend));
        dp::Scene scene = TreeFile().load();
        const dp::Scene expected = edited_file.load();
        dp::BackendChoice choice;
        choice.backend = backend;
        dp::Session session(scene, choice, small_settings());
        for (const Where& moment : {Where(), Where(0.0), Where(1.0)}) {
            film_of(session, moment);
        }
        scene.node("mover").node_to_parent = {0.5, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0.25, 0.5, 0.25, 1};
        for (const Where& moment : {Where(1.0), Where(), Where(0.0)}) {
            CHECK(same_bits(film_of(session, moment), film_of(expected, backend, moment)));
        }
    }
    // Only the translation is the animation's: elsewhere at rest is the same at a moment.
    dp::Scene scene = TreeFile().load();
    scene.node("mover").node_to_parent[13] = 0.75;
    CHECK(same_bits(film_of(scene, dp::Backend::cpu, 1.0), film_of(TreeFile().load(), dp::Backend::cpu, 1.0)));
    CHECK_FALSE(same_bits(film_of(scene, dp::Backend::cpu, {}), film_of(TreeFile().load(), dp::Backend::cpu, {})));
    // A turned and mirrored one comes apart and together again.
    scene.node("mover").node_to_parent = {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 0, 0, 0, 1};
    see(scene);
    const dp::Matrix wanted = {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 0, 0.25, 0, 1};  // the root lifts it
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        CHECK(std::abs(scene.instance("mover").object_to_world[i] - wanted[i]) < 1e-12);
    }
}

TEST_CASE("What was placed by itself does not follow an animation either") {
    dp::Scene scene = TreeFile().load();
    scene.instance("mover").object_to_world[13] = 0.5;
    CHECK(same_bits(film_of(scene, dp::Backend::cpu, 0.0), film_of(scene, dp::Backend::cpu, 2.0)));
    const dp::Scene moving = TreeFile().load();
    CHECK_FALSE(same_bits(film_of(moving, dp::Backend::cpu, 0.0), film_of(moving, dp::Backend::cpu, 2.0)));
}

TEST_CASE("Edits of nodes that cannot be are refused by name, and change nothing") {
    const dp::Scene untouched = TreeFile().load();
    const dp::Film expected = film_of(untouched, dp::Backend::cpu, {});
    const std::vector<std::pair<std::string, std::function<void(dp::Scene&)>>> refusals = {
        {"nodes[1] 'arm': parent, children and animated", [](dp::Scene& s) { s.node("arm").parent = 6; }},
        {"nodes[0] 'root': parent, children and animated", [](dp::Scene& s) { s.node("root").children.pop_back(); }},
        {"nodes[1] 'arm': parent, children and animated", [](dp::Scene& s) { s.node("arm").animated = true; }},
        {"nodes: there are 8; they have to stay the file's 9", [](dp::Scene& s) { s.nodes().pop_back(); }},
        {"nodes[1] 'arm': node_to_parent is nan",
         [](dp::Scene& s) { s.node("arm").node_to_parent[5] = std::numeric_limits<double>::quiet_NaN(); }},
        {"nodes[1] 'arm': node_to_parent has to be affine", [](dp::Scene& s) { s.node("arm").node_to_parent[3] = 1; }},
        {"nodes[5] 'mover': node_to_parent has to be a translation times",
         [](dp::Scene& s) { s.node("mover").node_to_parent[4] = 1; }},
        {"nodes[5] 'mover': node_to_parent has to be a translation times",
         [](dp::Scene& s) { s.node("mover").node_to_parent[5] = 0; }},
        {"cameras[0] 'eye': its nodes' transform leaves no direction",
         [](dp::Scene& s) { s.node("arm").node_to_parent = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1}; }},
        {"has a transform that is not finite",
         [](dp::Scene& s) {
             s.node("root").node_to_parent[0] = 1e200;
             s.node("arm").node_to_parent[0] = 1e200;
         }},
        {"instances[0] 'hand': node is 9", [](dp::Scene& s) { s.instance("hand").node = 9; }},
        {"cameras[0] 'eye': node is -2", [](dp::Scene& s) { s.camera("eye").node = -2; }},
        {"lights[0] 'bulb': node is 9", [](dp::Scene& s) { s.light("bulb").node = 9; }},
    };
    for (const auto& [says, edit] : refusals) {
        INFO(says);
        dp::Scene scene = TreeFile().load();
        dp::Session session(scene, {}, small_settings());
        const std::vector<dp::Node> nodes = scene.nodes();
        const dp::Scene before = scene.copy();
        edit(scene);
        const std::string message = message_of([&] { session.render(1); });
        CHECK(message.find(says) != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
        dp::Scene rest = before;
        scene.nodes() = nodes;
        scene.instances() = rest.instances();
        scene.cameras() = rest.cameras();
        scene.lights() = rest.lights();
        CHECK(same_bits(film_of(session, {}), expected));
    }
}

TEST_CASE("A copy of a scene has nodes of its own, and a name may be edited") {
    dp::Scene scene = TreeFile().load();
    dp::Scene copy = scene.copy();
    copy.node("arm").node_to_parent = turned;
    copy.node("arm").name = "branch";
    see(copy);
    see(scene);
    CHECK(scene.node("arm").node_to_parent != turned);
    CHECK(copy.node("branch").node_to_parent == turned);
    CHECK(copy.instance("hand").object_to_world != scene.instance("hand").object_to_world);
}
