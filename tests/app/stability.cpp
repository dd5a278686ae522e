#include <algorithm>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "svg.h"

using namespace diptych::core::tests;

TEST_CASE("stability writes its tables, and a chart of each case that has a range", "[app]") {
    const TemporaryFolder folder;
    const ProcessResult result = run_diptych(folder, {"stability", "--quick", "--backends", "cpu", "--rows", "GGX D",
                                                      "-o", folder.file("out"), "--json"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const auto json = nlohmann::json::parse(result.out);
    std::vector<std::string> charts;
    for (const std::string path : json.at("files")) {
        if (path.substr(path.size() - 4) == ".svg") {
            charts.push_back(path);
        }
    }
    const auto ranged = [](const nlohmann::json& c) { return c.at("backends")[0].at("points").size() > 1; };
    REQUIRE(charts.size() ==
            static_cast<std::size_t>(std::count_if(json.at("cases").begin(), json.at("cases").end(), ranged)));
    REQUIRE_FALSE(charts.empty());
    check_svg_files(folder, charts);
    const std::string svg = file_text(charts[0]);
    CHECK(svg.find(">GGX D: ") != std::string::npos);
    CHECK(svg.find(">cpu (") != std::string::npos);
    CHECK(svg.find(">bound ") != std::string::npos);
}
