// What the import refuses, and how it says so; where files may lie.
#include "catch.h"
#include "error.h"
#include "gltf_fixture.h"
#include "gltf/import.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::string refusal(const std::filesystem::path& file) {
    try {
        load_gltf(file);
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK(message.find('\n') == std::string::npos);
        CHECK(message.rfind(file.string() + ": ", 0) == 0);
        return message;
    }
    return "(was loaded)";
}

std::string refusal_of(const std::string& text) {
    const TemporaryFolder folder;
    return refusal(folder.write("scene.gltf", text));
}

std::string root(const std::string& members) {
    return R"({"asset":{"version":"2.0"},)" + members + "}";
}

std::string with_position(int accessor) {
    return one_mesh(R"("attributes":{"POSITION":)" + std::to_string(accessor) + "}");
}

}  // namespace

TEST_CASE("files that are not there, or not glTF, are refused", "[gltf]") {
    const TemporaryFolder folder;
    CHECK_THAT(refusal(folder.path() / "missing.gltf"), Catch::Contains("no such file"));
    CHECK_THAT(refusal(folder.path()), Catch::Contains("is a folder"));
    CHECK_THAT(refusal(folder.write("empty.glb", "")), Catch::Contains("empty"));
    CHECK_THAT(refusal(folder.write("text.gltf", "not json")), Catch::Contains("JSON"));
    CHECK_THAT(refusal(folder.write("array.gltf", "[1, 2, 3, 4]")), Catch::Contains("root is not an object"));
    CHECK_THAT(refusal(folder.write("one.gltf", R"({"asset":{"version":"1.0"}})")), Catch::Contains("asset.version"));
    CHECK_THAT(refusal(folder.write("cut.glb", "glTF\x02")), Catch::Contains("shorter than its header"));
    const std::string deep(100000, '[');
    CHECK_THAT(refusal(folder.write("deep.gltf", R"({"extras":)" + deep)), Catch::Contains("nested deeper"));
}

TEST_CASE("extensions: required ones that are lacking are named, used ones are warned of once", "[gltf]") {
    CHECK_THAT(
        refusal_of(root(
            R"("extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":["KHR_draco_mesh_compression"])")),
        Catch::Contains("extensionsRequired") && Catch::Contains("KHR_draco_mesh_compression"));
    const TemporaryFolder folder;
    const Scene scene =
        load_gltf(folder.write("used.gltf", root(R"("extensionsUsed":["A_thing","A_thing","KHR_materials_ior"])")));
    REQUIRE(scene.warnings.size() == 2);
    CHECK_THAT(scene.warnings.lines()[0], Catch::Contains("A_thing"));
    CHECK_THAT(scene.warnings.lines()[1], Catch::Contains("no triangles"));
}

TEST_CASE("a required extension that is lacking can be ignored by name, and only by name", "[gltf]") {
    const TemporaryFolder folder;
    const auto file = folder.write(
        "two.gltf", root(R"("extensionsUsed":["A_thing","B_thing"],"extensionsRequired":["A_thing","B_thing"])"));
    CHECK_THAT(refusal(file), Catch::Contains("A_thing") && Catch::Contains("`ignored_extensions` A_thing"));
    try {
        load_gltf(file, {{"A_thing"}});
        FAIL("was loaded");
    } catch (const Error& error) {
        CHECK_THAT(error.what(), Catch::Contains("needs B_thing"));
    }
    const Scene scene = load_gltf(file, {{"A_thing", "B_thing", "C_thing"}});
    REQUIRE(scene.warnings.size() == 4);
    CHECK_THAT(scene.warnings.lines()[0], Catch::Contains("A_thing is ignored"));
    CHECK_THAT(scene.warnings.lines()[1], Catch::Contains("B_thing is ignored"));
    CHECK_THAT(scene.warnings.lines()[2], Catch::Contains("no C_thing to ignore"));
    CHECK_THAT(scene.warnings.lines()[3], Catch::Contains("no triangles"));
}

