#include "catch.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "html.h"
#include "image/image_file.h"
#include "process.h"
#include "svg.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

using Json = nlohmann::json;

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> words(1);
    for (const char c : line) {
        if (c == ',') {
            words.emplace_back();
        } else {
            words.back() += c;
        }
    }
    return words;
}

/// Lines of a CSV file as values by column name.
std::vector<std::map<std::string, std::string>> read_csv(const std::string& path) {
    std::istringstream text(file_text(path));
    std::string line;
    std::getline(text, line);
    const std::vector<std::string> names = cells_of(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(text, line)) {
        const std::vector<std::string> values = cells_of(line);
        REQUIRE(values.size() == names.size());
        std::map<std::string, std::string> row;
        for (std::size_t i = 0; i < names.size(); ++i) {
            row[names[i]] = values[i];
        }
        rows.push_back(row);
    }
    return rows;
}

std::vector<std::string> columns_of(const std::string& path) {
    const std::string text = file_text(path);
    return cells_of(text.substr(0, text.find('\n')));
}

/// What a run found, without how long it took.
std::map<std::string, std::string> errors_of(const std::string& csv) {
    std::map<std::string, std::string> errors;
    for (const auto& row : read_csv(csv)) {
        errors[row.at("method") + " " + row.at("run") + " " + row.at("spp")] =
            row.at("mse") + " " + row.at("relmse") + " " + row.at("relmse_trimmed") + " " + row.at("rays");
    }
    return errors;
}

int count_of(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) {
        ++count;
    }
    return count;
}

ProcessResult converge(const TemporaryFolder& folder, const std::string& scene, const std::string& out,
                       std::vector<std::string> more) {
    std::vector<std::string> arguments = {"converge", scene, "-o", folder.file(out)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_diptych(folder, arguments);
}

const std::vector<std::string> small = {"--methods",   "cpu:direct:independent,cpu:path:hammersley",
                                        "--spp-max",   "9",
                                        "--runs",      "4",
                                        "--size",      "20x16",
                                        "--max-depth", "3",
                                        "--json"};

}  // namespace

