// `verify --paired`: every path of a picture on two backends from the same random numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commands/arguments/backend_pair.h"
#include "settings/settings.h"

namespace diptych::core::app {

struct PairedOptions {
    std::vector<Integrator> integrators{Integrator::path};
    std::uint32_t spp = 16;     // samples 0 .. spp-1 of every pixel
    std::string folder;         // for pictures of the paths that part; empty for none
    bool require_pass = false;  // exit 1 on INCONCLUSIVE too
    bool json = false;
};

/// `arguments` have been through resolve_names; two backends are named. Prints the report. Returns exit_check_failed
/// where an integrator fails.
int run_paired(RenderArguments arguments, const PairArguments& pair, const PairedOptions& options);

}  // namespace diptych::core::app
