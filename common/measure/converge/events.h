// What a measurement finds, one after the other, and the lines of results.jsonl that say so.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "measure/converge/errors.h"

namespace diptych::core {

/// What building a method took, before its first sample.
struct MethodSetup {
    std::string device;
    double pack_seconds = 0;
    double build_seconds = 0;
    double compile_seconds = 0;
    std::uint64_t bytes = 0;
};

/// A method's picture at equal time.
struct MethodPicture {
    double wanted_seconds = 0;
    std::uint32_t spp = 0;
    double device_seconds = 0;
    double relmse = 0;
    std::string command;  // that repeats it
};

/// A reference that was rendered.
struct RenderedReference {
    std::string method;
    std::string device;
    std::uint32_t spp = 0;
    std::uint32_t blocks = 0;
    double device_seconds = 0;
};

nlohmann::ordered_json to_json(const std::string& method, const MethodSetup& setup);
nlohmann::ordered_json to_json(const std::string& method, const MethodPicture& picture);
nlohmann::ordered_json to_json(const RenderedReference& reference);
/// Of one run, at least one.
nlohmann::ordered_json to_json(const std::vector<ErrorRow>& run);

/// Back again; a number that JSON could not hold is NaN.
MethodSetup setup_of(const nlohmann::ordered_json& event);
MethodPicture picture_of(const nlohmann::ordered_json& event);
RenderedReference rendered_reference_of(const nlohmann::ordered_json& event);
std::vector<ErrorRow> run_of(const nlohmann::ordered_json& event);

}  // namespace diptych::core