TEST_CASE("converge measures, plots and writes a page", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const ProcessResult result = converge(folder, scene, "report", small);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const Json json = Json::parse(result.out);
    const auto at = [&](const std::string& name) { return folder.file("report/" + name); };
    const auto rows = read_csv(at("results.csv"));
    CHECK(rows.size() == 2 * 4 * 4);  // methods, runs, 1 2 4 8 samples
    CHECK(columns_of(at("results.csv")) ==
          cells_of("method,run,seed,spp,device_seconds,wall_seconds,mse,relmse,relmse_trimmed,"
                   "trimmed_energy,nonfinite,rays"));
    REQUIRE(json.at("methods").size() == 2);
    for (const Json& method : json.at("methods")) {
        REQUIRE(method.at("checkpoints").size() == 4);
        for (const Json& point : method.at("checkpoints")) {
            double relmse = 0, mse = 0;
            int count = 0;
            for (const auto& row : rows) {
                if (row.at("method") == method.at("method").get<std::string>() &&
                    std::stoi(row.at("spp")) == point.at("spp").get<int>()) {
                    relmse += std::stod(row.at("relmse")) / 4;
                    mse += std::stod(row.at("mse")) / 4;
                    CHECK(std::stod(row.at("device_seconds")) > 0);
                    ++count;
                }
            }
            CHECK(count == 4);
            CHECK(point.at("relmse").at("value").get<double>() == Approx(relmse));
            CHECK(point.at("mse").at("value").get<double>() == Approx(mse));
            CHECK(point.at("relmse").at("low").get<double>() < relmse);
            CHECK(point.at("mse_net").get<double>() == Approx(mse - json.at("reference").at("mse").get<double>()));
            CHECK(point.at("efficiency").get<double>() ==
                  Approx(1 / (point.at("mse_net").get<double>() * point.at("device_seconds").get<double>())));
            CHECK(point.at("nonfinite") == 0);
        }
        CHECK(method.at("slope_mse").at("value").get<double>() < -0.5);
        CHECK(method.at("bias").at("significant") == false);
        CHECK(method.at("setup").at("build_seconds").get<double>() >= 0);
        CHECK(method.at("picture").at("relmse").get<double>() > 0);
    }
    CHECK(json.at("methods")[0].at("sampler") == "independent");
    CHECK(json.at("methods")[1].at("sampler") == "hammersley");
    CHECK(json.at("reference").at("method") == "cpu:path with mis balance");  // `path` itself is measured
    CHECK(json.at("reference").at("spp") == 16 * 8);
    CHECK(json.at("interrupted") == false);
    CHECK(read_csv(at("summary.csv")).size() == 8);
    CHECK(Json::parse(file_text(at("summary.json"))).at("methods") == json.at("methods"));
    CHECK(read_raw(at("pictures/cpu-path-hammersley.png")).image.width == 20);
    CHECK(read_raw(at("reference.exr")).image.height == 16);

    const std::string page = file_text(at("index.html"));
    CHECK(html_fault(page) == "");
    CHECK(page.find("{{") == std::string::npos);
    CHECK(page.find("data:image/png;base64,iVBOR") != std::string::npos);
    CHECK(page.find("src=\"http") == std::string::npos);
    CHECK(Json::parse(html_script(page, "data")).at("methods").size() == 2);
    CHECK(Json::parse(html_script(page, "images")).at("cpu:direct:independent").at("error").is_string());
    check_svg_files(folder, {at("error-time.svg"), at("error-samples.svg")});
    for (const std::string name : {"error-time.svg", "error-samples.svg"}) {
        const std::string svg = file_text(at(name));
        CHECK(count_of(svg, "<circle") == 2 * 4);  // methods, counts of samples
        CHECK(svg.find(">cpu:direct:independent</text>") != std::string::npos);
        CHECK(svg.find(">cpu:path:hammersley</text>") != std::string::npos);
        CHECK(svg.find(">relMSE</text>") != std::string::npos);
    }
    CHECK_FALSE(json.contains("plots"));

    // The page holds its charts without any script: five quantities over three, each in two sizes, one of them shown.
    CHECK(count_of(page, "<figure class=\"chart\"") == 15);
    CHECK(count_of(page, "<figure class=\"chart\" data-what=\"relMSE\" data-over=\"Time\">") == 1);
    CHECK(count_of(page, " hidden>") == 14 + 1);  // and the tip
    CHECK(count_of(page, "<svg ") == 30);
    const std::size_t first = page.find("<svg ");
    write_text(at("first.svg"), page.substr(first, page.find("</svg>", first) + 6 - first));
    check_svg_files(folder, {at("first.svg")});
    CHECK(page.find("<title>cpu:path:hammersley\n8 spp, ") != std::string::npos);
}

