// What `verify` compares, and how sure it is to be.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "settings/settings.h"

namespace diptych::core {

struct VerifySettings {
    std::uint32_t runs = 32;        // a side
    std::uint32_t spp = 64;         // samples a pixel of each run
    std::uint32_t against_spp = 0;  // the reference's; 0: as spp
    std::uint32_t frame_spp = 1;    // samples a pixel of each frame of a chain, of which a run plays spp / frame_spp
    int tile = 16;                  // pixels a side
    double alpha = 1e-3;            // chance of a false FAIL, over all pairs together
    double max_half_width = 0.1;    // percent of the image mean (95 %), for a PASS
    double max_tile_half_width = 1; // percent, of half of the tiles
    double seconds = 0;             // above 0: the samples are doubled until every pair has power or these are used up
    bool fresh_seeds = false;       // pairs that fail are judged again, with other seeds and more samples
    bool common_seeds = false;      // run k of both sides has one seed; see compare_common_runs
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

}  // namespace diptych::core
