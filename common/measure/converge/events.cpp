#include "measure/converge/events.h"

#include <limits>
#include <nlohmann/json.hpp>

namespace diptych::core {

namespace {

using Json = nlohmann::ordered_json;

double number(const Json& json, const char* key) {
    const Json& value = json.at(key);
    return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

}  // namespace

Json to_json(const std::vector<ErrorRow>& run) {
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

std::vector<ErrorRow> run_of(const Json& event) {
    std::vector<ErrorRow> rows;
    for (const Json& json : event.at("checkpoints")) {
        ErrorRow row;
        row.method = event.at("method");
        row.run = event.at("run");
        row.seed = event.at("seed");
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
    return rows;
}

Json to_json(const std::string& method, const MethodSetup& setup) {
    return {{"kind", "setup"},
            {"method", method},
            {"device", setup.device},
            {"pack_seconds", setup.pack_seconds},
            {"build_seconds", setup.build_seconds},
            {"compile_seconds", setup.compile_seconds},
            {"bytes", setup.bytes}};
}

MethodSetup setup_of(const Json& json) {
    return {json.at("device"), number(json, "pack_seconds"), number(json, "build_seconds"),
            number(json, "compile_seconds"), json.at("bytes")};
}

Json to_json(const std::string& method, const MethodPicture& picture) {
    return {{"kind", "picture"},
            {"method", method},
            {"wanted_seconds", picture.wanted_seconds},
            {"spp", picture.spp},
            {"device_seconds", picture.device_seconds},
            {"relmse", picture.relmse},
            {"command", picture.command}};
}

MethodPicture picture_of(const Json& json) {
    return {number(json, "wanted_seconds"), json.at("spp"), number(json, "device_seconds"), number(json, "relmse"),
            json.at("command")};
}

Json to_json(const RenderedReference& reference) {
    return {{"kind", "reference"},
            {"method", reference.method},
            {"device", reference.device},
            {"spp", reference.spp},
            {"blocks", reference.blocks},
            {"device_seconds", reference.device_seconds}};
}

RenderedReference rendered_reference_of(const Json& json) {
    return {json.at("method"), json.at("device"), json.at("spp"), json.at("blocks"), number(json, "device_seconds")};
}

}  // namespace diptych::core
