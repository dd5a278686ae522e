// A session on the backend that was asked for.
#pragma once

#include "render/request.h"
#include "render/session.h"

namespace diptych::core::app {

/// What a pack leaves out becomes warnings on stderr: each line once, however often and in however many threads a scene
/// is packed.
SessionHooks reporting_hooks();

/// At rest; `scene` must live as long. `instead`, unless empty, makes the renderer. Throws NoDevice, DeviceLost and Error.
/// `busy` is told of steps that may take long.
Session open_session(const Scene& scene, const RenderRequest& request, const MakeRenderer& instead = {},
                     const BusyHook& busy = {});

/// To be shown other moments, `moment` first.
Session open_session(const Scene& scene, const RenderRequest& request, const Moment& moment,
                     const MakeRenderer& instead = {}, const BusyHook& busy = {});

/// Either, for engines (measure/open_session.h).
Session open_requested(const Scene& scene, const RenderRequest& request, bool plays);

/// To play the frames of the request's sequence: settings.moves is put in place where they look back to one another.
Session open_played(const Scene& scene, RenderRequest request, const MakeRenderer& instead = {},
                    const BusyHook& busy = {});

}  // namespace diptych::core::app
