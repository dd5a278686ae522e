// What a glTF file may make the program do: read other files, allocate memory, and take time.
#include <algorithm>
#include <ctime>
#include <sys/stat.h>

#include "catch.h"
#include "error.h"
#include "gltf/import.h"
#include "gltf_fixture.h"
#include "memory_budget.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::string limit_refusal(const std::filesystem::path& file, const GltfOptions& options = {}) {
    try {
        load_gltf(file, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "(was loaded)";
}

/// A triangle whose buffer lies in another file.
std::string triangle_in(const std::string& uri) {
    return R"({"asset":{"version":"2.0"},)" + one_mesh(R"("attributes":{"POSITION":0})") +
           R"(,"buffers":[{"byteLength":36,"uri":")" + uri +
           R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,)"
           R"("type":"VEC3","count":3}]})";
}

std::string textured_by(const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"images":[{"uri":")" + uri +
           R"("}],"textures":[{"source":0}],"materials":[{"emissiveTexture":{"index":0}}]})";
}

/// CPU seconds of this process, so that other load on the machine does not count.
double seconds_to_load(const std::filesystem::path& file) {
    const std::clock_t start = std::clock();
    load_gltf(file);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_CASE("links out of the scene's folder need leave, and links within it do not", "[gltf]") {
    const TemporaryFolder folder;
    const std::string bytes = raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
    std::filesystem::create_directories(folder / "scenes/buffers");
    folder.write("out.bin", bytes);
    folder.write("scenes/buffers/in.bin", bytes);
    std::filesystem::create_symlink("../out.bin", folder / "scenes/link.bin");
    std::filesystem::create_symlink("..", folder / "scenes/up");
    std::filesystem::create_symlink("buffers/in.bin", folder / "scenes/inner.bin");
    GltfOptions external;
    external.allow_external = true;
    for (const char* uri : {"link.bin", "up/out.bin"}) {
        INFO(uri);
        const auto scene = folder.write("scenes/scene.gltf", triangle_in(uri));
        CHECK_THAT(limit_refusal(scene), Catch::Contains("buffers[0].uri") && Catch::Contains("`allow_external`"));
        CHECK(load_gltf(scene, external).instances.size() == 1);
    }
    CHECK(load_gltf(folder.write("scenes/scene.gltf", triangle_in("inner.bin"))).instances.size() == 1);
    std::filesystem::create_symlink("scenes/scene.gltf", folder / "scene.gltf");
    CHECK_THAT(limit_refusal(folder / "scene.gltf"), Catch::Contains("inner.bin': no such file"));
    std::filesystem::create_directory_symlink("scenes", folder / "same");
    CHECK(load_gltf(folder / "same/scene.gltf").instances.size() == 1);
}

TEST_CASE("an image outside the folder, or one that is no file, is refused and not drawn as a checker", "[gltf]") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "scenes");
    folder.write("out.png", "x");
    REQUIRE(mkfifo((folder / "scenes/pipe.png").c_str(), 0600) == 0);
    CHECK_THAT(limit_refusal(folder.write("scenes/a.gltf", textured_by("../out.png"))),
               Catch::Contains("images[0] (../out.png).uri") && Catch::Contains("`allow_external`"));
    CHECK_THAT(limit_refusal(folder.write("scenes/a.gltf", textured_by("pipe.png"))),
               Catch::Contains("images[0] (pipe.png).uri") && Catch::Contains("a device or a pipe"));
    CHECK_THAT(limit_refusal(folder.write("scenes/a.gltf", textured_by("."))), Catch::Contains("it is a folder"));
}

TEST_CASE("pipes are refused before they are read, as scenes and as buffers", "[gltf]") {
    const TemporaryFolder folder;
    REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
    CHECK_THAT(limit_refusal(folder / "pipe"), Catch::Contains("pipe: it is a device or a pipe"));
    CHECK_THAT(limit_refusal(folder.write("a.gltf", triangle_in("pipe"))),
               Catch::Contains("'pipe': it is a device or a pipe"));
}

