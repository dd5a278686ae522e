#include "measure/replay_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace diptych::core {

namespace {

using shared::NONE;
using shared::PathVertexRecord;

struct Numbers {
    int digits;

    std::string operator()(double x) const { return fmt::format("{:.{}g}", x, digits); }
    std::string operator()(const glm::dvec3& v) const { return (*this)(v.x) + ' ' + (*this)(v.y) + ' ' + (*this)(v.z); }
    std::string operator()(const glm::vec3& v) const { return (*this)(glm::dvec3(v)); }
    std::string operator()(float x) const { return (*this)(static_cast<double>(x)); }
};

std::string roulette_text(const PathVertexRecord& v, const Numbers& number) {
    if (v.roulette == shared::ROULETTE_NOT_PLAYED) {
        return "not played";
    }
    return (v.roulette == shared::ROULETTE_SURVIVED ? "survived at " : "killed at ") + number(v.survival);
}

bool is_miss(const PathVertexRecord& v) {
    return v.instance == NONE;
}
bool sampled_light(const PathVertexRecord& v) {
    return v.light != NONE;
}
bool scattered(const PathVertexRecord& v) {
    return v.lobe != shared::LOBE_NONE || v.roulette != 0;
}
bool emitted(const PathVertexRecord& v) {
    return v.emission_weight != 0;
}

/// One kind of row: shown where any path's vertex has something to say.
struct Kind {
    const char* label;
    std::vector<RecordField> fields;  // whose worst difference counts
    std::function<bool(const PathVertexRecord&)> shown;
    std::function<std::string(const PathVertexRecord&)> text;
};

std::vector<Kind> make_kinds(const glm::dvec3& origin, const shared::RenderConstants* constants,
                             const Numbers& number) {
    using V = PathVertexRecord;
    const auto always = [](const V&) { return true; };
    const auto hit = [](const V& v) { return !is_miss(v); };
    const Numbers exact{number.digits + 1};
    return {
        {"ray", {RecordField::direction}, always, [=](const V& v) { return number(v.direction); }},
        {"hit inst/geom/prim",
         {RecordField::ids},
         always,
         [](const V& v) {
             return is_miss(v) ? "nothing" : fmt::format("{} / {} / {}", v.instance, v.geometry, v.primitive);
         }},
        {"barycentrics",
         {RecordField::barycentrics},
         hit,
         [=](const V& v) { return exact(v.barycentrics.x) + ' ' + exact(v.barycentrics.y); }},
        {"position",
         {RecordField::position},
         hit,
         [=](const V& v) { return is_miss(v) ? "-" : number(glm::dvec3(v.position) + origin); }},
        {"emission", {RecordField::emission}, emitted, [=](const V& v) { return number(v.emission); }},
        {"  MIS weight",
         {RecordField::emission_weight},
         emitted,
         [=](const V& v) { return number(v.emission_weight); }},
        {"normal", {RecordField::normal}, scattered, [=](const V& v) { return number(v.normal); }},
        {"light", {RecordField::light}, sampled_light, [=](const V& v) { return light_text(v.light, constants); }},
        {"  pdf", {RecordField::light_pdf}, sampled_light, [=](const V& v) { return number(v.light_pdf); }},
        {"  direct light", {RecordField::direct}, sampled_light, [=](const V& v) { return number(v.direct); }},
        {"  shadow ray", {RecordField::shadow}, sampled_light, [](const V& v) { return shadow_text(v.shadow); }},
        {"lobe", {RecordField::lobe}, scattered, [](const V& v) { return lobe_text(v.lobe); }},
        {"  bsdf pdf", {RecordField::bsdf_pdf}, scattered, [=](const V& v) { return number(v.bsdf_pdf); }},
        {"roulette",
         {RecordField::roulette, RecordField::survival},
         scattered,
         [=](const V& v) { return roulette_text(v, number); }},
        {"throughput", {RecordField::throughput}, scattered, [=](const V& v) { return number(v.throughput); }},
    };
}

std::string difference_text(double difference) {
    return difference == 0 ? "=" : fmt::format("{:.1e}", difference);
}

ReplayGroup vertex_group(const Replay& replay, const std::vector<Kind>& kinds, std::size_t index) {
    ReplayGroup group{fmt::format("vertex {}", index), {}};
    std::vector<const PathVertexRecord*> vertices;
    bool all = true;
    for (const RecordedPath& path : replay.paths) {
        vertices.push_back(index < path.vertices.size() ? &path.vertices[index] : nullptr);
        all = all && vertices.back() != nullptr;
    }
    const bool compared = all && vertices.size() > 1;
    const bool parts_here = replay.parting && replay.parting->vertex == index;
    if (!all) {
        ReplayRow row{.label = "path", .cells = {}, .difference = "", .marked = parts_here};
        for (const PathVertexRecord* v : vertices) {
            row.cells.emplace_back(v != nullptr ? "goes on" : "has ended");
        }
        group.rows.push_back(std::move(row));
    }
    for (const Kind& kind : kinds) {
        const bool shown = std::any_of(vertices.begin(), vertices.end(),
                                       [&](const PathVertexRecord* v) { return v != nullptr && kind.shown(*v); });
        if (!shown) {
            continue;
        }
        ReplayRow row{.label = kind.label, .cells = {}, .difference = "", .marked = false};
        for (const PathVertexRecord* v : vertices) {
            row.cells.push_back(v != nullptr ? kind.text(*v) : "");
        }
        if (compared) {
            double difference = 0;
            for (const RecordField field : kind.fields) {
                difference = std::max(difference, record_difference(field, *vertices[0], *vertices[1]));
                row.marked = row.marked || (parts_here && replay.parting->field == field);
            }
            row.difference = difference_text(difference);
        }
        group.rows.push_back(std::move(row));
    }
    return group;
}

}  // namespace