TEST_CASE("data outside its buffer is refused, and the message says where", "[gltf]") {
    GltfBuilder builder;
    const int points = builder.triangle();
    const int too_long = builder.accessor_of(R"("bufferView":0)", 5126, "VEC3", 4);
    const int shifted = builder.accessor_of(R"("bufferView":0,"byteOffset":4)", 5126, "VEC3", 3);
    const int huge = builder.accessor_of(R"("bufferView":0,"byteOffset":18446744073709551600)", 5126, "VEC3", 3);
    const int no_view = builder.accessor_of(R"("bufferView":77)", 5126, "VEC3", 3);
    const int indices = builder.accessor(raw<std::uint16_t>({0, 1, 3}), 5123, "SCALAR", 3);
    const int pairs = builder.floats({0, 0, 0, 0, 0, 0}, "VEC2", 3);
    const int implied = builder.accessor_of("", 5126, "VEC3", 2000000000);
    for (const int bad : {too_long, shifted, huge}) {
        CHECK_THAT(refusal_of(builder.text(with_position(bad))),
                   Catch::Contains("meshes[0] (m).primitives[0].attributes.POSITION") &&
                       Catch::Contains("end past bufferViews[0]"));
    }
    CHECK_THAT(refusal_of(builder.text(with_position(no_view))), Catch::Contains("bufferViews[77]"));
    CHECK_THAT(refusal_of(builder.text(with_position(1234))), Catch::Contains("accessors[1234]"));
    CHECK_THAT(refusal_of(builder.text(with_position(pairs))), Catch::Contains("2 components where 3"));
    CHECK_THAT(refusal_of(builder.text(with_position(implied))), Catch::Contains("no buffer view"));
    CHECK_THAT(refusal_of(builder.text(one_mesh(R"("attributes":{"POSITION":)" + std::to_string(points) +
                                                R"(},"indices":)" + std::to_string(indices)))),
               Catch::Contains("primitives[0].indices: index 3 at 2") && Catch::Contains("3 vertices"));
    CHECK_THAT(refusal_of(builder.text(one_mesh(R"("attributes":{"POSITION":)" + std::to_string(points) +
                                                R"(,"NORMAL":)" + std::to_string(points) + R"(},"material":5)"))),
               Catch::Contains("materials[5]"));
}

TEST_CASE("buffers that are missing or too short are refused", "[gltf]") {
    CHECK_THAT(refusal_of(root(R"("buffers":[{"byteLength":4,"uri":"gone.bin"}])")),
               Catch::Contains("buffers[0].uri") && Catch::Contains("gone.bin") && Catch::Contains("no such file"));
    CHECK_THAT(refusal_of(root(R"("buffers":[{"byteLength":4,"uri":"data:;base64,AAAA"}])")),
               Catch::Contains("buffers[0]: byteLength is 4, but there are 3"));
    CHECK_THAT(refusal_of(root(R"("buffers":[{"byteLength":4,"uri":"data:;base64,A*AA"}])")),
               Catch::Contains("base64"));
}

TEST_CASE("node hierarchies that are no trees are refused", "[gltf]") {
    CHECK_THAT(refusal_of(root(R"("nodes":[{"children":[1]},{"children":[0]}])")), Catch::Contains("own ancestor"));
    CHECK_THAT(refusal_of(root(R"("nodes":[{"children":[2]},{"children":[2]},{}])")), Catch::Contains("two parents"));
    CHECK_THAT(refusal_of(root(R"("nodes":[{"children":[9]}])")), Catch::Contains("nodes[9]"));
    CHECK_THAT(refusal_of(root(R"("nodes":[{"mesh":0}])")), Catch::Contains("meshes[0]"));
    std::string giants;
    for (int i = 0; i < 9; ++i) {
        giants += R"({"scale":[1e38,1,1],"children":[)" + std::to_string(i + 1) + "]},";
    }
    CHECK_THAT(refusal_of(root(R"("nodes":[)" + giants + "{}]")),
               Catch::Contains("nodes[8]") && Catch::Contains("not finite"));
    CHECK_THAT(refusal_of(root(
                   R"("nodes":[{"camera":0}],"cameras":[{"type":"perspective","perspective":{"yfov":4,"znear":1}}])")),
               Catch::Contains("cameras[0].perspective.yfov"));
}

TEST_CASE("a chain of many nodes does not exhaust the stack", "[gltf]") {
    std::string nodes;
    const int count = 100000;
    for (int i = 0; i < count; ++i) {
        nodes += i + 1 < count ? R"({"children":[)" + std::to_string(i + 1) + "]}," : "{}";
    }
    const TemporaryFolder folder;
    CHECK_NOTHROW(load_gltf(folder.write("chain.gltf", root(R"("nodes":[)" + nodes + "]"))));
}

