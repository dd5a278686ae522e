// That no shared function is left without a probe.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "catch.h"

namespace diptych::core::tests {
namespace {

const std::filesystem::path source_root = DIPTYCH_SOURCE_DIR;

/// Functions of leaf headers that no probe calls, each with its reason.
const std::map<std::string, std::string> exempt = {};

/// The file without its comments.
std::string read_code(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return std::regex_replace(text.str(), std::regex("//[^\n]*"), "");
}

std::set<std::string> functions_of(const std::string& code) {
    std::set<std::string> names;
    static const std::regex function(R"(\bFN\s+\w+\s+(\w+)\s*\()");
    for (std::sregex_iterator it(code.begin(), code.end(), function), end; it != end; ++it) {
        names.insert((*it)[1]);
    }
    return names;
}

bool is_leaf(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    return path.extension() == ".h" && name.find(".kernel.") == std::string::npos;
}

}  // namespace

TEST_CASE("Every function of the leaf headers is called by a probe, and every probe is listed") {
    if (!std::filesystem::is_directory(source_root / "shared_glsl_cpp")) {
        SKIP_TEST("the sources are not here");
    }
    std::string probes;
    for (const auto& entry : std::filesystem::directory_iterator(source_root / "tests/parity")) {
        if (entry.path().filename().string().starts_with("probe") && entry.path().extension() == ".h") {
            probes += read_code(entry.path());
        }
    }
    std::size_t found = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source_root / "shared_glsl_cpp")) {
        if (!is_leaf(entry.path())) {
            continue;
        }
        for (const std::string& name : functions_of(read_code(entry.path()))) {
            ++found;
            INFO(entry.path().filename().string() << ": " << name);
            const bool called = std::regex_search(probes, std::regex("\\b" + name + "\\("));
            CHECK(called != exempt.contains(name));
        }
    }
    CHECK(found > 100);
    std::set<std::string> listed;
    static const std::regex row(R"(\bX\((\w+), *\d)");
    for (std::sregex_iterator it(probes.begin(), probes.end(), row), end; it != end; ++it) {
        listed.insert("probe_" + (*it)[1].str());
    }
    static const std::regex probe(R"(void\s+(probe_\w+)\(IN\(ProbeInput\))");
    for (std::sregex_iterator it(probes.begin(), probes.end(), probe), end; it != end; ++it) {
        INFO((*it)[1].str());
        CHECK(listed.contains((*it)[1]));
    }
}

}  // namespace diptych::core::tests