TEST_CASE("a file asks for no more memory than it may", "[gltf]") {
    const TemporaryFolder folder;
    GltfOptions tight;
    tight.memory_limit = 100000;
    const auto refused = [&](const std::string& text, const std::string& object) {
        INFO(object);
        const auto file = folder.write("a.gltf", text);
        CHECK_THAT(limit_refusal(file, tight), Catch::Contains("a.gltf: " + object + ": ") &&
                                                   Catch::Contains(" asks for ") &&
                                                   Catch::Contains("a file may ask for 97.7 KB (`memory_limit`)"));
        CHECK_NOTHROW(load_gltf(file));
    };
    std::filesystem::resize_file(folder.write("zeros.bin", ""), 200000);
    refused(triangle_in("zeros.bin"), "buffers[0].uri");
    GltfBuilder implied;
    implied.accessor_of("", 5126, "VEC3", 30000);
    refused(implied.text(one_mesh(R"("attributes":{"POSITION":0})")),
            "meshes[0] (m).primitives[0].attributes.POSITION");
    // Many primitives may read one accessor, and each has vertices of its own.
    GltfBuilder repeated;
    repeated.accessor_of("", 5126, "VEC3", 3000);
    std::string primitives;
    for (int i = 0; i < 8; ++i) {
        primitives += std::string(i > 0 ? "," : "") + R"({"attributes":{"POSITION":0}})";
    }
    refused(repeated.text(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + primitives + "]}]"),
            "meshes[0].primitives[2].attributes.POSITION");
}

TEST_CASE("an image is counted before it is decoded", "[gltf]") {
    // A PNG of 4096x4096 pixels without data: its header alone says what decoding would take.
    const std::string head("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x10\0\0\0\x10\0\x08\x02\0\0\0\x7d\xc1\xb3\x40", 33);
    const std::string data("\0\0\0\0IDAT\x35\xaf\x06\x1e\0\0\0\0IEND\xae\x42\x60\x82", 24);
    const TemporaryFolder folder;
    GltfOptions tight;
    tight.memory_limit = std::uint64_t{64} << 20;
    const auto file = folder.write("a.gltf", textured_by("data:image/png;base64," + to_base64(head + data)));
    CHECK_THAT(limit_refusal(file, tight), Catch::Contains("a.gltf: images[0]: asks for 112.0 MB") &&
                                               Catch::Contains("a file may ask for 64.0 MB (`memory_limit`)"));
}

TEST_CASE("amounts of memory are read and written", "[memory]") {
    CHECK(memory_from_text("500M") == std::uint64_t{500} << 20);
    CHECK(memory_from_text("2G") == std::uint64_t{2} << 30);
    CHECK(memory_from_text("0010K") == 10240);
    CHECK(memory_from_text("1") == 1);
    for (const char* text : {"", "0", "G", "2g", "2GB", "-1", "1.5G", "99999999999T", "99999999999999999999", " 1"}) {
        INFO(text);
        CHECK_THROWS_WITH(memory_from_text(text), Catch::Contains("is no amount of memory"));
    }
    CHECK(memory_text(1000) == "1000 bytes");
    CHECK(memory_text(std::uint64_t{3} << 29) == "1.5 GB");
    CHECK(default_memory_limit() > std::uint64_t{1} << 28);
    MemoryBudget budget(100);
    budget.ask(60);
    CHECK_THROWS_AS(budget.ask(~std::uint64_t{0}), OverBudget);  // and the sum does not wrap around
    CHECK_THROWS_AS(budget.ask(1), OverBudget);
}

TEST_CASE("the time to read nodes grows with their number", "[gltf]") {
    const TemporaryFolder folder;
    // Half of the nodes form a chain, and the scene lists the others, which hang at its end.
    const auto written = [&](int count) {
        std::string nodes, listed, leaves;
        const int chain = count / 2;
        for (int i = 0; i + 1 < chain; ++i) {
            nodes += R"({"children":[)" + std::to_string(i + 1) + "]},";
        }
        for (int i = chain; i < count; ++i) {
            leaves += std::string(i > chain ? "," : "") + std::to_string(i);
        }
        nodes += R"({"children":[)" + leaves + "]}";
        for (int i = chain; i < count; ++i) {
            nodes += ",{}";
        }
        return folder.write(std::to_string(count) + ".gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[)" + leaves +
                                                                 R"(]}],"nodes":[)" + nodes + "]}");
    };
    const auto few = written(10000), many = written(80000);
    double of_few = 1e9;
    for (int i = 0; i < 3; ++i) {
        of_few = std::min(of_few, seconds_to_load(few));
    }
    // Eight times as many nodes take eight times as long, and would take 64 times as long where each node looked at all
    // others.
    CHECK(seconds_to_load(many) < 24 * of_few);
}
