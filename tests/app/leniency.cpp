// Faulty files and near misses as a user meets them: what is printed, and what --strict refuses.
#include <nlohmann/json.hpp>

#include <algorithm>

#include "catch.h"
#include "image/layered_image.h"
#include "process.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

/// One emissive triangle of the plane z = 0, with more members of the root; its material may read textures[0].
std::string write_triangle(const TemporaryFolder& folder, const std::string& nodes, const std::string& more = "") {
    const std::string path = folder.file("triangle.gltf");
    write_text(path, R"({"asset":{"version":"2.0"},"nodes":)" + nodes + more +
                         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"accessors":[
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
{"bufferView":0,"componentType":5126,"count":2,"type":"VEC3"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":8,"byteLength":8}],
"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
    return path;
}

const char* const emissive = R"(,"materials":[{"emissiveFactor":[1,1,1]}])";
const char* const cameras =
    R"(,"cameras":[{"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"znear":0.1,"zfar":9}}])";

/// Clips "walk" and "idle" for node 0.
std::string two_clips() {
    const auto clip = [](const std::string& name) {
        return R"({"name":")" + name + R"(","samplers":[{"input":1,"output":2}],)" +
               R"("channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]})";
    };
    return R"(,"animations":[)" + clip("walk") + "," + clip("idle") + "]";
}

std::size_t times_in(const std::string& part, const std::string& text) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) {
        ++count;
    }
    return count;
}

ProcessResult render_leniently(const TemporaryFolder& folder, const std::string& scene, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"render", scene, "--spp", "1", "--size", "8"};
    if (std::find(more.begin(), more.end(), "-o") == more.end()) {
        more.insert(more.end(), {"-o", folder.file("out.exr")});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_diptych(folder, arguments);
}

}  // namespace

TEST_CASE("a faulty file renders with one warning, and is refused by --strict", "[app]") {
    const TemporaryFolder folder;
    const auto check = [&](const std::string& scene, const std::vector<std::string>& parts) {
        const ProcessResult lenient = render_leniently(folder, scene);
        INFO(lenient.err);
        CHECK(lenient.exit_code == 0);
        for (const std::string& part : parts) {
            CHECK(times_in(part, lenient.err) == 1);
        }
        std::vector<std::string> refusal = parts;
        refusal.push_back(scene);
        check_refusal(render_leniently(folder, scene, {"--strict"}), 2, refusal);
    };
    const std::string camera = R"({"camera":0,"translation":[0,0,2]})";
    const std::string textured = R"(,"materials":[{"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}}])"
                                 R"(,"textures":[{"source":0}],"images":[{"uri":"wood.png"}])";
    check(write_triangle(folder, R"([{"mesh":0},)" + camera + "]", cameras + textured),
          {"images[0] (wood.png)", "no such file"});
    check(write_triangle(folder, R"([{"children":[1]},{"mesh":0},)" + camera + "]",
                         std::string(emissive) + cameras + R"(,"scenes":[{"nodes":[0,1,2]}])"),
          {"nodes[1]: is listed in scenes[0].nodes, but has a parent"});
    const std::string good = write_triangle(folder, R"([{"mesh":0},)" + camera + "]", std::string(emissive) + cameras);
    CHECK(render_leniently(folder, good, {"--strict"}).exit_code == 0);
}