TEST_CASE("converge goes on where it was stopped, and finds what it would have found", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> plan = {"--methods", "cpu:path", "--spp-max", "32",    "--runs",
                                           "6",         "--size",   "32",        "--json"};
    REQUIRE(converge(folder, scene, "whole", plan).exit_code == 0);
    std::vector<std::string> arguments = {"converge", scene, "-o", folder.file("stopped")};
    arguments.insert(arguments.end(), plan.begin(), plan.end());
    ProcessResult stopped;
    for (int trial = 0; trial < 5 && stopped.exit_code != 130;
         ++trial) {  // on a busy machine it may end before it hears of it
        std::filesystem::remove_all(folder.file("stopped"));
        Process process(folder, arguments);
        for (int i = 0; i < 6000 && read_csv(folder.file("stopped/results.csv")).empty(); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        process.send(SIGINT);
        stopped = process.finish();
    }
    INFO(stopped.err);
    REQUIRE(stopped.exit_code == 130);
    CHECK(stopped.err.find("the same command goes on") != std::string::npos);
    CHECK(Json::parse(stopped.out).at("interrupted") == true);
    CHECK(html_fault(file_text(folder.file("stopped/index.html"))) == "");
    const std::size_t before = read_csv(folder.file("stopped/results.csv")).size();
    CHECK(before % 6 == 0);  // whole runs
    CHECK(before < 6 * 6);
    // A line cut off by a crash: the sums are a run ahead.
    std::string lines = file_text(folder.file("stopped/results.jsonl"));
    lines.resize(lines.find_last_of('\n', lines.size() - 2) + 1);
    write_text(folder.file("stopped/results.jsonl"), lines + R"({"kind": "err)");
    const ProcessResult resumed = run_diptych(folder, arguments);
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    CHECK(errors_of(folder.file("stopped/results.csv")) == errors_of(folder.file("whole/results.csv")));
    const Json a = Json::parse(file_text(folder.file("stopped/summary.json"))).at("methods")[0];
    const Json b = Json::parse(file_text(folder.file("whole/summary.json"))).at("methods")[0];
    CHECK(a.at("runs") == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(a.at("checkpoints")[i].at("bias_squared") == b.at("checkpoints")[i].at("bias_squared"));
    }
    CHECK(a.at("slope_mse") == b.at("slope_mse"));
    // Done is done: nothing is rendered again.
    const std::string csv = file_text(folder.file("stopped/results.csv"));
    REQUIRE(run_diptych(folder, arguments).exit_code == 0);
    CHECK(file_text(folder.file("stopped/results.csv")) == csv);
}

TEST_CASE("converge tells a bias from noise, and a reference without errors from one with", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto reference = [&](const std::string& name, std::vector<std::string> more) {
        std::vector<std::string> arguments = {"render", scene,   "-o",    folder.file(name),
                                              "--size", "24x24", "--spp", "1024"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        REQUIRE(run_diptych(folder, arguments).exit_code == 0);
        return folder.file(name);
    };
    const auto measured = [&](const std::string& out, const std::string& file) {
        const ProcessResult result = converge(folder, scene, out,
                                              {"--methods", "cpu:path:independent", "--spp-max", "128", "--runs", "8",
                                               "--reference", file, "--max-depth", "2", "--json"});
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        const Json json = Json::parse(result.out);
        CHECK(json.at("width") == 24);  // the reference's, as none is asked for
        return json.at("methods")[0];
    };
    const Json fair = measured("fair", reference("two.exr", {"--max-depth", "2", "--seed", "7"}));
    CHECK(fair.at("bias").at("significant") == false);
    CHECK(fair.at("fit_relmse").at("p").get<double>() > 0.001);
    const Json biased = measured("biased", reference("eight.exr", {"--max-depth", "8", "--seed", "7"}));
    CHECK(biased.at("bias").at("significant") == true);
    CHECK(biased.at("fit_relmse").at("p").get<double>() < 0.01);
    CHECK(biased.at("bias").at("text").get<std::string>().find("not explained") != std::string::npos);
    const Json bare = measured("bare", reference("bare.exr", {"--max-depth", "8", "--no-layers"}));
    CHECK(bare.at("bias").at("text").get<std::string>().find("reference's own noise") != std::string::npos);
}

TEST_CASE("converge fits the samples to the time", "[app][timed]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    bool fits = false;
    for (int trial = 0; trial < 5 && !fits; ++trial) {  // other load on the machine may spoil one
        const ProcessResult result = converge(folder, scene, "timed" + std::to_string(trial),
                                              {"--methods", "cpu:brdf", "--reference", "oracle", "--time", "0.05",
                                               "--runs", "2", "--size", "16", "--max-depth", "2", "--json"});
        INFO(result.err);
        REQUIRE(result.exit_code == 0);
        const Json json = Json::parse(result.out);
        CHECK(json.at("reference").at("method") == "oracle");
        const Json& last = json.at("methods")[0].at("checkpoints").back();
        CHECK(std::has_single_bit(last.at("spp").get<unsigned>()));
        fits = last.at("spp").get<int>() > 4 && last.at("device_seconds").get<double>() < 0.3;
    }
    CHECK(fits);
}

TEST_CASE("converge refuses what it cannot measure, and a folder of other results", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const auto refused = [&](const std::vector<std::string>& more, const std::vector<std::string>& parts) {
        INFO(more[0] << " " << more.back());
        check_refusal(converge(folder, scene, "out", more), 2, parts);
    };
    refused({"--methods", "metal:path"}, {"--methods metal:path", "cpu, vulkan, oracle"});
    refused({"--methods", "cpu"}, {"--methods cpu", "cpu:INTEGRATOR"});
    refused({"--methods", "cpu:bdpt"}, {"--methods cpu:bdpt", "brdf, direct, path"});
    refused({"--methods", "cpu:path:halton"}, {"--methods cpu:path:halton", "independent"});
    refused({"--methods", "oracle:path"}, {"--methods oracle:path", "hemisphere"});
    refused({"--methods", "cpu:path,cpu:path"}, {"cpu:path", "twice"});
    refused({"--methods", "cpu:path", "--device", "0"}, {"--device", "vulkan"});
    refused({"--methods", "cpu:path", "--candidates", "3"}, {"--candidates", "restir"});
    refused({"--reference", "cpu:bdpt"}, {"--reference cpu:bdpt"});
    refused({"--reference", folder.file("no.exr")}, {"no.exr"});
    refused({"--time", "2", "--spp-max", "4"}, {"--time", "--spp-max"});
    refused({"--runs", "1"}, {"--runs"});
    refused({"-o", folder.file("no/such/out")}, {"--output"});
    CHECK_FALSE(std::filesystem::exists(folder.file("out/results.jsonl")));

    const std::vector<std::string> plan = {"--methods", "cpu:path", "--spp-max", "2", "--runs", "2", "--size", "8"};
    REQUIRE(converge(folder, scene, "mine", plan).exit_code == 0);
    const auto changed = [&](const std::string& option, const std::string& value, const std::string& part) {
        std::vector<std::string> other = plan;
        const auto at = std::find(other.begin(), other.end(), option);
        if (at == other.end()) {
            other.insert(other.end(), {option, value});
        } else {
            *(at + 1) = value;
        }
        check_refusal(converge(folder, scene, "mine", other), 2, {"mine", "another plan", part});
    };
    changed("--runs", "3", "runs was 2, is 3");
    changed("--size", "9", "width was 8, is 9");
    changed("--max-depth", "1", "other methods");
    changed("--methods", "cpu:brdf", "other methods");
    changed("--spp-max", "8", "spp_max was 2, is 8");
    // How it is shown may change.
    std::vector<std::string> shown = plan;
    shown.insert(shown.end(), {"--target-relmse", "0.5"});
    CHECK(converge(folder, scene, "mine", shown).exit_code == 0);
}

TEST_CASE("converge draws a scene whose name is no plain text", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = folder.file("a<b>&\"c\".glb");
    std::filesystem::copy(generate_scene(folder, "cornell"), scene);
    const ProcessResult result = converge(
        folder, scene, "out", {"--methods", "cpu:path", "--spp-max", "2", "--runs", "2", "--size", "8", "--json"});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    check_svg_files(folder, {folder.file("out/error-time.svg"), folder.file("out/error-samples.svg")});
    CHECK(file_text(folder.file("out/error-time.svg")).find("a&lt;b&gt;&amp;&quot;c&quot;.glb") != std::string::npos);
    CHECK(html_fault(file_text(folder.file("out/index.html"))) == "");
}

TEST_CASE("two converges in one folder do not measure beside each other", "[app]") {
    const TemporaryFolder folder;
    const std::string scene = generate_scene(folder, "cornell");
    const std::vector<std::string> arguments = {"converge", scene, "--methods", "cpu:path", "--size", "8", "--runs",
                                                "4096", "--spp-max", "4096", "-o", folder.file("out")};
    Process first(folder, arguments);
    for (int wait = 0; wait < 3000 && !std::filesystem::exists(folder.file("out/results.jsonl")); ++wait) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    check_refusal(run_diptych(folder, arguments), 2, {folder.file("out"), "another converge"});
    first.send(SIGTERM);
    CHECK(first.finish().exit_code == 128 + SIGTERM);
    Process again(folder, arguments);  // the lock went with its process
    CHECK_FALSE(again.wait_for_error_text("another converge", 0.5));
}
