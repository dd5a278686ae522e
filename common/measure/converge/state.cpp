#include "measure/converge/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "error.h"
#include "image/atomic_file.h"
#include "input_file.h"
#include "measure/converge/checked_file.h"
#include "measure/converge/method.h"

namespace diptych::core {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint32_t sums_magic = 0x32535444;  // "DTS2"

template <class T>
std::optional<T> found_in(const std::map<std::string, T>& all, const std::string& method) {
    const auto found = all.find(method);
    return found == all.end() ? std::nullopt : std::optional(found->second);
}

template <class T>
void put(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void put(std::string& bytes, const std::vector<float>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

}  // namespace

ConvergeState::ConvergeState(const std::string& folder) : folder_(folder) {
    const std::string name = path("results.jsonl");
    if (!fs::exists(name)) {
        return;
    }
    require_input(name);
    std::ifstream file(name, std::ios::binary);
    if (!file) {
        throw Error(fmt::format("{}: cannot read", name));
    }
    std::ostringstream stream;
    stream << file.rdbuf();
    const std::string text = stream.str();
    std::size_t at = 0;
    int line = 1;
    for (std::size_t end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1, ++line) {
        try {
            take(Json::parse(text.substr(at, end - at)));
        } catch (const Json::exception&) {
            throw Error(fmt::format("{}: line {} is damaged; give another `output`", name, line));
        }
    }
    std::error_code failure;
    if (at < text.size()) {
        fs::resize_file(name, at, failure);
    }
    if (failure) {
        throw Error(fmt::format("{}: cannot write: {}", name, failure.message()));
    }
}

void ConvergeState::take(const Json& event) {
    const std::string kind = event.at("kind"), method = event.value("method", "");
    if (kind == "scene") {
        load_seconds_ = event.at("load_seconds");
    } else if (kind == "limit") {
        limits_[method] = event.at("spp_max");
    } else if (kind == "setup") {
        setups_[method] = setup_of(event);
    } else if (kind == "reference") {
        reference_ = rendered_reference_of(event);
    } else if (kind == "run") {
        const std::vector<ErrorRow> run = run_of(event);
        rows_.insert(rows_.end(), run.begin(), run.end());
    } else if (kind == "picture") {
        pictures_[method] = picture_of(event);
    }
}

std::string ConvergeState::path(const std::string& name) const {
    return (fs::path(folder_) / name).string();
}

std::string ConvergeState::sums_path(const std::string& method) const {
    return path(file_stem(method) + ".sums");
}

void ConvergeState::append_line(const std::string& text) const {
    const std::string line = text + "\n";
    const std::string name = path("results.jsonl");
    std::FILE* file = std::fopen(name.c_str(), "ab");
    const bool written = file != nullptr && std::fwrite(line.data(), 1, line.size(), file) == line.size();
    const bool closed = file != nullptr && std::fclose(file) == 0;
    if (!written || !closed) {
        throw Error(fmt::format("{}: cannot write: {}", name, std::strerror(errno)));
    }
}

void ConvergeState::set_load_seconds(double seconds) {
    append_line(Json{{"kind", "scene"}, {"load_seconds", seconds}}.dump());
    load_seconds_ = seconds;
}

void ConvergeState::set_limit(const std::string& method, std::uint32_t spp) {
    append_line(Json{{"kind", "limit"}, {"method", method}, {"spp_max", spp}}.dump());
    limits_[method] = spp;
}

void ConvergeState::set_setup(const std::string& method, const MethodSetup& setup) {
    append_line(to_json(method, setup).dump());
    setups_[method] = setup;
}

void ConvergeState::set_reference(const RenderedReference& reference) {
    append_line(to_json(reference).dump());
    reference_ = reference;
}

void ConvergeState::set_picture(const std::string& method, const MethodPicture& picture) {
    append_line(to_json(method, picture).dump());
    pictures_[method] = picture;
}

void ConvergeState::append(const std::vector<ErrorRow>& run) {
    append_line(to_json(run).dump());
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

std::optional<std::uint32_t> ConvergeState::limit(const std::string& method) const {
    return found_in(limits_, method);
}

std::optional<MethodSetup> ConvergeState::setup(const std::string& method) const {
    return found_in(setups_, method);
}

std::optional<MethodPicture> ConvergeState::picture(const std::string& method) const {
    return found_in(pictures_, method);
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
    const std::optional<std::string> bytes = read_checked_file(name);
    if (!bytes) {
        return all;
    }
    ByteReader file(*bytes);
    std::uint32_t magic = 0, checkpoints = 0;
    bool whole = file.take(magic) && magic == sums_magic && file.take(checkpoints);
    for (std::uint32_t i = 0; whole && i < checkpoints; ++i) {
        std::uint32_t spp = 0;
        std::uint64_t values = 0;
        DeviationSums sums;
        whole = file.take(spp) && file.take(sums.runs) && file.take(values) && file.take(sums.sum, values) &&
                file.take(sums.squares, values) && file.take(sums.largest, values);
        all[spp] = std::move(sums);
    }
    if (!whole || file.left() > 0) {
        fail_as_damaged(name);
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
    write_checked_file(sums_path(method), bytes);
}

}  // namespace diptych::core