std::string light_text(std::uint32_t id, const shared::RenderConstants* constants) {
    if (id == NONE) {
        return "none";
    }
    if (constants == nullptr) {
        return fmt::format("{}", id);
    }
    if (id < constants->emissive_triangle_count) {
        return fmt::format("triangle {}", id);
    }
    id -= constants->emissive_triangle_count;
    return id < constants->punctual_light_count ? fmt::format("punctual {}", id) : "sky";
}

std::string lobe_text(std::uint32_t lobe) {
    static constexpr const char* names[] = {"none", "diffuse", "specular", "mirror"};
    const bool mapped = (lobe & shared::FACET_MAPPED) != 0;
    const bool tangent = (lobe & shared::FACET_TANGENT) != 0;
    const char* facet = mapped && tangent ? ", both facets"
                        : tangent         ? ", tangent facet"
                        : mapped          ? ", mapped facet"
                                          : "";
    return std::string(names[lobe & 3U]) + facet;
}

std::string shadow_text(std::uint32_t shadow) {
    return shadow == shared::SHADOW_FREE ? "free" : shadow == shared::SHADOW_BLOCKED ? "blocked" : "not traced";
}

std::vector<ReplayGroup> replay_groups(const Replay& replay, const shared::RenderConstants* constants, int digits) {
    const Numbers number{digits};
    const std::vector<Kind> kinds = make_kinds(replay.origin, constants, number);
    std::size_t longest = 0;
    for (const RecordedPath& path : replay.paths) {
        longest = std::max(longest, path.vertices.size());
    }
    std::vector<ReplayGroup> groups;
    for (std::size_t i = 0; i < longest; ++i) {
        groups.push_back(vertex_group(replay, kinds, i));
    }
    ReplayRow radiance{.label = "radiance", .cells = {}, .difference = "", .marked = false};
    for (const RecordedPath& path : replay.paths) {
        radiance.cells.push_back(number(path.radiance));
    }
    if (replay.paths.size() > 1) {
        radiance.difference = difference_text(relative_difference(replay.paths[0].radiance, replay.paths[1].radiance));
        radiance.marked = replay.parting && replay.parting->field == RecordField::radiance;
    }
    groups.push_back({"the whole path", {std::move(radiance)}});
    return groups;
}

}  // namespace diptych::core
