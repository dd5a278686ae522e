// One picture of which several processes take the samples.
#pragma once

#include "commands/render/kept_work.h"
#include "commands/render/picture.h"
#include "commands/render/rank_run.h"
#include "render/device_loss.h"

namespace diptych::core::app {

/// The same as render_picture, called by all ranks. Rank 0 hands out the samples and writes the picture. A rank that is
/// interrupted leaves a part of its own. Returns the exit code, on rank 0 alone that of the render.
int render_picture_on_ranks(RankRun& run, Session& session, const RenderRequest& request, bool quiet,
                            const WorkFiles& files, LossGuard& guard);

}  // namespace diptych::core::app
