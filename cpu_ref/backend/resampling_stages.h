// The stages of a ReSTIR frame, pixel by pixel, on the CPU.
#pragma once

#include "backend/cpu_kernel.h"

namespace diptych::core {

/// What a stage does at a pixel; nothing where that is to shade, whose sample is the caller's to take.
template <class Kernel>
void run_stage(Kernel& kernel, const ResamplingStep& step, shared::uvec2 pixel) {
    switch (step.stage) {
    case ResamplingStage::first_hits:
        kernel.find_first_vertex(pixel, step.pass);
        break;
    case ResamplingStage::candidates:
        if (const auto request = kernel.resample_candidates(pixel, step.pass); kernel.needs_rays(request)) {
            kernel.share_picked(request, step.pass);
            shared::ResamplingPass pass = step.pass;
            for (pass.iteration = 0; pass.iteration < shared::BSDF_CANDIDATES_NARROW; ++pass.iteration) {
                kernel.add_bsdf_candidate(request, pass);
            }
        }
        if (tests_candidates(kernel.constants)) {
            kernel.test_candidate(pixel, step.pass);
        }
        break;
    case ResamplingStage::temporal:
        kernel.reuse_temporal(pixel, step.pass);
        break;
    case ResamplingStage::spatial:
        kernel.reuse_spatial(pixel, step.pass);
        break;
    case ResamplingStage::shadows:
        kernel.trace_shadow_of_chosen(pixel, step.pass);
        break;
    case ResamplingStage::shade:
        break;
    }
}

}  // namespace diptych::core
