#include "replay_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace diptych::app {

namespace {

using shared::NONE;
using shared::PathVertexRecord;

constexpr int label_width = 17;
constexpr int column_width = 38;

std::string vector_text(const glm::dvec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }
std::string vector_text(const glm::vec3& v) { return vector_text(glm::dvec3(v)); }

std::string light_text(std::uint32_t id, const shared::RenderConstants& constants) {
    if (id == NONE) {
        return "none";
    }
    if (id < constants.emissive_triangle_count) {
        return fmt::format("triangle {}", id);
    }
    id -= constants.emissive_triangle_count;
    return id < constants.punctual_light_count ? fmt::format("punctual {}", id) : "sky";
}

std::string lobe_text(std::uint32_t lobe) {
    static constexpr const char* names[] = {"none", "diffuse", "specular", "mirror"};
    const bool mapped = (lobe & shared::FACET_MAPPED) != 0;
    const bool tangent = (lobe & shared::FACET_TANGENT) != 0;
    const char* facet = mapped && tangent ? ", both facets" : tangent ? ", tangent facet" : mapped ? ", mapped facet" : "";
    return std::string(names[lobe & 3U]) + facet;
}

std::string shadow_text(std::uint32_t shadow) {
    return shadow == shared::SHADOW_FREE ? "free" : shadow == shared::SHADOW_BLOCKED ? "blocked" : "not traced";
}

std::string roulette_text(const PathVertexRecord& v) {
    if (v.roulette == shared::ROULETTE_NOT_PLAYED) {
        return "not played";
    }
    return fmt::format("{} at {:.6g}", v.roulette == shared::ROULETTE_SURVIVED ? "survived" : "killed", v.survival);
}

bool is_miss(const PathVertexRecord& v) { return v.instance == NONE; }
bool sampled_light(const PathVertexRecord& v) { return v.light != NONE; }
bool scattered(const PathVertexRecord& v) { return v.lobe != shared::LOBE_NONE || v.roulette != 0; }
bool emitted(const PathVertexRecord& v) { return v.emission_weight != 0; }

/// One line of the table: shown where any path's vertex has something to say.
struct Row {
    const char* label;
    std::vector<RecordField> fields;  // whose worst difference the last column shows
    std::function<bool(const PathVertexRecord&)> shown;
    std::function<std::string(const PathVertexRecord&)> text;
};

std::vector<Row> make_rows(const Replay& replay, const shared::RenderConstants& constants) {
    using V = PathVertexRecord;
    const auto always = [](const V&) { return true; };
    const auto hit = [](const V& v) { return !is_miss(v); };
    const glm::dvec3 origin = replay.origin;
    return {
        {"ray", {RecordField::direction}, always, [](const V& v) { return vector_text(v.direction); }},
        {"hit inst/geom/prim",
         {RecordField::ids},
         always,
         [](const V& v) {
             return is_miss(v) ? "nothing" : fmt::format("{} / {} / {}", v.instance, v.geometry, v.primitive);
         }},
        {"barycentrics",
         {RecordField::barycentrics},
         hit,
         [](const V& v) { return fmt::format("{:.7g} {:.7g}", v.barycentrics.x, v.barycentrics.y); }},
        {"position",
         {RecordField::position},
         hit,
         [origin](const V& v) { return is_miss(v) ? "-" : vector_text(glm::dvec3(v.position) + origin); }},
        {"emission", {RecordField::emission}, emitted, [](const V& v) { return vector_text(v.emission); }},
        {"  MIS weight",
         {RecordField::emission_weight},
         emitted,
         [](const V& v) { return fmt::format("{:.6g}", v.emission_weight); }},
        {"normal", {RecordField::normal}, scattered, [](const V& v) { return vector_text(v.normal); }},
        {"light",
         {RecordField::light},
         sampled_light,
         [constants](const V& v) { return light_text(v.light, constants); }},
        {"  pdf", {RecordField::light_pdf}, sampled_light, [](const V& v) { return fmt::format("{:.6g}", v.light_pdf); }},
        {"  direct light", {RecordField::direct}, sampled_light, [](const V& v) { return vector_text(v.direct); }},
        {"  shadow ray", {RecordField::shadow}, sampled_light, [](const V& v) { return shadow_text(v.shadow); }},
        {"lobe", {RecordField::lobe}, scattered, [](const V& v) { return lobe_text(v.lobe); }},
        {"  bsdf pdf", {RecordField::bsdf_pdf}, scattered, [](const V& v) { return fmt::format("{:.6g}", v.bsdf_pdf); }},
        {"roulette", {RecordField::roulette, RecordField::survival}, scattered, roulette_text},
        {"throughput", {RecordField::throughput}, scattered, [](const V& v) { return vector_text(v.throughput); }},
    };
}

std::string difference_text(double difference) { return difference == 0 ? "=" : fmt::format("{:.1e}", difference); }

std::string line(const char* label, const std::vector<std::string>& cells, const std::string& difference, bool marked) {
    std::string text = fmt::format("  {:<{}}", label, label_width + 2);
    for (const std::string& cell : cells) {
        text += fmt::format(" {:<{}}", cell, column_width);
    }
    text += difference;
    text += marked ? "  <- they part" : "";
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
}

std::string vertex_text(const Replay& replay, const std::vector<Row>& rows, std::size_t index) {
    std::string text = fmt::format("vertex {}\n", index);
    std::vector<const PathVertexRecord*> vertices;
    bool all = true;
    for (const RecordedPath& path : replay.paths) {
        vertices.push_back(index < path.vertices.size() ? &path.vertices[index] : nullptr);
        all = all && vertices.back() != nullptr;
    }
    const bool compared = all && vertices.size() > 1;
    const bool parts_here = replay.parting && replay.parting->vertex == index;
    if (!all) {
        std::vector<std::string> cells;
        for (const PathVertexRecord* v : vertices) {
            cells.emplace_back(v != nullptr ? "goes on" : "has ended");
        }
        text += line("path", cells, "", parts_here);
    }
    for (const Row& row : rows) {
        const bool shown = std::any_of(vertices.begin(), vertices.end(),
                                       [&](const PathVertexRecord* v) { return v != nullptr && row.shown(*v); });
        if (!shown) {
            continue;
        }
        std::vector<std::string> cells;
        for (const PathVertexRecord* v : vertices) {
            cells.push_back(v != nullptr ? row.text(*v) : "");
        }
        double difference = 0;
        bool marked = false;
        for (const RecordField field : row.fields) {
            difference = std::max(difference, compared ? record_difference(field, *vertices[0], *vertices[1]) : 0);
            marked = marked || (compared && parts_here && replay.parting->field == field);
        }
        text += line(row.label, cells, compared ? difference_text(difference) : "", marked);
    }
    return text;
}

nlohmann::ordered_json vector_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

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
    json["light_kind"] = light_text(v.light, constants);
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
    std::vector<std::string> heads;
    std::size_t longest = 0;
    for (std::size_t i = 0; i < replay.paths.size(); ++i) {
        const std::string head = replay.backends[i] + ": " + replay.devices[i];
        heads.push_back(head.size() < column_width ? head : head.substr(0, column_width - 2) + "…");
        longest = std::max(longest, replay.paths[i].vertices.size());
    }
    const bool two = replay.paths.size() > 1;
    std::string text = line("", heads, two ? "difference" : "", false);
    const std::vector<Row> rows = make_rows(replay, constants);
    for (std::size_t i = 0; i < longest; ++i) {
        text += vertex_text(replay, rows, i);
    }
    text += "the whole path\n";
    std::vector<std::string> radiance;
    for (const RecordedPath& path : replay.paths) {
        radiance.push_back(vector_text(path.radiance));
    }
    const double difference = two ? relative_difference(replay.paths[0].radiance, replay.paths[1].radiance) : 0;
    const bool marked = replay.parting && replay.parting->field == RecordField::radiance;
    return text + line("radiance", radiance, two ? difference_text(difference) : "", marked);
}

std::string parting_text(const Replay& replay) {
    if (!replay.parting) {
        return fmt::format("No vertex differs by more than {:g}.", replay.tolerance);
    }
    const Parting& parting = *replay.parting;
    if (parting.field == RecordField::radiance) {
        return fmt::format("No vertex differs by more than {:g}, but the radiance does: by {:.2g}.", replay.tolerance,
                           parting.difference);
    }
    if (parting.field == RecordField::length) {
        return fmt::format("They part at vertex {}: only one path goes on.", parting.vertex);
    }
    return fmt::format("They part at vertex {}: {} differs by {:.2g} (tolerance {:g}).", parting.vertex,
                       name_of(parting.field), parting.difference, replay.tolerance);
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

}  // namespace diptych::app