TEST_CASE("info lists the clips, and warnings too as JSON", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = write_triangle(folder, R"([{"mesh":0}])", emissive + two_clips());
    const ProcessResult result = run_diptych(folder, {"info", scene, "--json", "--size", "8"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    REQUIRE(json.at("clips").size() == 2);
    CHECK(json.at("clips")[1].at("index") == 1);
    CHECK(json.at("clips")[1].at("name") == "idle");
    CHECK(json.at("clips")[1].at("seconds") == 1);
    CHECK(json.at("clips")[1].at("channels") == 1);
    const auto warnings = json.at("warnings").get<std::vector<std::string>>();
    CHECK(std::count_if(warnings.begin(), warnings.end(),
                        [](const std::string& line) { return contains(line, "clip 0 'walk'"); }) == 1);
    const ProcessResult text = run_diptych(folder, {"info", scene, "--size", "8"});
    CHECK(contains(text.out, "0   'walk', 1 s, 1 channels"));
    CHECK(contains(text.out, "1   'idle', 1 s, 1 channels"));
}

TEST_CASE("of two clips for one node the first plays with one warning, or the one that is asked for", "[app]") {
    const TemporaryFolder folder;
    const std::string scene =
        write_triangle(folder, R"([{"mesh":0},{"camera":0,"translation":[0,0,2]}])", emissive + two_clips() + cameras);
    const std::string warning = "clip 0 'walk'";
    CHECK(times_in(warning, render_leniently(folder, scene).err) == 0);  // shown at rest
    CHECK(times_in(warning, render_leniently(folder, scene, {"--frames", "2"}).err) == 1);
    for (const std::string clip : {"idle", "1"}) {
        const ProcessResult chosen = render_leniently(folder, scene, {"--frames", "2", "--clip", clip, "--strict", "--overwrite"});
        INFO(chosen.err);
        CHECK(chosen.exit_code == 0);
        CHECK(times_in(warning, chosen.err) == 0);
        CHECK(contains(read_image(folder.file("out.0001.exr")).metadata.at("command"), "--clip " + clip));
    }
    check_refusal(render_leniently(folder, scene, {"--frames", "2", "--strict"}), 2, {scene, warning, "1 'idle' does not play"});
    for (const std::string command : {"render", "verify", "bench", "replay", "converge", "view", "info"}) {
        INFO(command);
        const ProcessResult help = run_diptych(folder, {command, "--help"});
        CHECK(contains(help.out, "--clip"));
        CHECK(contains(help.out, "--strict"));
    }
    check_refusal(render_leniently(folder, scene, {"--clip", "idel"}), 2,
                  {scene, "no clip 'idel'", "did you mean 'idle'?", "0 'walk', 1 'idle'"});
}

TEST_CASE("the camera option takes a name before an index", "[app]") {
    const TemporaryFolder folder;
    const auto scene = [&](const std::string& first, const std::string& second) {
        return write_triangle(folder, R"([{"mesh":0},{"camera":0,"name":")" + first + R"("},{"camera":0,"name":")" +
                                          second + R"("}])",
                              std::string(emissive) + cameras);
    };
    const auto index_of = [&](const std::string& file, const std::string& camera) {
        const ProcessResult result = render_leniently(folder, file, {"--camera", camera});
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        return read_image(folder.file("out.exr")).metadata.at("camera_index");
    };
    CHECK(index_of(scene("left", "right"), "0") == "0");
    CHECK(index_of(scene("left", "right"), "1") == "1");
    CHECK(index_of(scene("left", "0"), "0") == "1");
    check_refusal(render_leniently(folder, scene("left", "right"), {"--camera", "2"}), 2,
                  {"no camera '2'", "0 'left', 1 'right'"});
    check_refusal(render_leniently(folder, scene("left", "right"), {"--camera", "lefd"}), 2, {"did you mean 'left'?"});
    const std::string bare = write_triangle(folder, R"([{"mesh":0}])", emissive);
    CHECK(render_leniently(folder, bare, {"--camera", "0"}).exit_code == 0);  // the one that frames the scene
    check_refusal(render_leniently(folder, bare, {"--camera", "1"}), 2, {"no camera '1'"});
}

TEST_CASE("a camera that the user places is not said to frame the scene", "[app]") {
    const TemporaryFolder folder;
    const std::string bare = write_triangle(folder, R"([{"mesh":0}])", emissive);
    CHECK(contains(render_leniently(folder, bare).err, "a default camera that frames it"));
    CHECK_FALSE(contains(render_leniently(folder, bare, {"--eye", "0,0,3", "--look-at", "0,0,0"}).err, "frames it"));
}

TEST_CASE("a near miss of a file name is suggested", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = write_triangle(folder, R"([{"mesh":0}])", emissive);
    std::filesystem::create_directories(folder.path() / "pictures");
    write_text(folder.file("studio.hdr"), "");
    const auto meant = [&](const char* name) { return "did you mean '" + folder.file(name) + "'?"; };
    check_refusal(render_leniently(folder, folder.file("trangle.gltf")), 2,
                  {"trangle.gltf", "no such file", meant("triangle.gltf")});
    check_refusal(render_leniently(folder, scene, {"--env", folder.file("studoi.hdr")}), 2,
                  {"no such file", meant("studio.hdr")});
    check_refusal(render_leniently(folder, scene, {"-o", folder.file("picturs/out.exr")}), 2,
                  {"does not exist", meant("pictures")});
    REQUIRE(render_leniently(folder, scene).exit_code == 0);
    check_refusal(run_diptych(folder, {"compare", folder.file("out.exr"), folder.file("oud.exr")}), 2,
                  {"no such file", meant("out.exr")});
}
