// One path as a backend traced it, and where two of them part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "path/path_record.h"

namespace diptych::core {

/// All rays that the path went along, each with where it ended, and what came of them.
struct RecordedPath {
    std::vector<shared::PathVertexRecord> vertices;
    glm::vec3 radiance{};
};

/// What of a vertex may differ. In the order in which a path comes by it, so that the first that differs is the cause.
enum class RecordField {
    length,  // one path has ended, the other has not
    direction,
    ids,
    barycentrics,
    position,
    emission_weight,
    emission,
    normal,
    light,
    light_pdf,
    direct,
    lobe,
    bsdf_pdf,
    survival,
    roulette,
    throughput,
    shadow,
    radiance,  // of the whole path
};

/// "light pdf".
const char* name_of(RecordField field);

struct Parting {
    std::size_t vertex = 0;  // where; the number of vertices where only the radiance differs
    RecordField field = RecordField::length;
    double difference = 0;  // as record_difference gives it; 1 for decisions
};

/// How far a field of two vertices differs: of numbers |a-b| over the larger of |a| and |b|, each beyond 1e-6
/// (positions: over the ray's length; barycentrics: over 1), of decisions 0 or 1.
double record_difference(RecordField field, const shared::PathVertexRecord& a, const shared::PathVertexRecord& b);

/// |a-b| over the larger of both, of the worst channel; what differs by no more than 1e-6 does not.
double relative_difference(const glm::vec3& a, const glm::vec3& b);

/// The first field that differs by more than `tolerance`, or none.
std::optional<Parting> find_parting(const RecordedPath& a, const RecordedPath& b, double tolerance);

}  // namespace diptych::core
