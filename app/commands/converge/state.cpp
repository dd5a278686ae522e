#include "commands/converge/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "commands/converge/plan.h"
#include "error.h"
#include "image/atomic_file.h"

namespace diptych::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint32_t sums_magic = 0x31535444;  // "DTS1"

Json run_to_json(const std::vector<ErrorRow>& run) {
    const ErrorRow& first = run.front();
    Json json = {{"kind", "run"},
                 {"method", first.method},
                 {"run", first.run},
                 {"seed", first.seed},
                 {"checkpoints", Json::array()}};
    for (const ErrorRow& row : run) {
        json["checkpoints"].push_back({{"spp", row.spp},
                                       {"device_seconds", row.device_seconds},
                                       {"wall_seconds", row.wall_seconds},
                                       {"mse", row.mse},
                                       {"relmse", row.relmse},
                                       {"relmse_trimmed", row.relmse_trimmed},
                                       {"trimmed_energy", row.trimmed_energy},
                                       {"nonfinite", row.nonfinite},
                                       {"rays", row.rays}});
    }
    return json;
}

double number(const Json& json, const char* key) {
    const Json& value = json.at(key);
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

void add_run(std::vector<ErrorRow>& rows, const Json& run) {
    for (const Json& json : run.at("checkpoints")) {
        ErrorRow row;
        row.method = run.at("method");
        row.run = run.at("run");
        row.seed = run.at("seed");
        row.spp = json.at("spp");
        row.device_seconds = number(json, "device_seconds");
        row.wall_seconds = number(json, "wall_seconds");
        row.mse = number(json, "mse");
        row.relmse = number(json, "relmse");
        row.relmse_trimmed = number(json, "relmse_trimmed");
        row.trimmed_energy = number(json, "trimmed_energy");
        row.nonfinite = json.at("nonfinite");
        row.rays = json.at("rays");
        rows.push_back(row);
    }
}

template <class T>
void put(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::string& bytes, const std::vector<float>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

template <class T>
bool take(std::ifstream& file, T& value) {
    return static_cast<bool>(file.read(reinterpret_cast<char*>(&value), sizeof value));
}

bool take(std::ifstream& file, std::vector<float>& values, std::uint64_t count) {
    values.resize(count);
    return static_cast<bool>(
        file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(float))));
}

}  // namespace

ConvergeState::ConvergeState(const std::string& folder) : folder_(folder) {
    const std::string name = path("results.jsonl");
    std::ifstream file(name, std::ios::binary);
    if (!file) {
        return;
    }
    std::ostringstream stream;
    stream << file.rdbuf();
    const std::string text = stream.str();
    std::size_t at = 0;
    for (std::size_t end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
        const Json event = Json::parse(text.substr(at, end - at), nullptr, false);
        if (event.is_discarded()) {
            throw Error(fmt::format("{}: has a line that is not JSON; give another -o", name));
        }
        if (event.value("kind", "") == "run") {
            add_run(rows_, event);
        } else {
            events_.push_back(event);
        }
    }
    if (at < text.size()) {
        fs::resize_file(name, at);
    }
}

std::string ConvergeState::path(const std::string& name) const {
    return (fs::path(folder_) / name).string();
}

std::string ConvergeState::sums_path(const std::string& method) const {
    return path(file_stem(method) + ".sums");
}

void ConvergeState::append_text(const std::string& lines) const {
    const std::string name = path("results.jsonl");
    std::FILE* file = std::fopen(name.c_str(), "ab");
    const bool written = file != nullptr && std::fwrite(lines.data(), 1, lines.size(), file) == lines.size();
    const bool closed = file != nullptr && std::fclose(file) == 0;
    if (!written || !closed) {
        throw Error(fmt::format("{}: cannot write: {}", name, std::strerror(errno)));
    }
}

void ConvergeState::append(const Json& event) {
    append_text(event.dump() + "\n");
    events_.push_back(event);
}

void ConvergeState::append(const std::vector<ErrorRow>& run) {
    append_text(run_to_json(run).dump() + "\n");
    rows_.insert(rows_.end(), run.begin(), run.end());
    write_csv();
}

std::uint32_t ConvergeState::runs(const std::string& method) const {
    std::uint32_t runs = 0;
    for (const ErrorRow& row : rows_) {
        runs = row.method == method ? std::max(runs, row.run + 1) : runs;
    }
    return runs;
}

Json ConvergeState::latest(const std::string& kind, const std::string& method) const {
    const auto found = std::find_if(events_.rbegin(), events_.rend(), [&](const Json& event) {
        return event.value("kind", "") == kind && (method.empty() || event.value("method", "") == method);
    });
    return found == events_.rend() ? Json() : *found;
}

void ConvergeState::write_csv() const {
    std::string text =
        "method,run,seed,spp,device_seconds,wall_seconds,mse,relmse,relmse_trimmed,trimmed_energy,nonfinite,rays\n";
    for (const ErrorRow& row : rows_) {
        text += fmt::format("{},{},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{}\n", row.method, row.run,
                            row.seed, row.spp, row.device_seconds, row.wall_seconds, row.mse, row.relmse,
                            row.relmse_trimmed, row.trimmed_energy, row.nonfinite, row.rays);
    }
    write_file_atomically(path("results.csv"), text);
}

std::map<std::uint32_t, DeviationSums> ConvergeState::load_sums(const std::string& method) const {
    const std::string name = sums_path(method);
    std::map<std::uint32_t, DeviationSums> all;
    std::ifstream file(name, std::ios::binary);
    if (!file) {
        return all;
    }
    std::uint32_t magic = 0, checkpoints = 0;
    bool whole = take(file, magic) && magic == sums_magic && take(file, checkpoints);
    for (std::uint32_t i = 0; whole && i < checkpoints; ++i) {
        std::uint32_t spp = 0;
        std::uint64_t values = 0;
        DeviationSums sums;
        whole = take(file, spp) && take(file, sums.runs) && take(file, values) && values < (1ULL << 32U) &&
                take(file, sums.sum, values) && take(file, sums.squares, values) && take(file, sums.largest, values);
        all[spp] = std::move(sums);
    }
    if (!whole) {
        throw Error(fmt::format("{}: is not whole; give another -o", name));
    }
    return all;
}

void ConvergeState::save_sums(const std::string& method, const std::map<std::uint32_t, DeviationSums>& all) const {
    std::string bytes;
    put(bytes, sums_magic);
    put(bytes, static_cast<std::uint32_t>(all.size()));
    for (const auto& [spp, sums] : all) {
        put(bytes, spp);
        put(bytes, sums.runs);
        put(bytes, static_cast<std::uint64_t>(sums.sum.size()));
        put(bytes, sums.sum);
        put(bytes, sums.squares);
        put(bytes, sums.largest);
    }
    write_file_atomically(sums_path(method), bytes);
}

}  // namespace diptych::app