TEST_CASE("files are found by names with spaces, escapes and UTF-8", "[gltf]") {
    const TemporaryFolder folder;
    const std::string bytes = raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
    folder.write("a b.bin", bytes);
    folder.write("ü%20.bin", bytes);
    for (const char* uri : {"a b.bin", "a%20b.bin", "ü%2520.bin", "%C3%BC%2520.bin", "./a%20b.bin"}) {
        INFO(uri);
        const Scene scene = load_gltf(folder.write(
            "sc ene ü.gltf",
            root(one_mesh(R"("attributes":{"POSITION":0})") + R"(,"buffers":[{"byteLength":36,"uri":")" + uri +
                 R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
                 R"("componentType":5126,"type":"VEC3","count":3}])")));
        CHECK(scene.instances.size() == 1);
    }
}

TEST_CASE("an image that is missing or broken matters only where it is used", "[gltf]") {
    const std::string images = R"("textures":[{"source":0}],"images":[{"uri":"gone.png"}])";
    const TemporaryFolder folder;
    const Scene scene =
        load_gltf(folder.write("occluded.gltf", root(images + R"(,"materials":[{"occlusionTexture":{"index":0}}])")));
    CHECK(scene.images.empty());
    CHECK(scene.warnings.size() == 1);  // that there are no triangles
}

TEST_CASE("whole numbers may be written with a point", "[gltf]") {
    GltfBuilder builder;
    builder.triangle();
    const std::string mesh =
        R"("nodes":[{"mesh":0.0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0.0},"mode":4.0}]}])";
    const TemporaryFolder folder;
    CHECK(load_gltf(folder.write("points.gltf", builder.text(mesh))).instances.size() == 1);
}

TEST_CASE("the found files with members of a wrong type are refused", "[gltf]") {
    const std::filesystem::path folder = asset_folder() / "found/broken";
    if (!std::filesystem::exists(folder)) {
        SKIP_TEST("no assets at " + asset_folder().string());
    }
    for (const char* name : {"accoff-neg", "boff-float", "bv-2^32", "mode-float", "pos-2^32", "stride-neg",
                             "translation-1e300", "trs-str", "ty-lightstr", "ty-matstr", "ty-rotnan", "ty-roughstr",
                             "ty-tex-1", "ty-trs", "ty-weights"}) {
        INFO(name);
        CHECK_THAT(refusal(folder / (std::string(name) + ".gltf")), Catch::Contains(".gltf: /"));
    }
    CHECK_THAT(refusal(folder / "implied.gltf"), Catch::Contains("67108864 elements"));
    CHECK_THAT(refusal(folder / "uri-dotdot.gltf"), Catch::Contains("leads out of the file's folder"));
    CHECK_THAT(refusal(folder / "uri-absolute.gltf"), Catch::Contains("leads out of the file's folder"));
    CHECK_THAT(refusal(folder / "uri-dev-zero.gltf"), Catch::Contains("/dev/zero"));
}

TEST_CASE("files outside the scene's folder are read only where that is allowed, and devices never", "[gltf]") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path() / "scenes/deep");
    folder.write("out.bin", raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    folder.write("scenes/in.bin", raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    const auto scene = [&](const std::string& uri) {
        const std::string mesh = one_mesh(R"("attributes":{"POSITION":0})");
        return folder.write("scenes/scene.gltf",
                            root(mesh + R"(,"buffers":[{"byteLength":36,"uri":")" + uri +
                                 R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
                                 R"("componentType":5126,"type":"VEC3","count":3}])"));
    };
    CHECK_NOTHROW(load_gltf(scene("deep/../in.bin")));
    GltfOptions external;
    external.allow_external = true;
    const std::string absolute = (folder.path() / "out.bin").string();
    const std::vector<std::string> uris = {"../out.bin", "deep/../../out.bin", "%2E%2E/out.bin", absolute};
    for (const std::string& uri : uris) {
        INFO(uri);
        CHECK_THAT(refusal(scene(uri)), Catch::Contains("buffers[0].uri") && Catch::Contains("`allow_external`"));
        CHECK_NOTHROW(load_gltf(scene(uri), external));
    }
    CHECK_THROWS_WITH(load_gltf(scene("/dev/zero"), external), Catch::Contains("is a device or a pipe"));
    CHECK_THROWS_WITH(load_gltf("/dev/zero"), Catch::Contains("is a device or a pipe"));
}
