#include "session/pack_requested.h"

#include <mutex>
#include <set>

#include "console/report.h"

namespace diptych::app {

PackedScene pack_requested(const Scene& scene, const RenderSettings& settings) {
    static std::mutex mutex;
    static std::set<std::string> reported;
    PackedScene packed = pack_scene(scene, settings);
    const std::lock_guard lock(mutex);
    for (const std::string& warning : packed.warnings) {
        if (reported.insert(warning).second) {
            report_warning(warning);
        }
    }
    return packed;
}

}  // namespace diptych::app
