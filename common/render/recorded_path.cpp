#include "render/recorded_path.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace diptych::core {
namespace {

using shared::PathVertexRecord;

constexpr double smallest = 1e-6;  // differences up to here are none

struct NamedField {
    RecordField field;
    const char* name;
};

// All that are compared within a vertex, in order.
constexpr std::array<NamedField, 16> fields = {{
    {RecordField::direction, "direction"},
    {RecordField::ids, "ids"},
    {RecordField::barycentrics, "barycentrics"},
    {RecordField::position, "position"},
    {RecordField::emission_weight, "emission weight"},
    {RecordField::emission, "emission"},
    {RecordField::normal, "normal"},
    {RecordField::light, "light"},
    {RecordField::light_pdf, "light pdf"},
    {RecordField::direct, "direct light"},
    {RecordField::lobe, "lobe"},
    {RecordField::bsdf_pdf, "bsdf pdf"},
    {RecordField::survival, "survival"},
    {RecordField::roulette, "roulette"},
    {RecordField::throughput, "throughput"},
    {RecordField::shadow, "shadow ray"},
}};

double relative(double a, double b) {
    if (a == b) {
        return 0;
    }
    if (!std::isfinite(a) || !std::isfinite(b)) {
        return std::isnan(a) && std::isnan(b) ? 0 : 1;
    }
    return std::max(std::abs(a - b) - smallest, 0.0) / std::max(std::abs(a), std::abs(b));
}

double distance(const glm::vec3& a, const glm::vec3& b) {
    return static_cast<double>(glm::distance(a, b));
}

}  // namespace

const char* name_of(RecordField field) {
    if (field == RecordField::length) {
        return "length";
    }
    if (field == RecordField::radiance) {
        return "radiance";
    }
    return std::find_if(fields.begin(), fields.end(), [&](const NamedField& f) { return f.field == field; })->name;
}

double relative_difference(const glm::vec3& a, const glm::vec3& b) {
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, relative(static_cast<double>(a[c]), static_cast<double>(b[c])));
    }
    return worst;
}

double record_difference(RecordField field, const PathVertexRecord& a, const PathVertexRecord& b) {
    const auto decision = [](bool same) { return same ? 0.0 : 1.0; };
    const auto number = [](float x, float y) { return relative(static_cast<double>(x), static_cast<double>(y)); };
    switch (field) {
    case RecordField::direction:
        return distance(a.direction, b.direction) / std::max(static_cast<double>(glm::length(a.direction)), 1e-30);
    case RecordField::ids:
        return decision(a.instance == b.instance && a.geometry == b.geometry && a.primitive == b.primitive);
    case RecordField::barycentrics:
        return static_cast<double>(glm::distance(a.barycentrics, b.barycentrics));
    case RecordField::position:
        return distance(a.position, b.position) / std::max(static_cast<double>(a.t * glm::length(a.direction)), 1e-30);
    case RecordField::emission_weight:
        return number(a.emission_weight, b.emission_weight);
    case RecordField::emission:
        return relative_difference(a.emission, b.emission);
    case RecordField::normal:
        return distance(a.normal, b.normal);
    case RecordField::light:
        return decision(a.light == b.light);
    case RecordField::light_pdf:
        return number(a.light_pdf, b.light_pdf);
    case RecordField::direct:
        return relative_difference(a.direct, b.direct);
    case RecordField::lobe:
        return decision(a.lobe == b.lobe);
    case RecordField::bsdf_pdf:
        return number(a.bsdf_pdf, b.bsdf_pdf);
    case RecordField::survival:
        return number(a.survival, b.survival);
    case RecordField::roulette:
        return decision(a.roulette == b.roulette);
    case RecordField::throughput:
        return relative_difference(a.throughput, b.throughput);
    case RecordField::shadow:
        return decision(a.shadow == b.shadow);
    case RecordField::length:
    case RecordField::radiance:
        break;
    }
    return 0;
}

std::optional<Parting> find_parting(const RecordedPath& a, const RecordedPath& b, double tolerance) {
    const std::size_t shorter = std::min(a.vertices.size(), b.vertices.size());
    for (std::size_t i = 0; i < shorter; ++i) {
        for (const NamedField& named : fields) {
            const double difference = record_difference(named.field, a.vertices[i], b.vertices[i]);
            if (difference > tolerance) {
                return Parting{i, named.field, difference};
            }
        }
    }
    if (a.vertices.size() != b.vertices.size()) {
        return Parting{shorter, RecordField::length, 1};
    }
    const double difference = relative_difference(a.radiance, b.radiance);
    if (difference > tolerance) {
        return Parting{shorter, RecordField::radiance, difference};
    }
    return std::nullopt;
}

}  // namespace diptych::core
