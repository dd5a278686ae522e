#include "render/resampling_schedule.h"

#include "path/integrators.h"

namespace diptych::core {

bool needs_stage(ResamplingStage stage, const shared::RenderConstants& constants) {
    const bool resamples = shared::resamples_lights(constants.integrator);
    const bool reuses = shared::reuses_reservoirs(constants.integrator);
    switch (stage) {
    case ResamplingStage::temporal:
        return reuses && constants.resampling.temporal != 0;
    case ResamplingStage::spatial:
        return reuses && constants.resampling.spatial_passes > 0;
    case ResamplingStage::shadows:
        return resamples && constants.resampling.visibility != shared::VISIBILITY_IN_TARGET;
    case ResamplingStage::first_hits:
    case ResamplingStage::candidates:
    case ResamplingStage::shade:
        break;
    }
    return resamples;
}

bool tests_candidates(const shared::RenderConstants& constants) {
    const std::uint32_t visibility = constants.resampling.visibility;
    return MUTANT(INITIAL_CULL, false, true) || visibility == shared::VISIBILITY_IN_TARGET ||
           visibility == shared::VISIBILITY_BIASED_INITIAL;
}

std::uint32_t resulting_set(const ResamplingStep& step) {
    return step.stage == ResamplingStage::spatial ? step.pass.other_reservoirs : step.pass.reservoirs;
}

std::vector<std::string> pass_names(const shared::RenderConstants& constants) {
    if (!needs_stage(ResamplingStage::candidates, constants)) {
        return {};
    }
    std::vector<std::string> names{"first hits", "candidates"};
    if (needs_stage(ResamplingStage::temporal, constants)) {
        names.emplace_back("temporal");
    }
    for (std::uint32_t i = 0;
         needs_stage(ResamplingStage::spatial, constants) && i < constants.resampling.spatial_passes; ++i) {
        names.push_back("spatial " + std::to_string(i + 1));
    }
    if (needs_stage(ResamplingStage::shadows, constants)) {
        names.emplace_back("shadows");
    }
    names.emplace_back("shade");
    return names;
}

ResamplingSets resampling_sets(const shared::RenderConstants& constants) {
    if (!needs_stage(ResamplingStage::candidates, constants)) {
        return {};
    }
    const bool reuses = shared::reuses_reservoirs(constants.integrator);
    const bool temporal = needs_stage(ResamplingStage::temporal, constants);
    const bool spatial = needs_stage(ResamplingStage::spatial, constants);
    return {.first_vertices = 1,
            .reservoirs = temporal || spatial ? 2U : 1U,
            .surfaces = temporal ? 2U
                        : reuses ? 1U
                                 : 0U};
}

ResamplingSchedule::ResamplingSchedule(const shared::RenderConstants& constants)
    : constants_(constants), sets_(resampling_sets(constants)) {}

std::vector<ResamplingStep> ResamplingSchedule::next_frame(std::uint32_t frame) {
    const bool follows = has_history_ && frame == last_frame_ + 1;
    const bool two_surfaces = sets_.surfaces > 1;
    surfaces_ = two_surfaces ? 1 - surfaces_ : 0;
    std::uint32_t current = sets_.reservoirs > 1 ? 1 - history_ : 0;

    shared::ResamplingPass pass{};
    pass.frame = frame;
    pass.surfaces = surfaces_;
    pass.has_history = follows ? 1 : 0;
    pass.reservoirs = current;
    std::vector<ResamplingStep> steps{{ResamplingStage::first_hits, pass, 0}, {ResamplingStage::candidates, pass, 1}};
    const bool temporal = needs_stage(ResamplingStage::temporal, constants_);
    if (follows && temporal) {
        pass.other_reservoirs = history_;
        steps.push_back({ResamplingStage::temporal, pass, 2});
    }
    std::size_t place = temporal ? 3 : 2;
    const bool spatial = needs_stage(ResamplingStage::spatial, constants_);
    for (std::uint32_t i = 0; spatial && i < constants_.resampling.spatial_passes; ++i) {
        pass.iteration = i;
        pass.reservoirs = current;
        pass.other_reservoirs = 1 - current;
        steps.push_back({ResamplingStage::spatial, pass, place++});
        current = 1 - current;
    }
    pass.reservoirs = current;
    if (needs_stage(ResamplingStage::shadows, constants_)) {
        steps.push_back({ResamplingStage::shadows, pass, place++});
    }
    steps.push_back({ResamplingStage::shade, pass, place});
    history_ = current;
    has_history_ = true;
    last_frame_ = frame;
    return steps;
}

}  // namespace diptych::core
