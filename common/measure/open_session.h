// How engines are handed their backends.
#pragma once

#include <functional>

#include "render/request.h"
#include "render/session.h"

namespace diptych::core {

/// Opens a session on the backend that the request names: at rest, or to play the frames of its sequence. `scene` must
/// live as long. Throws NoDevice and Error.
using OpenSession = std::function<Session(const Scene& scene, const RenderRequest& request, bool plays)>;

}  // namespace diptych::core
