// The oracle shares nothing with what it judges: the build says so.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "catch.h"

namespace diptych::core::tests {

namespace {

namespace fs = std::filesystem;

const fs::path source_root = DIPTYCH_SOURCE_DIR;

/// What an oracle's source must not see.
const std::vector<std::string>& forbidden() {
    static const std::vector<std::string> folders = {"shared_glsl_cpp", "common/pack",     "common/render",
                                                     "common/image",    "cpu_ref/backend", "cpu_ref/embree",
                                                     "vk_backend"};
    return folders;
}

std::string read(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

struct Source {
    fs::path file;
    fs::path folder;  // where the command runs
    std::string command;
};

std::vector<Source> oracle_sources() {
    std::vector<Source> sources;
    for (const auto& entry :
         nlohmann::json::parse(read(fs::path(DIPTYCH_PROGRAM).parent_path() / "compile_commands.json"))) {
        const fs::path file = entry.at("file").get<std::string>();
        if (file.parent_path() == source_root / "cpu_ref/oracle") {
            sources.push_back({file, entry.at("directory").get<std::string>(), entry.at("command").get<std::string>()});
        }
    }
    return sources;
}

std::string output_of(const std::string& command) {
    std::string output;
    std::array<char, 4096> buffer{};
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    REQUIRE(pipe);
    while (fgets(buffer.data(), int(buffer.size()), pipe.get()) != nullptr) {
        output += buffer.data();
    }
    return output;
}

}  // namespace

TEST_CASE("no oracle source has an include path to the shared headers", "[oracle]") {
    const std::vector<Source> sources = oracle_sources();
    std::size_t written = 0;
    for (const auto& entry : fs::directory_iterator(source_root / "cpu_ref/oracle")) {
        written += entry.path().extension() == ".cpp" ? 1 : 0;
    }
    REQUIRE(sources.size() == written);
    for (const Source& source : sources) {
        INFO(source.command);
        CHECK(source.command.find("shared_glsl_cpp") == std::string::npos);
        CHECK(source.command.find("cpu_ref") != std::string::npos);
    }
}

TEST_CASE("no oracle source or header names what it must not see", "[oracle]") {
    const std::regex include("#\\s*include\\s*\"([^\"]*)\"");
    std::size_t includes = 0;
    for (const auto& entry : fs::directory_iterator(source_root / "cpu_ref/oracle")) {
        const std::string text = read(entry.path());
        for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) {
            const std::string name = (*i)[1];
            INFO(entry.path() << " includes " << name);
            const bool own = name.rfind("oracle/", 0) == 0 && fs::exists(source_root / "cpu_ref" / name);
            // The last knows threads, and nothing of light.
            CHECK((own || name == "scene/scene.h" || name == "error.h" || name == "parallel.h"));
            ++includes;
        }
    }
    CHECK(includes > 20);
}

TEST_CASE("the compiler reads nothing forbidden for any oracle source", "[oracle]") {
    std::string seen;
    for (const Source& source : oracle_sources()) {
        const std::string command = std::regex_replace(source.command, std::regex(" -o \\S+ -c "), " -MM ");
        REQUIRE(command != source.command);
        const std::string files = output_of("cd '" + source.folder.string() + "' && " + command);
        INFO(files);
        REQUIRE(files.find(source.file.string()) != std::string::npos);
        seen += files;
        for (const std::string& folder : forbidden()) {
            CHECK(files.find((source_root / folder).string()) == std::string::npos);
        }
    }
    CHECK(seen.find((source_root / "common/scene/scene.h").string()) != std::string::npos);
}

}  // namespace diptych::core::tests
