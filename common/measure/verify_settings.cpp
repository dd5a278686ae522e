#include "measure/verify_settings.h"

#include <fmt/format.h>

#include "settings/names.h"

namespace diptych::core {

std::string text_of(const SideName& side) {
    return fmt::format("{}/{}", side.backend, side.backend == "oracle" ? side.oracle_mode : name_of(side.integrator));
}

std::string text_of(const PairName& pair) {
    return text_of(pair.a) + " - " + text_of(pair.b) + (pair.frame ? fmt::format(", frame {}", *pair.frame) : "");
}

}  // namespace diptych::core
