#include "view/invalidation.h"

namespace diptych::core::app {

Change invalidation(const RenderedState& before, const RenderedState& after) {
    if (before.scene != after.scene) {
        return Change::scene;
    }
    return change_between(moment_of(before), before.request.settings, moment_of(after), after.request.settings);
}

}  // namespace diptych::core::app
