// What `verify` is asked: which pairs of renders are to have one mean, and how sure it is to be.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "commands/arguments/arguments.h"

namespace diptych::app {

/// The options as typed; see add_verify for what they mean.
struct VerifyOptions {
    RenderArguments arguments;  // scene, its settings and sequence, device, threads, validation
    std::vector<std::string> integrators{"brdf", "direct", "path"};
    std::vector<std::string> backends{"vulkan"};
    std::string against = "cpu";
    std::uint32_t runs = 32;
    std::uint32_t spp = 64;
    std::uint32_t against_spp = 0;      // the reference's; 0: as spp
    std::vector<std::uint32_t> frames;  // of a sequence, those judged, in rising order; none: the scene at rest
    std::uint32_t frame_spp = 1;  // samples a pixel of each frame of a chain, of which a run plays spp / frame_spp
    std::uint32_t seed = 1;
    int tile = 16;
    double alpha = 1e-3;
    double max_half_width = 0.1;
    double max_tile_half_width = 1;
    double seconds = 0;
    bool fresh_seeds = false;
    bool seed_given = false;
    std::vector<CLI::Option*> sequence_options;  // each asks for a sequence
    std::vector<CLI::Option*> sequence_details;  // and these want one
    bool require_pass = false;
    bool common_seeds = false;  // run k of both sides has one seed; see compare_common_runs
    bool paired = false;        // path by path instead; see commands/verify/paired.h
    std::uint32_t random = 0;   // so many random scenes instead; see commands/verify/random.h
    bool shrink = true;         // a random scene that fails
    bool moving = false;        // all random scenes move
    bool still = false;         // or none; else every second one
    std::string output;
    bool json = false;
    const CLI::App* command = nullptr;  // as it was typed, for a message that says what to run
};

/// One panel under one integrator, or the oracle, which heeds no integrator, in one of its modes.
struct SideName {
    std::string backend;
    Integrator integrator = Integrator::path;
    std::string oracle_mode = "mis";

    bool operator==(const SideName&) const = default;
};

/// "cpu/path", "oracle/mis".
std::string text_of(const SideName& side);

struct PairName {
    SideName a;
    SideName b;                          // the reference
    std::optional<std::uint32_t> frame;  // none: at rest
};

/// "vulkan/path - cpu/path", with ", frame 4" where one is.
std::string text_of(const PairName& pair);

/// Every backend with every integrator against the reference: "BACKEND" is that backend under the same integrator,
/// "BACKEND/INTEGRATOR" one and the same reference for all; the oracle, "oracle" or "oracle/MODE", is rendered once for
/// all. Of a sequence, each at every frame judged. Throws Error for unknown names, and for options that no backend
/// among them would heed.
std::vector<PairName> plan_pairs(const VerifyOptions& options);

}  // namespace diptych::app
