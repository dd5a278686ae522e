// The passes of one ReSTIR frame, in order, and the sets of memory they read and write. Both backends follow it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "restir/resampling_memory.h"
#include "language/scene_types.h"

namespace diptych::core {

enum class ResamplingStage { first_hits, candidates, temporal, spatial, shadows, shade };

struct ResamplingStep {
    ResamplingStage stage;
    shared::ResamplingPass pass;
    std::size_t place = 0;  // in pass_names
};

/// The set of reservoirs that holds what the step left.
std::uint32_t resulting_set(const ResamplingStep& step);

/// The passes of a frame, in order: "first hits", "candidates", "temporal", "spatial 1", ..., "shadows", "shade"; none
/// for integrators that do not resample.
std::vector<std::string> pass_names(const shared::RenderConstants& constants);

/// Whether any frame will run the stage; false for integrators that do not resample.
bool needs_stage(ResamplingStage stage, const shared::RenderConstants& constants);

/// Whether initial reservoirs keep only what is seen.
bool tests_candidates(const shared::RenderConstants& constants);

/// Films of each kind that the settings need. Two sets of reservoirs serve any number of spatial passes: a frame's
/// history is dead once its temporal pass is over, and its memory takes the first spatial pass's results.
struct ResamplingSets {
    std::uint32_t first_vertices = 0;
    std::uint32_t reservoirs = 0;
    std::uint32_t surfaces = 0;
};

/// All zero for integrators that do not resample.
ResamplingSets resampling_sets(const shared::RenderConstants& constants);

class ResamplingSchedule {
public:
    explicit ResamplingSchedule(const shared::RenderConstants& constants);

    /// Frames follow one another; one that does not follow the last begins a new chain.
    std::vector<ResamplingStep> next_frame(std::uint32_t frame);

    /// Forgets the past.
    void restart() { has_history_ = false; }

private:
    shared::RenderConstants constants_;
    ResamplingSets sets_;
    bool has_history_ = false;
    std::uint32_t last_frame_ = 0;
    std::uint32_t history_ = 0;   // set of reservoirs
    std::uint32_t surfaces_ = 0;  // set, of the last frame
};

}  // namespace diptych::core
