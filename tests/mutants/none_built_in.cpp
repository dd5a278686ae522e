// Nothing but this folder's own test is compiled with a mutant inside, unless that was asked for.
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "catch.h"

TEST_CASE("No source of the program is compiled with a mutant inside") {
#if defined(DIPTYCH_MUTANT)
    SKIP_TEST("this build was asked for mutants");
#endif
    std::ifstream file(std::filesystem::path(DIPTYCH_PROGRAM).parent_path() / "compile_commands.json");
    std::size_t sources = 0;
    for (const auto& entry : nlohmann::json::parse(file)) {
        const auto command = entry.at("command").get<std::string>();
        INFO(command);
        CHECK(command.find("-DDIPTYCH_MUTANT") == std::string::npos);
        ++sources;
    }
    CHECK(sources > 50);
}
