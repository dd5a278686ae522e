// What `verify` is asked: which pairs of renders are to have one mean, and how sure it is to be.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands/arguments/arguments.h"
#include "measure/verify_settings.h"

namespace diptych::core::app {

/// The options as typed; see add_verify for what they mean.
struct VerifyOptions : VerifySettings {
    RenderArguments arguments;  // scene, its settings and sequence, device, threads, validation
    std::vector<std::string> integrators{"brdf", "direct", "path"};
    std::vector<std::string> backends{"vulkan"};
    std::string against = "cpu";
    std::vector<std::uint32_t> frames;  // of a sequence, those judged, in rising order; none: the scene at rest
    std::uint32_t seed = 1;
    bool seed_given = false;
    std::vector<CLI::Option*> sequence_options;  // each asks for a sequence
    std::vector<CLI::Option*> sequence_details;  // and these want one
    bool require_pass = false;
    bool paired = false;        // path by path instead; see commands/verify/paired.h
    std::uint32_t random = 0;   // so many random scenes instead; see commands/verify/random.h
    bool shrink = true;         // a random scene that fails
    bool moving = false;        // all random scenes move
    bool still = false;         // or none; else every second one
    std::string output;
    bool json = false;
    std::string on_device_lost = "stop";
    const CLI::App* command = nullptr;  // as it was typed, for a message that says what to run
};

/// Every backend with every integrator against the reference: "BACKEND" is that backend under the same integrator,
/// "BACKEND/INTEGRATOR" one and the same reference for all; the oracle, "oracle" or "oracle/MODE", is rendered once for
/// all. Of a sequence, each at every frame judged. Throws Error for unknown names, and for options that no backend
/// among them would heed.
std::vector<PairName> plan_pairs(const VerifyOptions& options);

}  // namespace diptych::core::app
