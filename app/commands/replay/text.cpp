#include "commands/replay/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "measure/replay_rows.h"

namespace diptych::core::app {

namespace {

using shared::NONE;
using shared::PathVertexRecord;

constexpr int label_width = 17;
constexpr int column_width = 38;

std::string line(const ReplayRow& row) {
    std::string text = fmt::format("  {:<{}}", row.label, label_width + 2);
    for (const std::string& cell : row.cells) {
        text += fmt::format(" {:<{}}", cell, column_width);
    }
    text += row.difference;
    text += row.marked ? "  <- they part" : "";
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
}

bool is_miss(const PathVertexRecord& v) {
    return v.instance == NONE;
}

nlohmann::ordered_json vector_json(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

nlohmann::ordered_json vertex_json(const PathVertexRecord& v, const glm::dvec3& origin,
                                   const shared::RenderConstants& constants) {
    nlohmann::ordered_json json;
    json["direction"] = vector_json(v.direction);
    json["miss"] = is_miss(v);
    if (!is_miss(v)) {
        json["instance"] = v.instance;
        json["geometry"] = v.geometry;
        json["primitive"] = v.primitive;
        json["barycentrics"] = {v.barycentrics.x, v.barycentrics.y};
        json["t"] = v.t;
        json["position"] = vector_json(glm::dvec3(v.position) + origin);
        json["normal"] = vector_json(v.normal);
    }
    json["emission"] = vector_json(v.emission);
    json["emission_weight"] = v.emission_weight;
    json["light"] = v.light == NONE ? nlohmann::ordered_json() : nlohmann::ordered_json(v.light);
    json["light_kind"] = light_text(v.light, &constants);
    json["light_pdf"] = v.light_pdf;
    json["direct"] = vector_json(v.direct);
    json["shadow"] = shadow_text(v.shadow);
    json["lobe"] = lobe_text(v.lobe);
    json["bsdf_pdf"] = v.bsdf_pdf;
    static constexpr const char* roulette[] = {"not played", "survived", "killed"};
    json["roulette"] = roulette[std::min(v.roulette, 2U)];
    json["survival"] = v.survival;
    json["throughput"] = vector_json(v.throughput);
    return json;
}

}  // namespace

std::string replay_text(const Replay& replay, const shared::RenderConstants& constants) {
    ReplayRow head{
        .label = "", .cells = {}, .difference = replay.paths.size() > 1 ? "difference" : "", .marked = false};
    for (std::size_t i = 0; i < replay.paths.size(); ++i) {
        const std::string text = replay.backends[i] + ": " + replay.devices[i];
        head.cells.push_back(text.size() < column_width ? text : text.substr(0, column_width - 2) + "…");
    }
    std::string text = line(head);
    for (const ReplayGroup& group : replay_groups(replay, &constants)) {
        text += group.title + "\n";
        for (const ReplayRow& row : group.rows) {
            text += line(row);
        }
    }
    return text;
}

nlohmann::ordered_json replay_json(const Replay& replay, const shared::RenderConstants& constants) {
    nlohmann::ordered_json json;
    json["paths"] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < replay.paths.size(); ++i) {
        nlohmann::ordered_json path;
        path["backend"] = replay.backends[i];
        path["device"] = replay.devices[i];
        path["radiance"] = vector_json(replay.paths[i].radiance);
        path["vertices"] = nlohmann::ordered_json::array();
        for (const PathVertexRecord& vertex : replay.paths[i].vertices) {
            path["vertices"].push_back(vertex_json(vertex, replay.origin, constants));
        }
        json["paths"].push_back(std::move(path));
    }
    json["tolerance"] = replay.tolerance;
    json["parting"] = nlohmann::ordered_json();
    if (replay.parting) {
        json["parting"] = {{"vertex", replay.parting->vertex},
                           {"field", name_of(replay.parting->field)},
                           {"difference", replay.parting->difference}};
    }
    return json;
}

}  // namespace diptych::core::app
